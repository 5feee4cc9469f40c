/* What raycast decides about a picture before anything is drawn, and how it explains that. */
#include "core/render/raycast_private.h"

#include "core/render/facts.h"
#include "core/render/pixel_pad.h"
#include "core/render/scene_parts.h"

#include <stdio.h>

/* Lookups in a main pass: measured on llvmpipe (docs/papers.md). */
enum { USUAL_STEPS = 32 };

/* mm that any ray has in the clip box, at most. */
static double longest_reach(const ang_scene *scene, const ang_ray_frame *f) {
    ang_vec3 size = ang_vec3_sub(f->upper, f->lower);
    double longest = 0, least[3] = {INFINITY, INFINITY, INFINITY}, greatest[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int corner = 0; corner < 4; corner++) {
        ang_vec3 diagonal = {size.x, corner & 1 ? size.y : -size.y, corner & 2 ? size.z : -size.z};
        longest = fmax(longest, ang_vec3_length(ang_mat4_direction(&f->to_mm, diagonal)));
    }
    /* Directions as long as their projection on the axis, which between the picture's corners are linear. */
    double slant = 1;
    for (int corner = 0; corner < 4; corner++) {
        ang_ray ray = ang_ray_through(f, corner & 1 ? scene->width : 0, corner & 2 ? scene->height : 0);
        double cosine = fmax(ang_vec3_dot(ray.direction_mm, f->axis_mm), 1e-6);
        slant = fmax(slant, 1 / cosine);
        for (int axis = 0; axis < 3; axis++) {
            double along = ang_vec3_at(ray.direction, axis) / cosine;
            least[axis] = fmin(least[axis], along);
            greatest[axis] = fmax(greatest[axis], along);
        }
    }
    for (int axis = 0; axis < 3; axis++) {
        double slowest = fmax(fmax(least[axis], -greatest[axis]), 1e-30);
        longest = fmin(longest, ang_vec3_at(size, axis) * slant / slowest);
    }
    return longest;
}

static void decide_passes(const ang_renderer *renderer, ang_raycast *r) {
    int wanted = r->options->pass_steps;
    r->steps = wanted > 0 ? wanted : USUAL_STEPS;
    /* A sample more for the rounding of the shader's ends of rays. */
    double lookups = ceil(longest_reach(r->scene, &r->frame) / ang_ray_step(renderer->pass.volume, r->options)) + 1;
    if (r->scene->mode == ANG_MODE_ISO) lookups += 2;
    r->passes = (int)ceil(lookups / r->steps);
    snprintf(r->constants, sizeof r->constants, "const int pass_steps = %d; // lookups in a main pass\n", r->steps);
}

/* A pixel or so farther than the clip box, since rays decide which of them meet it. Where a corner lies beside or
 * behind the eye, clipping may leave the faces' edges apart: then the whole picture is gone over. */
static void decide_cover(ang_raycast *r) {
    const ang_ray_frame *f = &r->frame;
    ang_pixel_pad pad = ang_pixel_pad_make(f);
    double farthest = ang_linear_form_greatest(&r->space.w, f->lower, f->upper);
    double width = 4 * (pad.pixel + pad.rounding);
    if (f->perspective) {
        double reference = ang_vec3_dot(ang_vec3_sub(f->origin_mm, f->eye_mm), f->axis_mm);
        width += 4 * pad.growth * fmax(farthest - reference, 0);
    }
    ang_vec3 by = ang_vec3_scale(pad.index, width);
    r->cover_lower = ang_vec3_sub(f->lower, by);
    r->cover_upper = ang_vec3_add(f->upper, by);
    r->covers = ang_clip_space_ahead(&r->space, r->cover_lower, r->cover_upper);
}

/* The voxels that main passes may sample: a stretch is looked up as a whole where any of it may show something. An
 * iso-surface looks at the entry of rays as well. */
static void find_sampled(const ang_renderer *renderer, ang_raycast *r) {
    const ang_volume *volume = renderer->pass.volume;
    ang_vec3 margin = ang_facts_margin(&r->frame, 1.01 * (r->steps + 2) * ang_ray_step(volume, r->options));
    r->facts.texture_shared = r->facts.software && r->scene->mode != ANG_MODE_ISO;
    margin = ang_vec3_add(margin, (ang_vec3){1, 1, 1});
    r->facts.share_uploaded =
        ang_block_box_voxels(&renderer->blocks.box, renderer->blocks.octree, volume, margin, r->first, r->end);
}

