/* The baseline: rays through the whole box, sample by sample. */
#include "core/render/ray_pass.h"

#include "core/base/memory.h"

#include <shaders.h>
#include <stdlib.h>

struct ang_renderer {
    ang_ray_pass pass;
};

static void destroy(ang_renderer *renderer) {
    if (!renderer) return;
    ang_ray_pass_destroy(&renderer->pass);
    free(renderer);
}

static ang_renderer *create(ang_gl *gl, const ang_volume *volume, const ang_render_options *options, ang_error *err) {
    ang_renderer *renderer = ang_alloc(1, sizeof *renderer, "the single-pass renderer", err);
    if (!renderer || ang_ray_pass_make(&renderer->pass, "singlepass", gl, volume, options, err)) return renderer;
    destroy(renderer);
    return NULL;
}

static void add_parts(const void *context, ang_shader_source *source) {
    (void)context;
    ANG_SHADER_ADD(source, bounds_box);
    ANG_SHADER_ADD(source, skip_none);
}

static void set_no_uniforms(const void *context, unsigned program, const ang_ray_frame *frame) {
    (void)context, (void)program, (void)frame;
}

static const ang_ray_limits whole_box = {add_parts, set_no_uniforms, NULL, false, NULL};

static bool decide(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                   ang_ray_frame *frame, ang_plan_decisions *decisions, ang_error *err) {
    if (!ang_ray_pass_prepare(&renderer->pass, scene, options, frame, err)) return false;
    ang_plan_facts facts = ang_ray_pass_facts(&renderer->pass, ANG_DRAW_WHOLE_RAYS, scene, options, frame);
    *decisions = ang_plan_decide(&facts);
    return true;
}

static bool render(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_image *image,
                   ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    ang_ray_frame frame;
    ang_plan_decisions decisions;
    double upload_ms = 0;
    if (!decide(renderer, scene, options, &frame, &decisions, err) ||
        !ang_ray_pass_hold(&renderer->pass, NULL, NULL, &upload_ms, err))
        return false;
    if (stats)
        *stats = (ang_frame_stats){
            .counts = stats->counts, .bricks_drawn = 1, .bricks_total = 1, .passes = 1, .upload_ms = upload_ms};
    ang_ray_limits limits = whole_box;
    limits.decisions = &decisions;
    return ang_ray_pass_draw(&renderer->pass, scene, options, &frame, &limits, image, stats, progress, err);
}

static bool explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_plan *plan,
                    ang_error *err) {
    ang_ray_frame frame;
    ang_plan_decisions decisions;
    if (!decide(renderer, scene, options, &frame, &decisions, err)) return false;
    ang_ray_limits limits = whole_box;
    limits.decisions = &decisions;
    ang_ray_pass_explain(&renderer->pass, scene, options, &limits, plan);
    return true;
}

const ang_method ang_method_singlepass = {
    .name = "singlepass",
    .title = "one fragment-shader loop over the box, no skipping: the baseline that others are compared with",
    .source = "DESIGN.md, Rendering methods; numerics.md",
    .needs_gl = true,
    .takes = ANG_TAKES_COUNT_SHOWN | ANG_TAKES_TERMINATION | ANG_TAKES_MANUAL_FILTER | ANG_TAKES_GPU_MEMORY |
             ANG_TAKES_CLASSIFICATION,
    .create = create,
    .render = render,
    .explain = explain,
    .destroy = destroy,
};
