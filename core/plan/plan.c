#include "core/plan/plan.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *format_text(const char *format, va_list args) {
    char *text = NULL;
    return vasprintf(&text, format, args) < 0 ? NULL : text;
}

/* Takes the strings over. */
static void add(ang_plan_items *items, char *what, char *why, char *saves) {
    ang_plan_item *grown = what ? realloc(items->item, (items->count + 1) * sizeof *grown) : NULL;
    if (!grown) {
        free(what);
        free(why);
        free(saves);
        return;
    }
    items->item = grown;
    grown[items->count++] = (ang_plan_item){what, why, saves};
}

void ang_plan_use(ang_plan *plan, const char *format, ...) {
    va_list args;
    va_start(args, format);
    add(&plan->uses, format_text(format, args), NULL, NULL);
    va_end(args);
}

void ang_plan_leave_out(ang_plan *plan, const char *what, const char *format, ...) {
    va_list args;
    va_start(args, format);
    char *why = format_text(format, args);
    va_end(args);
    add(&plan->left_out, why ? strdup(what) : NULL, why, NULL);
}

void ang_plan_leave_out_saving(ang_plan *plan, const char *what, const char *why, const char *saves) {
    char *reason = strdup(why);
    add(&plan->left_out, reason ? strdup(what) : NULL, reason, saves && *saves ? strdup(saves) : NULL);
}

void ang_plan_add_pass(ang_plan *plan, const char *name, const char *parts, int lookups) {
    ang_plan_pass pass = {strdup(name), strdup(parts), lookups};
    ang_plan_pass *grown = pass.name && pass.parts ? realloc(plan->pass, (plan->pass_count + 1) * sizeof *grown) : NULL;
    if (!grown) {
        free(pass.name);
        free(pass.parts);
        return;
    }
    plan->pass = grown;
    grown[plan->pass_count++] = pass;
}

static void clear_items(ang_plan_items *items) {
    for (size_t i = 0; i < items->count; i++) {
        free(items->item[i].what);
        free(items->item[i].why);
        free(items->item[i].saves);
    }
    free(items->item);
}

void ang_plan_clear(ang_plan *plan) {
    clear_items(&plan->uses);
    clear_items(&plan->left_out);
    for (size_t i = 0; i < plan->pass_count; i++) {
        free(plan->pass[i].name);
        free(plan->pass[i].parts);
    }
    free(plan->pass);
    *plan = (ang_plan){0};
}
