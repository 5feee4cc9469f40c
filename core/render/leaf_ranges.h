/* The ranges of an octree's leaves by compute shader. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_LEAF_RANGES_H
#define ANG_RENDER_LEAF_RANGES_H

#include "core/render/volume_texture.h"
#include "core/volume/octree.h"

/* Whether this OpenGL's storage buffers hold the ranges of that many leaves. The context must be current. */
bool ang_leaf_ranges_fit(const int dims[3]);

/* Fills the leaves of a tree with apron 1 from the texture of the whole volume: the same as ang_octree_build. Worth it
 * where the texture's memory is faster than the processor's. False with ANG_GL. */
bool ang_leaf_ranges_compute(ang_gl *gl, const ang_volume_texture *field, ang_octree *octree, ang_error *err);

#endif
