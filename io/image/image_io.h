/* Pictures to files and back. The format follows the extension. */
#ifndef ANG_IO_IMAGE_IMAGE_IO_H
#define ANG_IO_IMAGE_IMAGE_IO_H

#include "core/base/error.h"
#include "core/scene/image.h"

#include <stddef.h>

/* Writes `image` (premultiplied) over `background` (r, g, b, a in 0..1, not premultiplied). Values are display-referred
 * and written as they are, without a colour transform. By extension, in any case:
 *   .png        8 bit, unassociated alpha, round(255 x) of the clipped value; RGB only where every pixel is opaque
 *   .tif .tiff  8 bit, the same
 *   .exr        float, alpha associated (premultiplied), not clipped: over a background of alpha 0 exactly
 *               what was computed
 *   .ppm        8 bit RGB, premultiplied: what is not opaque shows black below
 *   .pfm        float RGB, premultiplied, not clipped, little endian
 * No metadata beside the program's name and, in PNG, that colours are sRGB. The file appears whole or not at all. False
 * with ANG_OUTPUT naming the file and the system's reason, with ANG_USAGE for an extension that is not known or a
 * format that this build leaves out, with ANG_LIMIT where memory is out. Thread safe. */
bool ang_image_write(const char *path, const ang_image *image, const double background[4], ang_error *err);
/* The same with `state` (text; NULL: none), which repeats the picture, in the file where its format has room: in .png
 * and .exr under the name ANG_IMAGE_STATE. */
bool ang_image_write_stated(const char *path, const ang_image *image, const double background[4], const char *state,
                            ang_error *err);
#define ANG_IMAGE_STATE "angioscope_state"
/* The state that a picture carries. NULL with ANG_USAGE where it carries none or is no .png or .exr, ANG_INPUT where it
 * cannot be read, ANG_LIMIT. Free with free(). Thread safe. */
char *ang_image_state(const char *path, ang_error *err);

/* What ang_image_write rounds by at most, in levels of the premultiplied picture: 0.5 for formats of 8 bits, 1 where
 * colour and alpha are both rounded (unassociated alpha over a background that is not opaque), 0 for floats. */
double ang_image_rounding(const char *path, const double background[4]);

/* The bytes of the PNG file that ang_image_write_stated would write, into *data (free with free()). False with
 * ANG_LIMIT, ANG_USAGE. Thread safe. */
bool ang_image_png(const ang_image *image, const double background[4], const char *state, unsigned char **data,
                   size_t *size, ang_error *err);

/* The picture as 8 bits a channel, red, green and blue, rows from the top, into *rgb (free with free()): what is in the
 * .png, and where that is not opaque over black. False with ANG_LIMIT. Thread safe. */
bool ang_image_rgb(const ang_image *image, const double background[4], unsigned char **rgb, ang_error *err);

/* False where ang_image_write would fail as things stand, with ANG_USAGE for the extension of `path` and ANG_OUTPUT for
 * its folder: to be asked before long work. Thread safe. */
bool ang_image_writable(const char *path, ang_error *err);

/* Reads PNG, TIFF, EXR, PPM (P6, 8 bit) or PFM (PF) into a new premultiplied float RGBA picture; grey becomes three
 * equal channels, no alpha becomes 1, unassociated alpha is multiplied in. Free `out` with ang_image_clear. False with
 * ANG_INPUT (unreadable, another format), ANG_USAGE (left out of this build), ANG_LIMIT. Thread safe. */
bool ang_picture_read(const char *path, ang_image *out, ang_error *err);

#endif
