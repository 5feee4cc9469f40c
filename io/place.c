#include "io/place.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

bool ang_place_beside_program(const char *relative, char *path, size_t size) {
    char program[PATH_MAX];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length < 0) length = 0;
    program[length] = '\0';
    char *slash = strrchr(program, '/');
    if (slash) slash[1] = '\0';
    int used = snprintf(path, size, "%s%s", slash ? program : "", relative);
    return used > 0 && (size_t)used < size && access(path, R_OK) == 0;
}
