/* The texts that pictures carry, without their pixels being looked at. Private to io/. */
#ifndef ANG_IMAGE_PICTURE_TEXT_H
#define ANG_IMAGE_PICTURE_TEXT_H

#include "core/base/error.h"

/* Own code, since what reads whole pictures takes memory for what their headers claim. The text of this name in a PNG
 * (tEXt, zTXt, iTXt: PNG specification, 11.3.3) or OpenEXR file (a string attribute of its first header); at most 16
 * MB. NULL with ANG_USAGE where there is none, ANG_INPUT where the file cannot be read, ANG_LIMIT. Free with free().
 * Thread safe. */
char *ang_png_text(const char *path, const char *name, ang_error *err);
char *ang_exr_text(const char *path, const char *name, ang_error *err);

#endif
