/* A picture within an error or a time: which of several ways to draw it to take. Pure; no GL. */
#ifndef ANG_PLAN_BUDGET_H
#define ANG_PLAN_BUDGET_H

#include <stdbool.h>
#include <stddef.h>

/* NaN: no limit. */
typedef struct ang_budget {
    double max_error; /* levels */
    double max_ms;    /* of one frame, once everything is built */
} ang_budget;

/* One way to draw the picture. */
typedef struct ang_candidate {
    int method;         /* of the caller's list */
    double step_voxels; /* 0: exact */
    int stride;         /* every so many pixels along each axis are drawn, those between interpolated; 1: all */
    double ms;          /* predicted */
    double error;       /* predicted, levels; NaN: not known, which keeps no limit */
} ang_candidate;

typedef struct ang_choice {
    size_t index;                 /* of the candidate */
    bool keeps_error, keeps_time; /* as predicted; true where there is no limit */
} ang_choice;

/* Within all limits: the fastest, or without a limit of the error that with the least error. Where none keeps all, the
 * fastest of those that keep the error; else, of those that keep the time, the one with the least error; else the one
 * with the least error where only an error was given, and the fastest where a time was. A wrong picture is worse than
 * a late one. `count` >= 1. */
ang_choice ang_budget_choose(const ang_candidate *candidates, size_t count, const ang_budget *budget);

/* Levels at another step, from those at one: `fixed` does not depend on it, `varying` falls with the order. */
double ang_budget_error(double fixed, double varying, double order, double step, double measured_step);
/* The largest step, in voxels, that is expected to keep the limit; 0 where `fixed` alone breaks it. */
double ang_budget_step(double fixed, double varying, double order, double measured_step, double max_error);

#endif
