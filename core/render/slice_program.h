/* The programs of slicing, put together from parts for each scene. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_SLICE_PROGRAM_H
#define ANG_RENDER_SLICE_PROGRAM_H

#include "core/plan/plan.h"
#include "core/render/method.h"
#include "core/render/program.h"
#include "core/render/table_texture.h"

/* The passes over a picture. */
typedef enum ang_slice_pass {
    ANG_SLICE_INNER,   /* slices of boxes away from the faces */
    ANG_SLICE_FACES,   /* slices of boxes at the faces, where rays begin and end */
    ANG_SLICE_FINISH,  /* marks finished pixels for the early depth test */
    ANG_SLICE_RESOLVE, /* from accumulated values to grey */
    ANG_SLICE_EDGES,   /* --show-bricks */
} ang_slice_pass;

/* Planes that a fragment composites before it blends: 1, 2 or 4, those asked for or as many as pay. */
int ang_slice_group(const ang_scene *scene, const ang_render_options *options);

/* Whether the scene's mode needs the pass ANG_SLICE_RESOLVE: what it accumulates is no colour. */
bool ang_slice_needs_resolve(const ang_scene *scene);

/* What the programs of one picture are made for. Borrows all. */
typedef struct ang_slice_recipe {
    const ang_scene *scene;
    const ang_volume *volume;
    const ang_render_options *options;
    const ang_table_texture *table;
    const ang_plan_decisions *plan[2]; /* away from the faces, at the faces; early termination: the depth test comes
                                          before the shader */
    bool counting;                     /* a second output counts samples */
} ang_slice_recipe;

/* The program of a pass; 0 with ANG_GL or ANG_LIMIT. */
unsigned ang_slice_program(ang_programs *programs, ang_slice_pass pass, const ang_slice_recipe *recipe, ang_error *err);

/* Adds the pass with its parts and lookups to the plan. */
void ang_slice_explain_pass(ang_plan *plan, ang_slice_pass pass, const ang_slice_recipe *recipe);

#endif
