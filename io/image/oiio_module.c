/* Opens the OpenImageIO module when a picture is read, written or written on. */
#include "io/image/encode.h"

#include <dlfcn.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Beside the program, above its tests, or where it is installed. By path, not by the program's run path, which
 * AddressSanitizer's dlopen does not follow. */
static void *open_module(void) {
    static const char *const places[] = {"", "../", "../lib/angioscope/"};
    char program[PATH_MAX], path[PATH_MAX + 64];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length < 0) length = 0;
    program[length] = '\0';
    char *slash = strrchr(program, '/');
    if (slash) slash[1] = '\0';
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        snprintf(path, sizeof path, "%s%s" ANG_OIIO_MODULE, program, places[i]);
        if (access(path, R_OK) == 0) return dlopen(path, RTLD_NOW | RTLD_LOCAL);
    }
    /* For the message: the plain name, which is not found. */
    return dlopen(ANG_OIIO_MODULE, RTLD_NOW | RTLD_LOCAL);
}

/* Opening the module again only finds it again, so that no handle need be kept. */
static const ang_oiio_functions *module(ang_code code, ang_error *err) {
    void *handle = open_module();
    const ang_oiio_functions *functions = handle ? dlsym(handle, ANG_OIIO_SYMBOL) : NULL;
    if (!functions)
        ang_fail(err, code, "the module for picture files cannot be opened (%s); install it again", dlerror());
    return functions;
}

bool ang_oiio_encode(const char *format, const ang_pixels *pixels, ang_bytes *out, ang_error *err) {
    const ang_oiio_functions *oiio = module(ANG_OUTPUT, err);
    return oiio && oiio->encode(format, pixels, out, err);
}

bool ang_oiio_read(const char *path, const char *format, ang_image *out, ang_error *err) {
    const ang_oiio_functions *oiio = module(ANG_INPUT, err);
    return oiio && oiio->read(path, format, out, err);
}

char *ang_oiio_text_of(const char *path, const char *format, const char *name, ang_error *err) {
    const ang_oiio_functions *oiio = module(ANG_INPUT, err);
    return oiio ? oiio->text_of(path, format, name, err) : NULL;
}

bool ang_oiio_text(float *mask, int width, int height, int x, int y, const char *text, int size, const char *font,
                   int align) {
    const ang_oiio_functions *oiio = module(ANG_OUTPUT, NULL);
    return oiio && oiio->text(mask, width, height, x, y, text, size, font, align);
}

bool ang_oiio_text_size(const char *text, int size, const char *font, int *text_width, int *top, int *bottom) {
    const ang_oiio_functions *oiio = module(ANG_OUTPUT, NULL);
    return oiio && oiio->text_size(text, size, font, text_width, top, bottom);
}
