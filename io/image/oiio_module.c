/* Opens the OpenImageIO module when a picture is read, written or written on. */
#include "io/image/encode.h"

#include "io/module.h"

static const ang_oiio_functions *module(ang_code code, ang_error *err) {
    return ang_module_symbol(ANG_OIIO_MODULE, ANG_OIIO_SYMBOL, "picture files", code, err);
}

bool ang_oiio_encode(const char *format, const ang_pixels *pixels, ang_bytes *out, ang_error *err) {
    const ang_oiio_functions *oiio = module(ANG_OUTPUT, err);
    return oiio && oiio->encode(format, pixels, out, err);
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

void *ang_oiio_grey_open(const char *path, ang_grey_form *form, ang_error *err) {
    const ang_oiio_functions *oiio = module(ANG_INPUT, err);
    return oiio ? oiio->grey_open(path, NULL, 0, form, err) : NULL;
}

bool ang_oiio_grey_read(void *handle, int page, void *out, ang_error *err) {
    const ang_oiio_functions *oiio = module(ANG_INPUT, err);
    return oiio && oiio->grey_read(handle, page, out, err);
}

void ang_oiio_grey_close(void *handle) {
    const ang_oiio_functions *oiio = module(ANG_INPUT, NULL);
    if (oiio) oiio->grey_close(handle);
}
