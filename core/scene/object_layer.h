/* The opaque geometry of one picture, pixel by pixel: where rays end, and what lies behind the volume there. */
#ifndef ANG_SCENE_OBJECT_LAYER_H
#define ANG_SCENE_OBJECT_LAYER_H

#include "core/scene/image.h"
#include "core/scene/objects.h"

/* Zero-initialise; owns its lists. */
typedef struct ang_object_layer {
    int width, height;
    float *limit_mm; /* width * height, rows from the top: mm along the ray; ANG_NO_LIMIT where it meets no object */
    float *colour;   /* 3 * width * height: r, g, b in 0..1, undefined where none is met */
} ang_object_layer;

/* Beyond any ray. */
#define ANG_NO_LIMIT 1e30F

/* Fills the layer for the scene's objects, which must be some, in parallel; keeps its memory where the size is the
 * same. False with ANG_LIMIT. */
bool ang_object_layer_make(ang_object_layer *layer, const ang_volume *volume, const ang_scene *scene,
                           const ang_ray_frame *frame, int threads, ang_error *err);
/* Frees what it holds and makes it empty. */
void ang_object_layer_clear(ang_object_layer *layer);

/* Lays the objects under the premultiplied picture of what lies before them (modes that limit rays), or over it. */
void ang_object_layer_join(const ang_object_layer *layer, const ang_scene *scene, ang_image *image);

#endif
