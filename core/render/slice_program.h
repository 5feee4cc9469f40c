/* The programs of slicing, put together from parts for each scene. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_SLICE_PROGRAM_H
#define ANG_RENDER_SLICE_PROGRAM_H

#include "core/plan/plan.h"
#include "core/render/method.h"
#include "core/render/program.h"

/* The passes over a picture. */
typedef enum ang_slice_pass {
    ANG_SLICE_INNER,   /* slices of boxes away from the faces */
    ANG_SLICE_FACES,   /* slices of boxes at the faces, where rays begin and end */
    ANG_SLICE_FINISH,  /* marks finished pixels for the early depth test */
    ANG_SLICE_RESOLVE, /* from accumulated values to grey */
    ANG_SLICE_EDGES,   /* --show-bricks */
} ang_slice_pass;

/* Whether the scene's mode needs the pass ANG_SLICE_RESOLVE: what it accumulates is no colour. */
bool ang_slice_needs_resolve(const ang_scene *scene);

/* The program of a pass; `counting` adds a second output, `early` forces the depth test before the shader. 0 with
 * ANG_GL or ANG_LIMIT. */
unsigned ang_slice_program(ang_programs *programs, ang_slice_pass pass, const ang_scene *scene,
                           const ang_volume *volume, const ang_render_options *options, bool early, bool counting,
                           ang_error *err);

/* Adds the pass with its parts and lookups to the plan. */
void ang_slice_explain_pass(ang_plan *plan, ang_slice_pass pass, const ang_scene *scene, const ang_volume *volume,
                            const ang_render_options *options, bool early);

#endif
