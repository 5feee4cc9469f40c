#include "core/render/method.h"

#include "core/base/memory.h"
#include "core/cpu/reference.h"

#include <stdlib.h>

struct ang_renderer {
    const ang_volume *volume;
};

static ang_renderer *create(ang_gl *gl, const ang_volume *volume, const ang_render_options *options, ang_error *err) {
    (void)gl, (void)options;
    ang_renderer *renderer = ang_alloc(1, sizeof *renderer, "reference renderer", err);
    if (renderer) renderer->volume = volume;
    return renderer;
}

static bool render(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_image *image,
                   ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    ang_reference *reference = ang_reference_create(renderer->volume, scene, err);
    if (!reference) return false;
    uint64_t samples = 0;
    ang_reference_blank(image);
    bool done = ang_reference_fill(reference, image, options->threads, progress, &samples, err);
    ang_reference_free(reference);
    if (done && stats)
        *stats = (ang_frame_stats){.counts = stats->counts,
                                   .samples = samples,
                                   .fragments = (uint64_t)image->width * (uint64_t)image->height,
                                   .bricks_drawn = 1,
                                   .bricks_total = 1,
                                   .passes = 1};
    return done;
}

static bool explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_plan *plan,
                    ang_error *err) {
    if (!ang_scene_check(scene, err)) return false;
    ang_ray_frame frame;
    if (!ang_ray_frame_make(renderer->volume, scene, &frame, err)) return false;
    ang_plan_facts facts = {.drawing = ANG_DRAW_REFERENCE,
                            .mode = scene->mode,
                            .has_clip_plane = ang_clip_plane_given(&scene->clip_plane),
                            .plane_cuts = frame.cuts,
                            .forced = options->forced};
    ang_plan_decisions decisions = ang_plan_decide(&facts);
    ang_plan_use(plan, "exact integration of every cell in double precision");
    ang_plan_leave_out(plan, "tables and octree", "the truth must not share their mistakes");
    ang_plan_explain_part(&decisions, ANG_PART_CLIP_PLANE, plan);
    ang_plan_explain_part(&decisions, ANG_PART_GL, plan);
    return true;
}

static void destroy(ang_renderer *renderer) { free(renderer); }

const ang_method ang_method_reference = {
    .name = "reference",
    .title = "double precision, exact per-cell integration; slow; the truth",
    .source = "DESIGN.md, Scene conventions; numerics.md",
    .exact = true,
    .splits = true,
    .create = create,
    .render = render,
    .explain = explain,
    .destroy = destroy,
};
