/* Encoders behind image_io.h: from pixels to the bytes of a file. Private to io/image/. */
#ifndef ANG_IO_IMAGE_ENCODE_H
#define ANG_IO_IMAGE_ENCODE_H

#include "core/base/error.h"
#include "core/scene/image.h"
#include "io/voxels/sample.h"

#include <stddef.h>

/* Bytes of a whole file; free `data` with free(). */
typedef struct ang_bytes {
    unsigned char *data;
    size_t size;
} ang_bytes;

/* OpenImageIO, for all but the writing of PNG, lies in a module of its own (angioscope-oiio.so), opened at
 * the first call of its functions below: with the 250 libraries that it brings it takes 0.2 s and 110 MB. */

/* Rows from the top of `channels` (3 or 4) values a pixel: unsigned char, alpha unassociated, where `is_float` is
 * false, else float, alpha associated. */
typedef struct ang_pixels {
    int width, height, channels;
    bool is_float;
    const void *data;
    const char *state; /* text to go with it as ANG_IMAGE_STATE, in png and openexr; NULL: none */
} ang_pixels;

/* A PNG file of pixels that are not float. False with ANG_LIMIT.
 * Thread safe. */
bool ang_png_encode(const ang_pixels *pixels, ang_bytes *out, ang_error *err);

/* `format` is "tiff" or "openexr". False with ANG_OUTPUT, ANG_LIMIT. Thread safe. */
bool ang_oiio_encode(const char *format, const ang_pixels *pixels, ang_bytes *out, ang_error *err);
/* Reads `path` with the reader `format`; see ang_picture_read. */
bool ang_oiio_read(const char *path, const char *format, ang_image *out, ang_error *err);

/* Draws a line of text (UTF-8) into `mask` (width * height coverages in 0..1, rows from the top; the larger of what is
 * there and the text's coverage is kept), its baseline at (x, y) in pixels. `align` is -1, 0 or 1: x is the left end,
 * the middle or the right end. False where the font cannot be used. Thread safe. */
bool ang_oiio_text(float *mask, int width, int height, int x, int y, const char *text, int size, const char *font,
                   int align);
/* The text's extent in pixels relative to its baseline: `top` is negative. False as above. */
bool ang_oiio_text_size(const char *text, int size, const char *font, int *text_width, int *top, int *bottom);

/* A picture file as a stack of grey pages for voxels. */
typedef struct ang_grey_form {
    int width, height; /* of every page */
    int pages;
    ang_sample type;
} ang_grey_form;

/* Opens a PNG or TIFF file and tells its form; each page is asked for by ang_oiio_grey_read, in order or not, into
 * `out`: width x height samples of the form's type in the machine's byte order, as the file has them, rows from the
 * top. NULL or false with ANG_INPUT (unreadable, in colour, pages that differ), ANG_USAGE (left out of this build),
 * ANG_LIMIT. One thread at a time for each handle. */
void *ang_oiio_grey_open(const char *path, ang_grey_form *form, ang_error *err);
bool ang_oiio_grey_read(void *handle, int page, void *out, ang_error *err);
void ang_oiio_grey_close(void *handle);

/* What the module exports under this name (ANG_OIIO_SYMBOL): the functions above. */
typedef struct ang_oiio_functions {
    bool (*encode)(const char *format, const ang_pixels *pixels, ang_bytes *out, ang_error *err);
    bool (*read)(const char *path, const char *format, ang_image *out, ang_error *err);
    bool (*text)(float *mask, int width, int height, int x, int y, const char *text, int size, const char *font,
                 int align);
    bool (*text_size)(const char *text, int size, const char *font, int *text_width, int *top, int *bottom);
    /* `bytes` of a whole file, kept until it is closed, of which `path` is only the name; NULL: the file itself. */
    void *(*grey_open)(const char *path, const void *bytes, size_t size, ang_grey_form *form, ang_error *err);
    bool (*grey_read)(void *handle, int page, void *out, ang_error *err);
    void (*grey_close)(void *handle);
    /* No threads from now on, and everything in place for which files would be opened. */
    void (*grey_settle)(void);
} ang_oiio_functions;
#define ANG_OIIO_MODULE "angioscope-oiio.so"
#define ANG_OIIO_SYMBOL "ang_oiio_module"

#endif
