/* A float framebuffer to render into and read from. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_TARGET_H
#define ANG_RENDER_TARGET_H

#include "core/render/context.h"
#include "core/scene/image.h"

#include <stdbool.h>
#include <stdint.h>

/* What a target has beside its colour. */
typedef enum ang_target_parts { ANG_TARGET_COUNTS = 1, ANG_TARGET_DEPTH = 2 } ang_target_parts;

/* RGBA32F in attachment 0; where counting R32F in attachment 1: field evaluations of each pixel; where wanted a depth
 * buffer of floats. GL's row j is the picture's row j from the top, so that nothing needs turning over.
 * Zero-initialise. */
typedef struct ang_target {
    unsigned framebuffer;
    unsigned colour;        /* 2D texture */
    unsigned counts, depth; /* renderbuffers; 0 where there is none */
    unsigned depth_only;    /* framebuffer with the depth alone, so that colour may be read while depth is written */
    unsigned parts;         /* ang_target_parts */
    int width, height;
} ang_target;

/* Whether this GL draws pictures of that size; false with ANG_LIMIT, saying how large they may be. */
bool ang_target_fits(ang_gl *gl, int width, int height, ang_error *err);
/* Makes the target fit, with `parts` of ang_target_parts; keeps it where it does already. False with ANG_LIMIT or
 * ANG_GL. */
bool ang_target_resize(ang_target *target, ang_gl *gl, int width, int height, unsigned parts, ang_error *err);
void ang_target_destroy(ang_target *target);
/* Reads rows [first, first + rows) into the same rows of `image`. */
void ang_target_read(const ang_target *target, int first, int rows, ang_image *image);
/* Adds up the counts of rows [first, first + rows): their sum, and the number of pixels above 0. `counts` has
 * room for rows * width floats. */
void ang_target_read_counts(const ang_target *target, int first, int rows, float *counts, uint64_t *sum,
                            uint64_t *pixels);

#endif
