/* What slicing's files share; only slicing*.c include it. */
#ifndef ANG_RENDER_SLICING_PRIVATE_H
#define ANG_RENDER_SLICING_PRIVATE_H

#include "core/plan/boxes.h"
#include "core/render/brick_store.h"
#include "core/render/limit_texture.h"
#include "core/render/method.h"
#include "core/render/slice_geometry.h"
#include "core/render/slice_program.h"
#include "core/render/table_texture.h"
#include "core/render/target.h"

struct ang_renderer {
    ang_gl *gl;
    const ang_volume *volume;
    ang_brick_store store;
    ang_table_texture table;
    ang_limit_texture limits; /* opaque geometry */
    ang_programs programs;
    ang_target accumulated, resolved;
    ang_slice_geometry geometry;
    ang_slice_boxes boxes;
    ang_octree *octree;
    unsigned vertices;    /* no attributes, but a draw needs one bound */
    unsigned query;       /* counts finished pixels */
    unsigned invocations; /* counts fragments */
    char note[1024];      /* what the user should know */
};

/* All that is decided about one picture before anything is drawn. */
typedef struct ang_slicing {
    ang_ray_frame frame;
    ang_clip_space space;
    ang_slice_planes planes;
    ang_vec3 margin; /* index units: see step_margin */
    double length;   /* mm of a ray from one plane to the next, at most */
    int group;       /* planes that share a polygon */
    ang_visibility visibility;
    ang_brick_needs needs;
    ang_slice_order order;
    ang_plan_facts facts;
    ang_plan_decisions plan, plan_at_faces;
    bool skips, finishes; /* what `plan` says, in short */
    bool whole_steps;     /* ang_scene_whole_steps */
    double octree_ms;
} ang_slicing;

/* Decides everything up to the boxes, and brings octree, tables and store up to date: what drawing and explaining
 * share. False as ang_method's `render`. */
bool ang_slicing_decide(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                        ang_slicing *s, ang_error *err);
/* What the programs of this picture are made for. */
ang_slice_recipe ang_slicing_recipe(const ang_renderer *renderer, const ang_scene *scene,
                                    const ang_render_options *options, const ang_slicing *s, bool counting);
/* ang_method's `explain`. */
bool ang_slicing_explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                         ang_plan *plan, ang_error *err);

#endif
