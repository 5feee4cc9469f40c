/* What slicing decides about a picture before anything is drawn, and how it explains that. */
#include "core/render/slicing_private.h"

#include "core/base/clock.h"
#include "core/render/scene_parts.h"

#include <string.h>

/* Voxels: no farther from any voxel is another. */
static double most_reach(const ang_volume *volume) {
    const int *dims = volume->dims;
    return fmax(dims[0], fmax(dims[1], dims[2]));
}

/* What a polygon costs in fragments, without and with shading: measured on llvmpipe (docs/papers.md). */
static const double polygon_cost = 300, polygon_cost_shaded = 120;
/* Work is handed to OpenGL in pieces of about this many fragments, so that it can be interrupted... */
static const double piece_samples = 8e6;
/* ... and pixels that are finished are looked for about this often in a picture, but not for less than this many
 * fragments a pixel: a look costs about four. */
static const double finish_looks = 12, finish_least = 8;

/* Millimetres that a ray moves from one plane to the next, at most. */
static double step_length(const ang_scene *scene, const ang_ray_frame *frame, const ang_slice_planes *planes) {
    double least_cosine = 1;
    for (int corner = 0; corner < 4; corner++) {
        ang_ray ray = ang_ray_through(frame, corner & 1 ? scene->width : 0, corner & 2 ? scene->height : 0);
        least_cosine = fmin(least_cosine, ang_vec3_dot(ray.direction_mm, frame->axis_mm));
    }
    return 1.01 * planes->distance / fmax(least_cosine, 1e-3);
}

/* The same in index units along each axis. */
static ang_vec3 step_margin(const ang_ray_frame *frame, double length) {
    double margin[3];
    for (int axis = 0; axis < 3; axis++) {
        const double *row = frame->to_index.m[axis];
        margin[axis] = length * sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
    }
    return (ang_vec3){margin[0], margin[1], margin[2]};
}

/* Voxels: where a ray moves farther from plane to plane, looking for the hits of an iso-surface between them makes
 * blocks so much larger that leaving out the rest pays no more. */
enum { MOST_ISO_APRON = 17 };

static bool prepare_octree(ang_renderer *renderer, const ang_render_options *options, ang_slicing *s, ang_error *err) {
    const ang_volume *volume = renderer->volume;
    int leaf[3], apron = 1;
    /* A hit before a plane shows at that plane: what lies a step before it must count as well. */
    if (s->visibility.mode == ANG_MODE_ISO) apron += s->needs.reach;
    if (apron > MOST_ISO_APRON) apron = 1; /* decide_skipping() skips nothing then */
    for (int axis = 0; axis < 3; axis++) {
        int cells = volume->dims[axis] > 1 ? volume->dims[axis] - 1 : 1, bricks = options->bricks[axis];
        leaf[axis] = bricks > 0 ? (cells + bricks - 1) / bricks : ANG_OCTREE_LEAF;
        if (leaf[axis] > cells) leaf[axis] = cells;
    }
    ang_octree *now = renderer->octree;
    if (now && memcmp(now->leaf, leaf, sizeof leaf) == 0 && now->apron == apron) return true;
    ang_octree_free(now);
    double start = ang_now_ms();
    renderer->octree = ang_octree_build(volume, leaf, apron, options->threads, err);
    s->octree_ms = ang_now_ms() - start;
    return renderer->octree != NULL;
}

static void decide_skipping(const ang_renderer *renderer, const ang_render_options *options, ang_slicing *s) {
    s->why_no_skip = NULL;
    if (options->no_skip)
        s->why_no_skip = "--no-skip";
    else if (s->visibility.mode == ANG_MODE_MEAN)
        s->why_no_skip = "every value counts in a mean";
    else if (s->visibility.mode == ANG_MODE_ISO && s->needs.reach + 1 > MOST_ISO_APRON)
        s->why_no_skip = "the planes are so far apart that a hit may lie blocks before its plane";
    else if (ang_visibility_of_all(&s->visibility, renderer->octree->level[renderer->octree->levels - 1].nodes[0]))
        s->why_no_skip = "nothing in the volume is invisible";
    s->skips = !s->why_no_skip;
}