/* Decides as far as is known, builds what that takes, and decides again. */
static bool decide(ang_renderer *renderer, ang_raycast *r, ang_error *err) {
    const ang_volume *volume = renderer->pass.volume;
    r->visibility = ang_visibility_make(volume, r->scene, renderer->pass.table.cache.tables);
    r->facts = ang_ray_pass_facts(&renderer->pass, ANG_DRAW_PASSES, r->scene, r->options, &r->frame);
    r->plan = ang_plan_decide(&r->facts);
    renderer->blocks.build_ms = 0;
    if (ang_plan_uses(&r->plan, ANG_PART_SKIPPING)) {
        if (!ang_block_ranges_update(&renderer->blocks, renderer->pass.gl, volume, &r->visibility, r->options->threads,
                                     err))
            return false;
        r->facts.blocks = renderer->blocks.blocks;
        r->facts.shown = renderer->blocks.shown;
        find_sampled(renderer, r);
        r->plan = ang_plan_decide(&r->facts);
    }
    r->skips = ang_plan_uses(&r->plan, ANG_PART_SKIPPING);
    r->terminates = ang_plan_uses(&r->plan, ANG_PART_TERMINATION);
    r->joined = ang_plan_uses(&r->plan, ANG_PART_JOINED);
    return true;
}

bool ang_raycast_decide(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                        ang_raycast *r, ang_error *err) {
    *r = (ang_raycast){.scene = scene, .options = options};
    if (options->pass_steps < 0 || options->pass_steps > 64)
        return ang_fail(err, ANG_USAGE, "--passes-steps %d: raycast takes 1 to 64 steps a pass, or 0 for the usual",
                        options->pass_steps);
    if (!ang_ray_pass_prepare(&renderer->pass, scene, options, &r->frame, err)) return false;
    r->space = ang_clip_space_make(&r->frame, scene->width, scene->height);
    decide_passes(renderer, r);
    decide_cover(r);
    return decide(renderer, r, err);
}

bool ang_raycast_has(const ang_raycast *r, ang_raycast_pass pass) {
    if (pass == ANG_RAYCAST_FINISH) return ang_raycast_tests(r);
    if (pass == ANG_RAYCAST_EMPTY) return r->skips;
    return pass != ANG_RAYCAST_RESOLVE || r->scene->mode != ANG_MODE_DVR;
}

static void explain_skipping(const ang_renderer *renderer, const ang_raycast *r, ang_plan *plan) {
    if (!r->skips) return;
    size_t shown = renderer->blocks.shown, blocks = renderer->blocks.blocks;
    ang_plan_use(plan, "skipping of stretches in which no lookup meets a visible block of 8x8x8 cells");
    if (shown < blocks)
        ang_plan_leave_out(plan, "parts of the volume", "%zu of %zu blocks: %s", blocks - shown, blocks,
                           ang_visibility_reason(r->visibility.mode));
    if (r->joined) ang_plan_use(plan, "empty space is found by the main passes");
}

bool ang_raycast_explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                         ang_plan *plan, ang_error *err) {
    ang_raycast r;
    if (!ang_raycast_decide(renderer, scene, options, &r, err)) return false;
    ang_plan_use(plan, "one 3D texture of 16 bits for the whole volume");
    ang_scene_explain(plan, scene, renderer->pass.volume, &r.plan);
    ang_scene_explain_steps(plan, scene, &renderer->pass.table);
    ang_plan_use(plan, "up to %d main passes of %d lookups along every ray", r.passes, r.steps);
    explain_skipping(renderer, &r, plan);
    if (r.terminates)
        ang_plan_use(plan, "early termination: the depth test rejects pixels that are %s",
                     scene->mode == ANG_MODE_ISO ? "on a surface" : "opaque");
    if (!ang_raycast_tests(&r))
        ang_plan_leave_out(plan, "depth test and passes between the main passes", "nothing is skipped or ends early");
    for (int pass = 0; pass < ANG_RAYCAST_PASSES; pass++)
        if (ang_raycast_has(&r, (ang_raycast_pass)pass))
            ang_raycast_explain_pass(renderer, &r, (ang_raycast_pass)pass, plan);
    if (!ang_raycast_has(&r, ANG_RAYCAST_RESOLVE))
        ang_plan_leave_out(plan, "pass from values to grey", "stretches blend to the picture itself");
    return true;
}
