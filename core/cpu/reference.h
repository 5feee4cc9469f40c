/* The truth that every method is judged by: double precision, every cell boundary and every knot of the transfer
 * function on the ray found, each piece between them integrated adaptively to 1e-10 (with Phong 1e-6); maxima and iso
 * hits exact per cell. No octree and no tables, so that it shares no mistake with them. Conventions: DESIGN.md, "Scene
 * conventions". */
#ifndef ANG_CPU_REFERENCE_H
#define ANG_CPU_REFERENCE_H

#include "core/base/progress.h"
#include "core/scene/image.h"
#include "core/scene/scene.h"

#include <stdint.h>

typedef struct ang_reference ang_reference;

/* Borrows volume and scene, which must outlive it and not change. NULL with ANG_USAGE
 * (ang_scene_check), ANG_LIMIT, ANG_GEOMETRY. */
ang_reference *ang_reference_create(const ang_volume *volume, const ang_scene *scene, ang_error *err);
void ang_reference_free(ang_reference *reference);

/* The colour through picture coordinates (x, y) (pixel centres at + 0.5): premultiplied RGBA before the background, not
 * clipped. Adds the evaluations of the field to *samples where not NULL. Thread safe. */
void ang_reference_pixel(const ang_reference *reference, double x, double y, double rgba[4], uint64_t *samples);

/* Fills, in parallel, the pixels of `image` (of the scene's size) whose alpha is not a number, so that a picture once
 * interrupted goes on where it was. Adds the evaluations to *samples where not NULL. False with ANG_INTERRUPTED. */
bool ang_reference_fill(const ang_reference *reference, ang_image *image, int threads, const ang_progress *progress,
                        uint64_t *samples, ang_error *err);
/* Marks every pixel of `image` as not yet filled. */
void ang_reference_blank(ang_image *image);

#endif
