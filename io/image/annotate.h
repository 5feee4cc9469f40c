/* Draws an annotation onto a picture. */
#ifndef ANG_IO_IMAGE_ANNOTATE_H
#define ANG_IO_IMAGE_ANNOTATE_H

#include "core/base/error.h"
#include "core/base/notes.h"
#include "core/scene/annotation.h"
#include "core/scene/image.h"

/* Writes letters at the middles of the four edges, the bar with its label at the bottom right, and the caption with
 * the remark above it at the bottom left onto `image`, white with a thin dark outline
 * or the other way round. Drawn over the premultiplied picture before the background,
 * which gives the same as drawing over the finished one. Letters are height / 40 pixels high, at least 11; what has no
 * room is left out, and `warnings` says so. Measure errors before this, not after. Text needs OpenImageIO and the font
 * DejaVu Sans (fonts-dejavu-core): without either nothing is drawn and `warnings` (may be NULL) says so. False
 * with ANG_LIMIT. Thread safe for different images. */
bool ang_image_annotate(ang_image *image, const ang_annotation *annotation, ang_notes *warnings, ang_error *err);

#endif
