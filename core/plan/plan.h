/* What drawing a picture takes and what it leaves out, with the reasons: printed by --explain and written as JSON. */
#ifndef ANG_PLAN_PLAN_H
#define ANG_PLAN_PLAN_H

#include <stdbool.h>
#include <stddef.h>

/* Something in use, or left out and why. */
typedef struct ang_plan_item {
    char *what, *why; /* `why` is NULL for what is in use */
    char *saves;      /* what leaving it out spares; NULL where that is not known */
} ang_plan_item;

typedef struct ang_plan_items {
    ang_plan_item *item;
    size_t count;
} ang_plan_items;

/* One pass over the picture's pixels. */
typedef struct ang_plan_pass {
    char *name;
    char *parts; /* names of the shader parts in order, separated by blanks */
    int lookups; /* texture lookups of one sample */
} ang_plan_pass;

/* Zero-initialise; owns its strings; not thread safe. What memory is missing for is dropped. */
typedef struct ang_plan {
    ang_plan_items uses, left_out;
    ang_plan_pass *pass;
    size_t pass_count;
} ang_plan;

void ang_plan_use(ang_plan *plan, const char *format, ...) __attribute__((format(printf, 2, 3)));
void ang_plan_leave_out(ang_plan *plan, const char *what, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* The same with what leaving it out spares, in words; "" or NULL where that is not known. Copies the strings. */
void ang_plan_leave_out_saving(ang_plan *plan, const char *what, const char *why, const char *saves);
/* Copies both strings. */
void ang_plan_add_pass(ang_plan *plan, const char *name, const char *parts, int lookups);
/* Frees what it holds and makes it empty. */
void ang_plan_clear(ang_plan *plan);

#endif
