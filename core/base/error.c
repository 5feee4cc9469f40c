#include "core/base/error.h"

#include <stdarg.h>
#include <stdio.h>

bool ang_fail(ang_error *err, ang_code code, const char *format, ...) {
    if (!err) return false;
    err->code = code;
    va_list args;
    va_start(args, format);
    vsnprintf(err->message, sizeof err->message, format, args);
    va_end(args);
    return false;
}
