/* Opens the OpenImageIO module when a picture is read, written or written on. */
#include "io/image/encode.h"

#include <dlfcn.h>

/* The module lies in the program's run path. Opening it again only finds it again, so that no handle need be kept. */
static const ang_oiio_functions *module(ang_code code, ang_error *err) {
    void *handle = dlopen(ANG_OIIO_MODULE, RTLD_NOW | RTLD_LOCAL);
    const ang_oiio_functions *functions = handle ? dlsym(handle, ANG_OIIO_SYMBOL) : NULL;
    if (!functions)
        ang_fail(err, code, "the module for picture files cannot be opened (%s); install it again", dlerror());
    return functions;
}

bool ang_oiio_encode(const char *format, int width, int height, int channels, bool is_float, const void *pixels,
                     ang_bytes *out, ang_error *err) {
    const ang_oiio_functions *oiio = module(ANG_OUTPUT, err);
    return oiio && oiio->encode(format, width, height, channels, is_float, pixels, out, err);
}

bool ang_oiio_read(const char *path, const char *format, ang_image *out, ang_error *err) {
    const ang_oiio_functions *oiio = module(ANG_INPUT, err);
    return oiio && oiio->read(path, format, out, err);
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
