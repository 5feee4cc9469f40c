#include "io/module.h"

#include "io/place.h"

#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>

bool ang_module_path(const char *file, char *path, size_t size) {
    static const char *const places[] = {"", "../", "../lib/angioscope/"};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        char relative[NAME_MAX + 32];
        snprintf(relative, sizeof relative, "%s%s", places[i], file);
        if (ang_place_beside_program(relative, path, size)) return true;
    }
    return false;
}

/* By path, not by the program's run path, which AddressSanitizer's dlopen does not follow. */
static void *open_module(const char *file) {
    char path[PATH_MAX];
    /* Where it is missing by the plain name, which is not found either: for the message. */
    return dlopen(ang_module_path(file, path, sizeof path) ? path : file, RTLD_NOW | RTLD_LOCAL);
}

/* Opening a module again only finds it again, so that no handle need be kept. */
const void *ang_module_symbol(const char *file, const char *symbol, const char *what, ang_code code, ang_error *err) {
    void *handle = open_module(file);
    const void *found = handle ? dlsym(handle, symbol) : NULL;
    if (!found) ang_fail(err, code, "the module for %s cannot be opened (%s); install it again", what, dlerror());
    return found;
}
