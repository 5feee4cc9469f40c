#include "core/render/method.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/cpu/reference.h"

#include <stdatomic.h>
#include <stdlib.h>

struct ang_renderer {
    const ang_volume *volume;
};

typedef struct picture_job {
    const ang_reference *reference;
    ang_image *image;
    const ang_progress *progress;
    atomic_size_t rows_done;
    atomic_uint_fast64_t samples;
    atomic_bool cancelled;
} picture_job;

static void render_rows(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    picture_job *job = context;
    uint64_t samples = 0;
    for (size_t y = begin; y < end; y++) {
        if (atomic_load(&job->cancelled)) return;
        for (int x = 0; x < job->image->width; x++) {
            double rgba[4];
            ang_reference_pixel(job->reference, x + 0.5, (double)y + 0.5, rgba, &samples);
            float *out = job->image->rgba + 4 * (y * (size_t)job->image->width + (size_t)x);
            for (int c = 0; c < 4; c++) out[c] = (float)rgba[c];
        }
        double done = (double)(atomic_fetch_add(&job->rows_done, 1) + 1) / job->image->height;
        if (!ang_progress_update(job->progress, "rendering the reference", done)) atomic_store(&job->cancelled, true);
    }
    atomic_fetch_add(&job->samples, samples);
}

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
    picture_job job = {.reference = reference, .image = image, .progress = progress};
    ang_parallel_for((size_t)image->height, 1, options->threads, render_rows, &job);
    ang_reference_free(reference);
    if (job.cancelled) return ang_fail(err, ANG_INTERRUPTED, "interrupted while rendering the reference");
    if (stats)
        *stats = (ang_frame_stats){.counts = stats->counts,
                                   .samples = job.samples,
                                   .fragments = (uint64_t)image->width * (uint64_t)image->height,
                                   .bricks_drawn = 1,
                                   .bricks_total = 1,
                                   .passes = 1};
    return true;
}

static bool explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_plan *plan,
                    ang_error *err) {
    (void)renderer;
    if (!ang_scene_check(scene, err)) return false;
    ang_plan_facts facts = {.drawing = ANG_DRAW_REFERENCE, .mode = scene->mode, .forced = options->forced};
    ang_plan_decisions decisions = ang_plan_decide(&facts);
    ang_plan_use(plan, "exact integration of every cell in double precision");
    ang_plan_leave_out(plan, "tables and octree", "the truth must not share their mistakes");
    ang_plan_explain_part(&decisions, ANG_PART_GL, plan);
    return true;
}

static void destroy(ang_renderer *renderer) { free(renderer); }

const ang_method ang_method_reference = {
    .name = "reference",
    .title = "double precision, exact per-cell integration; slow; the truth",
    .source = "DESIGN.md, Scene conventions; numerics.md",
    .create = create,
    .render = render,
    .explain = explain,
    .destroy = destroy,
};
