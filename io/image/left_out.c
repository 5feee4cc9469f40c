/* The encoders that a build lacks: they say so. image_io.c, which knows the file, refuses most formats first. */
#include "io/image/encode.h"

#ifndef ANG_WITH_PNG
bool ang_png_encode(const ang_pixels *pixels, ang_bytes *out, ang_error *err) {
    (void)pixels, (void)out;
    return ang_fail(err, ANG_USAGE, "this build has no libpng (ANG_WITH_PNG)");
}
#endif

#ifndef ANG_WITH_OIIO
static bool refuse(ang_error *err) { return ang_fail(err, ANG_USAGE, "this build has no OpenImageIO (ANG_WITH_OIIO)"); }

bool ang_oiio_encode(const char *format, const ang_pixels *pixels, ang_bytes *out, ang_error *err) {
    (void)format, (void)pixels, (void)out;
    return refuse(err);
}

bool ang_oiio_read(const char *path, const char *format, ang_image *out, ang_error *err) {
    (void)path, (void)format, (void)out;
    return refuse(err);
}

void *ang_oiio_grey_open(const char *path, ang_grey_form *form, ang_error *err) {
    (void)path, (void)form;
    refuse(err);
    return NULL;
}

bool ang_oiio_grey_read(void *handle, int page, void *out, ang_error *err) {
    (void)handle, (void)page, (void)out;
    return refuse(err);
}

void ang_oiio_grey_close(void *handle) { (void)handle; }
#endif
