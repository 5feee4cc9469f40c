#include "io/module.h"

#include "io/place.h"

#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>

/* By path, not by the program's run path, which AddressSanitizer's dlopen does not follow. */
static void *open_module(const char *file) {
    static const char *const places[] = {"", "../", "../lib/angioscope/"};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        char relative[NAME_MAX + 32], path[PATH_MAX];
        snprintf(relative, sizeof relative, "%s%s", places[i], file);
        if (ang_place_beside_program(relative, path, sizeof path)) return dlopen(path, RTLD_NOW | RTLD_LOCAL);
    }
    /* For the message: the plain name, which is not found. */
    return dlopen(file, RTLD_NOW | RTLD_LOCAL);
}

/* Opening a module again only finds it again, so that no handle need be kept. */
const void *ang_module_symbol(const char *file, const char *symbol, const char *what, ang_code code, ang_error *err) {
    void *handle = open_module(file);
    const void *found = handle ? dlsym(handle, symbol) : NULL;
    if (!found) ang_fail(err, code, "the module for %s cannot be opened (%s); install it again", what, dlerror());
    return found;
}