/* Looks for finished pixels are left out where they cannot pay. */
static void decide_finishing(const ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                             ang_slicing *s) {
    s->why_no_finish = ang_scene_why_no_termination(scene, renderer->volume, &renderer->table, options->termination);
    if (scene->mode == ANG_MODE_ISO)
        s->why_no_finish = "the depth test itself keeps the nearest hit";
    else if (!s->why_no_finish && renderer->boxes.samples < finish_least * scene->width * scene->height)
        s->why_no_finish = "there are too few fragments to spare any";
    s->finishes = !s->why_no_finish;
}

static bool same_texture(const void *context, const ang_slice_box *a, const ang_slice_box *b) {
    return ang_brick_store_same(context, a->block.level, a->block.first, b->block.level, b->block.first);
}

static void decide_order(const ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                         ang_slicing *s) {
    s->order = (ang_slice_order){.proxy = options->proxy,
                                 .back_to_front = scene->mode == ANG_MODE_DVR && !s->finishes,
                                 .group = s->group,
                                 .margin = s->margin,
                                 .most_samples = piece_samples,
                                 .same_texture = same_texture,
                                 .context = &renderer->store};
    if (s->finishes) {
        double least = finish_least * scene->width * scene->height;
        s->order.most_samples = fmin(fmax(renderer->boxes.samples / finish_looks, least), piece_samples);
    }
}

/* Everything up to the boxes: what render() and explain() share. */
bool ang_slicing_decide(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                        ang_slicing *s, ang_error *err) {
    *s = (ang_slicing){0};
    const ang_volume *volume = renderer->volume;
    if (!(options->step_voxels > 0))
        return ang_fail(err, ANG_USAGE, "--step %g: give a positive multiple of the smallest spacing",
                        options->step_voxels);
    if (options->pass_steps > 2 && options->pass_steps != 4)
        return ang_fail(err, ANG_USAGE,
                        "--passes-steps %d: slicing composites 1, 2 or 4 planes in a fragment; 0: as "
                        "many as pay",
                        options->pass_steps);
    if (!ang_scene_check(scene, err) || !ang_ray_frame_make(volume, scene, &s->frame, err)) return false;
    if (ang_scene_needs_table(scene) &&
        !ang_table_texture_update(&renderer->table, renderer->gl, scene->transfer, volume, err))
        return false;
    if (!ang_limit_texture_update(&renderer->limits, renderer->gl, volume, scene, &s->frame, options->threads, err))
        return false;
    s->space = ang_clip_space_make(&s->frame, scene->width, scene->height);
    s->planes = ang_slice_planes_make(&s->frame, options->step_voxels * ang_volume_smallest_spacing(volume));
    s->visibility = ang_visibility_make(volume, scene, renderer->table.tables);
    s->needs.weight = ang_scene_needs_weight(scene, volume);
    s->needs.reach = ang_scene_needs_phong(scene);
    s->length = step_length(scene, &s->frame, &s->planes);
    s->margin = step_margin(&s->frame, s->length);
    if (scene->mode == ANG_MODE_ISO)
        s->needs.reach += (int)fmin(ceil(fmax(s->margin.x, fmax(s->margin.y, s->margin.z))), most_reach(volume));
    if (!prepare_octree(renderer, options, s, err) ||
        !ang_brick_store_arrange(&renderer->store, renderer->octree, s->needs, err))
        return false;
    decide_skipping(renderer, options, s);
    s->group = ang_slice_group(scene, options);
    bool shaded = ang_scene_needs_phong(scene);
    ang_slice_cut cut = {.visibility = s->skips ? &s->visibility : NULL,
                         .to_leaves = options->bricks[0] > 0,
                         .top_level = ang_brick_store_level(&renderer->store),
                         .margin = s->margin,
                         .group = s->group,
                         .polygon_cost = shaded ? polygon_cost_shaded : polygon_cost};
    if (!ang_slice_boxes_make(&renderer->boxes, renderer->octree, &s->frame, &s->planes, &s->space, &cut, err))
        return false;
    decide_finishing(renderer, scene, options, s);
    decide_order(renderer, scene, options, s);
    return true;
}

