#include "core/render/method.h"

#include <string.h>

static const ang_method *const methods[] = {&ang_method_singlepass, &ang_method_slicing, &ang_method_reference, NULL};

const ang_method *const *ang_methods(void) { return methods; }

const ang_method *ang_method_find(const char *name) {
    for (size_t i = 0; methods[i]; i++)
        if (strcmp(methods[i]->name, name) == 0) return methods[i];
    return NULL;
}
