#include "io/place.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/auxv.h>
#include <unistd.h>

/* The path of the program with its links followed; false where it cannot be known. */
static bool find_program(char path[PATH_MAX]) {
    ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - 1);
    if (length > 0) {
        path[length] = '\0';
        return true;
    }
    /* Without /proc, as in a bare chroot: the name by which the kernel was told to start it. */
    const char *started = (const char *)getauxval(AT_EXECFN);
    return started && realpath(started, path);
}

bool ang_place_beside_program(const char *relative, char *path, size_t size) {
    char program[PATH_MAX];
    if (!find_program(program)) return false;
    int folder = (int)(strrchr(program, '/') - program) + 1;
    int used = snprintf(path, size, "%.*s%s", folder, program, relative);
    return used > 0 && (size_t)used < size && access(path, R_OK) == 0;
}