ang_slice_recipe ang_slicing_recipe(const ang_renderer *renderer, const ang_scene *scene,
                                    const ang_render_options *options, const ang_slicing *s, bool counting) {
    return (ang_slice_recipe){scene, renderer->volume, options, &renderer->table, s->length, s->finishes, counting};
}

static void explain_storage(const ang_renderer *renderer, ang_plan *plan) {
    const ang_brick_store *store = &renderer->store;
    if (store->whole) {
        ang_plan_use(plan, "one 3D texture of 16 bits for the whole volume");
        ang_plan_leave_out(plan, "one texture a brick", "the volume fits into one");
    } else {
        ang_plan_use(plan, "one 3D texture of 16 bits a brick, since %s; invisible bricks are never uploaded",
                     store->reason);
    }
}

static void explain_boxes(const ang_renderer *renderer, const ang_slicing *s, const ang_render_options *options,
                          ang_plan *plan) {
    const ang_slice_boxes *boxes = &renderer->boxes;
    ang_plan_use(plan, "planes: %d, %.4g mm apart, %s", s->planes.count, s->planes.distance,
                 s->order.back_to_front ? "back to front" : "front to back");
    if (s->group > 1)
        ang_plan_use(plan, "%d planes composited by a fragment before it blends", s->group);
    else
        ang_plan_leave_out(plan, "compositing of planes before they blend", "%s",
                           s->visibility.mode == ANG_MODE_ISO ? "only the nearest hit shows"
                           : options->pass_steps == 1         ? "--passes-steps 1"
                                                              : "it does not pay with shading");
    ang_plan_use(plan, "polygons by %s: %.0f in %zu boxes, to which %zu of the octree's %zu leaves are joined",
                 ang_proxy_name(s->order.proxy), boxes->polygons, boxes->blocks, boxes->leaves_drawn,
                 boxes->leaves_total);
    if (!s->skips) ang_plan_leave_out(plan, "skipping of invisible boxes", "%s", s->why_no_skip);
    if (boxes->leaves_total > boxes->leaves_drawn)
        ang_plan_leave_out(plan, "parts of the volume",
                           "%zu of %zu leaves of the octree: %s%sthey lie outside the "
                           "picture or the clip box",
                           boxes->leaves_total - boxes->leaves_drawn, boxes->leaves_total,
                           s->skips ? ang_visibility_reason(s->visibility.mode) : "", s->skips ? ", or " : "");
}

bool ang_slicing_explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                         ang_plan *plan, ang_error *err) {
    ang_slicing s;
    if (!ang_slicing_decide(renderer, scene, options, &s, err)) return false;
    explain_storage(renderer, plan);
    explain_boxes(renderer, &s, options, plan);
    ang_scene_explain(plan, scene, renderer->volume);
    ang_slice_recipe recipe = ang_slicing_recipe(renderer, scene, options, &s, false);
    ang_slice_explain_pass(plan, ANG_SLICE_INNER, &recipe);
    ang_slice_explain_pass(plan, ANG_SLICE_FACES, &recipe);
    if (s.finishes) {
        ang_plan_use(plan, "early termination: where opacity reaches %g the depth test rejects what lies behind",
                     options->termination);
        ang_slice_explain_pass(plan, ANG_SLICE_FINISH, &recipe);
    } else {
        ang_plan_leave_out(plan, "early termination by the depth test", "%s", s.why_no_finish);
    }
    if (ang_slice_needs_resolve(scene))
        ang_slice_explain_pass(plan, ANG_SLICE_RESOLVE, &recipe);
    else
        ang_plan_leave_out(plan, "pass from values to grey", "slices blend to the picture itself");
    if (options->show_bricks) ang_slice_explain_pass(plan, ANG_SLICE_EDGES, &recipe);
    return true;
}
