/* The envelope of what a scene shows on the GL side: faces of a grid of cells, and the range of every ray between them
 * (Haferburg, "Object order empty space skipping in OpenGL 4"). Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_ENVELOPE_HULL_H
#define ANG_RENDER_ENVELOPE_HULL_H

#include "core/plan/block_grid.h"
#include "core/plan/hull.h"
#include "core/render/program.h"
#include "core/render/target.h"
#include "core/scene/clip_space.h"

/* Zero-initialise; owns its GL objects. */
typedef struct ang_envelope_hull {
    ang_hull_cells cells;
    unsigned capture;                 /* program that finds the faces */
    unsigned active;                  /* 3D texture, GL_R8UI: the cells */
    unsigned buffer, list;            /* packed faces, and their buffer texture */
    unsigned feedback, query, arrays; /* for capturing and drawing */
    unsigned framebuffer;             /* without pixels: a surfaceless context refuses to draw into none at all */
    size_t faces;                     /* in the buffer; 0: nothing shows */
    ang_target range;                 /* hull_range.glsl */
    /* what it was made for */
    uint64_t changes;
    int first[3], end[3];
    size_t budget;
    bool made_now; /* by the last update */
} ang_envelope_hull;

/* Makes the faces anew where the visible blocks, those inside the clip box or the budget are others than before. Where
 * even one cell has more faces than `budget`, cells.side is 0: the clip box bounds the rays. False with ANG_LIMIT,
 * ANG_GL. */
bool ang_envelope_hull_update(ang_envelope_hull *hull, ang_gl *gl, const ang_block_grid *grid,
                              const ang_ray_frame *frame, size_t budget, ang_error *err);

/* The programs' parts of the pass that draws the range; `cuts`: whether the clip plane cuts rays. */
void ang_envelope_hull_parts(ang_shader_source *vertex, ang_shader_source *fragment, bool cuts);
/* Draws it, for a picture of width x height, with that program. False with ANG_LIMIT, ANG_GL. */
bool ang_envelope_hull_draw(ang_envelope_hull *hull, ang_gl *gl, unsigned program, const ang_block_grid *grid,
                            const ang_ray_frame *frame, int width, int height, ang_error *err);
/* bounds_envelope.glsl; binds the range to texture unit `unit`. */
void ang_envelope_hull_bind(const ang_envelope_hull *hull, unsigned program, int unit);
void ang_envelope_hull_destroy(ang_envelope_hull *hull);

#endif
