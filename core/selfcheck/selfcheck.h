/* The battery of stiff and extreme scenes (numerics.md): each case on each method that applies and on each backend of
 * this machine, against closed forms or the double-precision reference. */
#ifndef ANG_SELFCHECK_SELFCHECK_H
#define ANG_SELFCHECK_SELFCHECK_H

#include "core/base/progress.h"
#include "core/render/context.h"
#include "core/render/method.h"

/* A value that should lie in [low, high]. Of the many that a case measures the worst is kept: the one that leaves its
 * range, or comes nearest to leaving it. */
typedef struct ang_measure {
    double value;
    double low, high; /* low 0: an error and its tolerance, 0 for exact; high INFINITY: at least low */
    char what[160];   /* which value, in words; empty: nothing was measured */
} ang_measure;
bool ang_measure_holds(const ang_measure *measure);

typedef enum ang_verdict { ANG_VERDICT_OK, ANG_VERDICT_RED, ANG_VERDICT_NOT_APPLICABLE } ang_verdict;
/* "ok", "red", "not applicable" */
const char *ang_verdict_name(ang_verdict verdict);

typedef struct ang_bench ang_bench; /* bench.h */

/* A case of the battery: constant, shared by all threads. */
typedef struct ang_selfcheck_case {
    int number;           /* in numerics.md */
    const char *name;     /* a few words */
    const char *expected; /* what the picture must show */
    const char *allowed;  /* the tolerance in words */
    const char *means;    /* one sentence: what a red one means for pictures */
    bool alone;           /* needs neither method nor OpenGL: run once */
    unsigned takes;       /* ang_method_takes: applies to methods that take all of these */
    bool has_truth;       /* compares with the reference, so that it does not apply to that */
    const char *unless;   /* why it does not apply to the others; NULL: it applies to all */
    /* Measures on `bench`. False with the error of a method, ANG_LIMIT, or ANG_INTERRUPTED. */
    bool (*run)(ang_bench *bench, ang_error *err);
} ang_selfcheck_case;
/* All cases in the order of their numbers. */
const ang_selfcheck_case *ang_selfcheck_cases(int *count);
/* Why `method` need not pass this case; NULL where it must. */
const char *ang_selfcheck_unless(const ang_selfcheck_case *which, const ang_method *method);

/* Where OpenGL came from; backend ANG_BACKEND_NONE is the one without. Plain value. */
typedef struct ang_selfcheck_place {
    ang_backend backend;
    bool here;        /* false: not on this machine, `words` says why */
    char words[1024]; /* "egl, surfaceless" */
    char renderer[256], version[128];
} ang_selfcheck_place;

typedef struct ang_selfcheck_result {
    const ang_selfcheck_case *which;
    const ang_method *method; /* NULL: the case needs none */
    int place;                /* index into the report's places */
    ang_verdict verdict;
    ang_measure worst;
    char note[1024]; /* why it does not apply, or the error that ended it */
    double ms;
} ang_selfcheck_result;

enum { ANG_SELFCHECK_PLACES = 8 };

/* Zero-initialise; free with ang_selfcheck_report_clear. Results are sorted by place, then case, then method. */
typedef struct ang_selfcheck_report {
    ang_selfcheck_place places[ANG_SELFCHECK_PLACES];
    int place_count;
    ang_selfcheck_result *results;
    int count, red;
    double ms;
} ang_selfcheck_report;

typedef struct ang_selfcheck_options {
    const ang_method *const *methods; /* NULL at the end; NULL: ang_methods() */
    ang_backend backend;              /* AUTO: all that this machine has; NONE: only what needs no OpenGL */
    const int *cases;                 /* numbers of the cases wanted, `case_count` of them; NULL: all */
    int case_count;
    int threads; /* 0: all */
} ang_selfcheck_options;

/* Runs the battery; contexts are opened and closed one after the other on the calling thread, which must have none
 * current. A method that fails is red, not an error. False with ANG_LIMIT or ANG_INTERRUPTED; the report then holds
 * what was done so far. */
bool ang_selfcheck_run(const ang_selfcheck_options *options, ang_selfcheck_report *report, const ang_progress *progress,
                       ang_error *err);
void ang_selfcheck_report_clear(ang_selfcheck_report *report);

#endif
