#include "core/render/facts.h"

#include "core/render/context_private.h"
#include "core/scene/clip_space.h"

bool ang_scene_needs_table(const ang_scene *scene) {
    return scene->mode == ANG_MODE_DVR || scene->mode == ANG_MODE_ISO;
}

bool ang_scene_needs_phong(const ang_scene *scene) {
    return scene->mode == ANG_MODE_ISO || (scene->mode == ANG_MODE_DVR && scene->shading == ANG_SHADING_PHONG);
}

bool ang_scene_needs_weight(const ang_scene *scene, const ang_volume *volume) {
    return scene->mode == ANG_MODE_MEAN && volume->padding;
}

int ang_scene_lookups(const ang_scene *scene, const ang_volume *volume) {
    /* Of an iso-surface table and gradient are looked up at the hit alone. The table's two neighbouring entries count
     * as one lookup, as the papers count theirs, which the texture unit interpolated. */
    if (scene->mode == ANG_MODE_ISO) return 1;
    return 1 + ang_scene_needs_table(scene) + 6 * ang_scene_needs_phong(scene) + ang_scene_needs_weight(scene, volume);
}

void ang_scene_explain(ang_plan *plan, const ang_scene *scene, const ang_volume *volume,
                       const ang_plan_decisions *decisions) {
    if (ang_scene_needs_table(scene))
        ang_plan_use(plan, "transfer function");
    else
        ang_plan_leave_out(plan, "transfer function", "this mode shows values through the window");
    const ang_decision *plane = &decisions->part[ANG_PART_CLIP_PLANE];
    if (plane->used && !plane->why) ang_plan_use(plan, "clip plane: rays are cut to the half-space before it");
    if (ang_scene_needs_phong(scene)) ang_plan_use(plan, "gradients by central differences, Phong");
    if (ang_scene_needs_weight(scene, volume))
        ang_plan_use(plan, "weights that leave padding out of the mean");
    else
        ang_plan_leave_out(plan, "padding weights", "%s",
                           volume->padding ? "only mode mean leaves padding out" : "the volume has no padding");
    ang_plan_explain(decisions, plan);
}

/* Whether a ray may start inside the volume: the near plane reaches into the clip box. */
static bool may_start_inside(const ang_ray_frame *frame) {
    for (int corner = 0; corner < 8; corner++) {
        ang_vec3 at = {corner & 1 ? frame->upper.x : frame->lower.x, corner & 2 ? frame->upper.y : frame->lower.y,
                       corner & 4 ? frame->upper.z : frame->lower.z};
        ang_vec3 from = ang_vec3_sub(ang_mat4_direction(&frame->to_mm, at), frame->origin_mm);
        if (ang_vec3_dot(from, frame->axis_mm) < frame->near_depth + 1e-3 * fabs(frame->near_depth)) return true;
    }
    return false;
}

ang_plan_facts ang_facts_make(ang_drawing drawing, const ang_gl *gl, const ang_volume *volume, const ang_scene *scene,
                              const ang_render_options *options, const ang_ray_frame *frame,
                              const ang_table_cache *table, double sample_mm) {
    ang_clip_space space = ang_clip_space_make(frame, scene->width, scene->height);
    bool tabled = ang_scene_needs_table(scene);
    return (ang_plan_facts){
        .drawing = drawing,
        .mode = scene->mode,
        .phong = scene->mode == ANG_MODE_DVR && scene->shading == ANG_SHADING_PHONG,
        .parallel = !frame->perspective,
        .pixels = (double)scene->width * scene->height,
        .jumps = tabled && ang_transfer_jumps(scene->transfer),
        .one_colour = tabled && table->one_colour,
        .extinction = tabled ? table->greatest : 0,
        .longest_mm = 2 * ang_volume_half_diagonal(volume),
        .sample_mm = sample_mm,
        .ahead = ang_clip_space_ahead(&space, frame->lower, frame->upper),
        .starts_inside = may_start_inside(frame),
        .has_clip_plane = ang_clip_plane_given(&scene->clip_plane),
        .plane_cuts = frame->cuts,
        .bytes = (double)ang_volume_count(volume) * sizeof *volume->data,
        .share_uploaded = 1,
        .hull_fits = true,
        .gl = gl != NULL,
        .software = gl && ang_gl_is_software(gl),
        .gradients_fit = true,
        .memory = (double)options->gpu_memory,
        .termination = options->termination,
        .no_skip = options->no_skip,
        .manual_filter = options->manual_filter,
        .separate_passes = options->separate_passes,
        .gradients = options->gradients,
        .skipping = options->skipping,
        .forced = options->forced,
    };
}

ang_vec3 ang_facts_margin(const ang_ray_frame *frame, double length) {
    double margin[3];
    for (int axis = 0; axis < 3; axis++) {
        const double *row = frame->to_index.m[axis];
        margin[axis] = length * sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
    }
    return (ang_vec3){margin[0], margin[1], margin[2]};
}
