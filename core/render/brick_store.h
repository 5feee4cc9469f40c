/* Where slicing's voxels lie: in one 3D texture, or in one per brick (Rezk-Salama & Kolb 2005, sections 3.1 and 6).
 * Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_BRICK_STORE_H
#define ANG_RENDER_BRICK_STORE_H

#include "core/render/volume_texture.h"
#include "core/volume/octree.h"

/* What textures hold beside a brick's own voxels. */
typedef struct ang_brick_needs {
    int reach;   /* voxels beyond the brick on each side: 1 for gradients, steps of a ray for iso-surfaces */
    bool weight; /* the padding's weight too */
} ang_brick_needs;

/* Zero-initialise. Bricks are nodes of one level of an octree, all textures of one size. Textures are filled when they
 * are asked for; where the budget is full one makes room that is not needed soon, so that a still view that needs more
 * bricks than fit uploads only those that do not. */
typedef struct ang_brick_store {
    ang_gl *gl;
    const ang_volume *volume;
    size_t budget;              /* bytes; 0: none given */
    bool whole;                 /* one texture */
    char reason[160];           /* why the volume is in bricks; empty where it is whole */
    ang_volume_texture texture; /* whole */

    const ang_octree *octree; /* whose nodes are bricks */
    int leaf[3];              /* its leaves, when the bricks were laid out */
    int level;
    ang_brick_needs needs;
    int dims[3]; /* texels of a brick */
    struct ang_brick_slot *slot;
    size_t slots, used;
    uint64_t clock;   /* counts what is asked for */
    uint64_t picture; /* counts ang_brick_store_arrange */
    uint64_t uploads; /* bricks filled since the store was made */
} ang_brick_store;

/* Takes one texture where it fits OpenGL's limit and the budget, and fills it; else bricks, none filled yet. False with
 * ANG_LIMIT. */
bool ang_brick_store_make(ang_brick_store *store, ang_gl *gl, const ang_volume *volume, size_t budget, ang_error *err);
void ang_brick_store_destroy(ang_brick_store *store);

/* Prepares for drawing a picture with this octree; its boxes must then come in an order that is done with one brick
 * before it begins the next. Bricks are nodes of about 128 cells a side, smaller where the budget holds too
 * few of those; what they held stays where nothing has changed. False with ANG_LIMIT where the budget does not hold
 * even the least brick, naming what it must be. */
bool ang_brick_store_arrange(ang_brick_store *store, const ang_octree *octree, ang_brick_needs needs, ang_error *err);

/* The texture in which node (x,y,z) of `level`, at or below the level of bricks, lies; valid until the next call. NULL
 * with ANG_LIMIT. */
const ang_volume_texture *ang_brick_store_get(ang_brick_store *store, int level, const int node[3], ang_error *err);

/* The highest level whose nodes lie in one texture each. */
int ang_brick_store_level(const ang_brick_store *store);
/* Whether two nodes lie in the same texture. */
bool ang_brick_store_same(const ang_brick_store *store, int level_a, const int a[3], int level_b, const int b[3]);

#endif
