/* Small pictures with their names, in rows on one. */
#ifndef ANG_IO_IMAGE_SHEET_H
#define ANG_IO_IMAGE_SHEET_H

#include "core/base/error.h"
#include "core/base/notes.h"
#include "core/scene/image.h"

#include <stddef.h>

/* Puts `count` >= 1 pictures of one size, over black, into as many columns as make the sheet about 3 : 2, from the left
 * top, each with its name below; names that are too long are cut. Without OpenImageIO or the font DejaVu Sans there are
 * no names and `warnings` says so. False with ANG_LIMIT, also where the sheet has more than 65535 pixels a side. Free
 * `sheet` with ang_image_clear. Thread safe. */
bool ang_image_sheet(const ang_image *pictures, const char *const *names, size_t count, ang_image *sheet,
                     ang_notes *warnings, ang_error *err);

#endif
