/* Pictures that need no library: portable pixmaps (Netpbm PPM, P6) and float maps (PFM). Private to io/image/. */
#ifndef ANG_IO_IMAGE_PORTABLE_H
#define ANG_IO_IMAGE_PORTABLE_H

#include "io/image/encode.h"

/* `rgb`: width * height * 3 floats, rows from the top. False with ANG_LIMIT. Thread safe. */
bool ang_ppm_encode(int width, int height, const float *rgb, ang_bytes *out, ang_error *err);
bool ang_pfm_encode(int width, int height, const float *rgb, ang_bytes *out, ang_error *err);
/* Either kind, by its first bytes; see ang_picture_read. */
bool ang_portable_read(const char *path, ang_image *out, ang_error *err);

#endif
