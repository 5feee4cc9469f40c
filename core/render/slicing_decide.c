/* What slicing decides about a picture before anything is drawn, and how it explains that. */
#include "core/render/slicing_private.h"

#include "core/base/clock.h"
#include "core/render/facts.h"
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
/* ... and pixels that are finished are looked for about this often in a picture. */
static const double finish_looks = 12;

/* Millimetres that a ray moves from one plane to the next, at most. */
static double step_length(const ang_scene *scene, const ang_ray_frame *frame, const ang_slice_planes *planes) {
    double least_cosine = 1;
    for (int corner = 0; corner < 4; corner++) {
        ang_ray ray = ang_ray_through(frame, corner & 1 ? scene->width : 0, corner & 2 ? scene->height : 0);
        least_cosine = fmin(least_cosine, ang_vec3_dot(ray.direction_mm, frame->axis_mm));
    }
    return 1.01 * planes->distance / fmax(least_cosine, 1e-3);
}

/* Voxels: where a ray moves farther from plane to plane, looking for what lies between them makes blocks so much larger
 * that leaving out the rest pays no more. */
enum { MOST_APRON = 17 };

/* Voxels around a block that what is shown at its planes may depend on. */
static int apron_of(const ang_slicing *s) {
    /* A hit before a plane shows at that plane: what lies a step before it must count as well; of a slab that is
     * classified as a whole what lies half a step to either side. */
    bool beyond = s->visibility.mode == ANG_MODE_ISO || s->whole_steps;
    return 1 + (beyond ? s->needs.reach : 0);
}

static bool prepare_octree(ang_renderer *renderer, const ang_render_options *options, ang_slicing *s, ang_error *err) {
    const ang_volume *volume = renderer->volume;
    int leaf[3], apron = apron_of(s);
    if (apron > MOST_APRON) apron = 1; /* decide_skipping() skips nothing then */
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

/* What is known of the scene and the octree; inner slices stand for one distance of planes. */
static void find_facts(const ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                       ang_slicing *s) {
    const ang_octree *octree = renderer->octree;
    s->facts = ang_facts_make(ANG_DRAW_SLICES, renderer->gl, renderer->volume, scene, options, &s->frame,
                              &renderer->table.cache, s->length);
    ang_table_texture_facts(&renderer->table, scene, &s->facts);
    s->facts.apron = apron_of(s);
    s->facts.most_apron = MOST_APRON;
    s->facts.all_shows = ang_visibility_of_all(&s->visibility, octree->level[octree->levels - 1].nodes[0]);
}

/* The first and the last sample stand for more, the only one of a ray for almost two steps. */
static void decide(ang_slicing *s) {
    ang_plan_facts at_faces = s->facts;
    at_faces.sample_mm = 2 * s->facts.sample_mm;
    s->plan = ang_plan_decide(&s->facts);
    s->plan_at_faces = ang_plan_decide(&at_faces);
    s->skips = ang_plan_uses(&s->plan, ANG_PART_SKIPPING);
    s->finishes = ang_plan_uses(&s->plan, ANG_PART_TERMINATION);
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
        double least = ang_plan_least_fragments * scene->width * scene->height;
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
    if (scene->mode == ANG_MODE_DVR &&
        !ang_table_texture_classify(&renderer->table, renderer->gl, scene->transfer, volume, options->classification,
                                    s->planes.distance, err))
        return false;
    s->whole_steps = ang_scene_whole_steps(scene, &renderer->table);
    s->visibility = ang_visibility_make(volume, scene, renderer->table.cache.tables);
    s->needs.weight = ang_scene_needs_weight(scene, volume);
    s->needs.reach = ang_scene_needs_phong(scene);
    s->length = step_length(scene, &s->frame, &s->planes);
    s->margin = ang_facts_margin(&s->frame, s->length);
    /* Voxels from a plane to the next, or half-way there. */
    double farthest = fmax(s->margin.x, fmax(s->margin.y, s->margin.z)) * (s->whole_steps ? 0.5 : 1);
    if (scene->mode == ANG_MODE_ISO || s->whole_steps) s->needs.reach += (int)fmin(ceil(farthest), most_reach(volume));
    if (!prepare_octree(renderer, options, s, err) ||
        !ang_brick_store_arrange(&renderer->store, renderer->octree, s->needs, err))
        return false;
    find_facts(renderer, scene, options, s);
    decide(s);
    s->group = ang_slice_group(scene, options);
    bool shaded = ang_scene_needs_phong(scene);
    ang_slice_cut cut = {.visibility = s->skips ? &s->visibility : NULL,
                         .to_leaves = options->bricks[0] > 0 || ang_plan_uses(&s->plan, ANG_PART_DESCENT),
                         .top_level = ang_brick_store_level(&renderer->store),
                         .margin = s->margin,
                         .group = s->group,
                         .polygon_cost = shaded ? polygon_cost_shaded : polygon_cost};
    if (!ang_slice_boxes_make(&renderer->boxes, renderer->octree, &s->frame, &s->planes, &s->space, &cut, err))
        return false;
    s->facts.fragments = renderer->boxes.samples;
    decide(s);
    decide_order(renderer, scene, options, s);
    return true;
}

ang_slice_recipe ang_slicing_recipe(const ang_renderer *renderer, const ang_scene *scene,
                                    const ang_render_options *options, const ang_slicing *s, bool counting) {
    return (ang_slice_recipe){scene,   renderer->volume, options, &renderer->table, {&s->plan, &s->plan_at_faces},
                              counting};
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
    if (boxes->leaves_total > boxes->leaves_drawn)
        ang_plan_leave_out(plan, "parts of the volume",
                           "%zu of %zu leaves of the octree: %s%sthey lie outside the picture%s",
                           boxes->leaves_total - boxes->leaves_drawn, boxes->leaves_total,
                           s->skips ? ang_visibility_reason(s->visibility.mode) : "", s->skips ? ", or " : "",
                           s->frame.cuts ? ", outside the clip box or beyond the clip plane" : " or the clip box");
}

bool ang_slicing_explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                         ang_plan *plan, ang_error *err) {
    ang_slicing s;
    if (!ang_slicing_decide(renderer, scene, options, &s, err)) return false;
    explain_storage(renderer, plan);
    explain_boxes(renderer, &s, options, plan);
    ang_scene_explain(plan, scene, renderer->volume, &s.plan);
    ang_scene_explain_steps(plan, scene, &renderer->table);
    ang_slice_recipe recipe = ang_slicing_recipe(renderer, scene, options, &s, false);
    ang_slice_explain_pass(plan, ANG_SLICE_INNER, &recipe);
    ang_slice_explain_pass(plan, ANG_SLICE_FACES, &recipe);
    if (s.finishes) {
        ang_plan_use(plan, "early termination: where opacity reaches %g the depth test rejects what lies behind",
                     options->termination);
        ang_slice_explain_pass(plan, ANG_SLICE_FINISH, &recipe);
    }
    if (ang_slice_needs_resolve(scene))
        ang_slice_explain_pass(plan, ANG_SLICE_RESOLVE, &recipe);
    else
        ang_plan_leave_out(plan, "pass from values to grey", "slices blend to the picture itself");
    if (options->show_bricks) ang_slice_explain_pass(plan, ANG_SLICE_EDGES, &recipe);
    return true;
}
