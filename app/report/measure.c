/* Draws and times the runs of a report, as far as the time reaches. */
#include "app/report/report.h"

#include "core/base/clock.h"
#include "core/base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A frame that takes longer is not worth a second one only to warm up: that of the subset does. */
static const double long_frame_ms = 5000;

/* The renderers open at a time, one a method, so that methods can take turns. */
typedef struct bench {
    ang_report *report;
    const ang_method *const *methods;
    ang_renderer **renderer;
    char (*refusal)[256]; /* why a method cannot be used; "" */
    ang_code code;        /* of the last refusal */
    size_t method_count;
    double work, done, frame_work; /* of all frames, of those drawn, of the one in progress; for the progress bar */
} bench;

static bool update(void *context, const char *what, double fraction) {
    (void)what;
    const bench *b = context;
    return ang_progress_update(ang_app_progress_sink(b->report->progress), "measuring",
                               (b->done + b->frame_work * fraction) / b->work);
}

static double pixels_of(const ang_report *report, const ang_report_run *run) {
    ang_scene scene = ang_report_scene(report, run);
    return (double)scene.width * scene.height;
}

/* About how much a frame takes, in any unit. */
static double frame_work(const ang_report *report, const ang_report_run *run) {
    return pixels_of(report, run) / run->options.step_voxels;
}

static double elapsed_ms(const ang_report *report) { return ang_now_ms() - report->begun_ms; }

static size_t index_of(const bench *b, const ang_method *method) {
    size_t m = 0;
    while (b->methods[m] != method) m++;
    return m;
}

/* The renderer of a run's method, opened when it is first needed; NULL with its refusal in `run`. */
static ang_renderer *renderer_of(bench *b, ang_report_run *run) {
    const ang_report *report = b->report;
    size_t m = index_of(b, run->method);
    if (!b->renderer[m] && !b->refusal[m][0]) {
        ang_error err = {0};
        if (run->method->needs_gl && !report->gl)
            ang_fail(&err, ANG_GL, "method %s needs OpenGL, and there is none (--backend none)", run->method->name);
        else
            b->renderer[m] = run->method->create(run->method->needs_gl ? report->gl : NULL, report->volume,
                                                 &report->picture.render, &err);
        if (!b->renderer[m]) {
            snprintf(b->refusal[m], sizeof b->refusal[m], "%.255s", err.message);
            b->code = err.code;
        }
    }
    if (!b->renderer[m]) snprintf(run->left_out, sizeof run->left_out, "%s", b->refusal[m]);
    return b->renderer[m];
}

/* One frame. `small` draws the subset instead. */
static bool draw(bench *b, ang_report_run *run, bool small, ang_frame_stats *stats, ang_image *image,
                 double *milliseconds, ang_error *err) {
    ang_renderer *renderer = renderer_of(b, run);
    if (!renderer) return ang_fail(err, ANG_GL, "%s", run->left_out);
    ang_report_run shown = *run;
    shown.subset = run->subset || small;
    ang_scene scene = ang_report_scene(b->report, &shown);
    ang_image own = {0};
    if (!ang_image_create(&own, scene.width, scene.height, err)) return false;
    ang_progress progress = {update, b};
    b->frame_work = frame_work(b->report, &shown);
    double start = ang_now_ms();
    bool good = run->method->render(renderer, &scene, &shown.options, &own, stats, &progress, err);
    *milliseconds = ang_now_ms() - start;
    if (good && b->report->gl) good = ang_gl_check(b->report->gl, err);
    b->done += b->frame_work;
    b->frame_work = 0;
    if (good && image)
        *image = own;
    else
        ang_image_clear(&own);
    return good;
}

/* Errors against the truth, on all pixels where there is one for all and on the subset. */
static bool compare(const ang_report *report, ang_report_run *run, const ang_image *image, ang_error *err) {
    const ang_report_truth *truth = &report->truth;
    bool same_shading = run->shading == report->picture.scene.shading;
    const ang_image *subset_truth = same_shading ? &truth->subset : &truth->other_subset;
    ang_image part = {0};
    if (!run->subset && !ang_report_take_subset(image, truth->stride, truth->first_x, truth->first_y, &part, err))
        return false;
    bool good = ang_metrics_compute(run->subset ? image : &part, subset_truth, false, &run->subset_error, err);
    ang_image_clear(&part);
    /* Windows of similarity need neighbours. */
    if (truth->stride > 1) run->subset_error.ssim = (double)NAN;
    run->error = run->subset_error;
    run->compared = (size_t)subset_truth->width * (size_t)subset_truth->height;
    if (!good || run->subset || !same_shading || !truth->whole.rgba) return good;
    run->compared = (size_t)image->width * (size_t)image->height;
    return ang_metrics_compute(image, &truth->whole, false, &run->error, err);
}

/* The first frame counts samples and is compared. Then one that warms up what is timed: without counting the shader is
 * another. */
static bool draw_first(bench *b, ang_report_run *run, ang_error *err) {
    ang_report *report = b->report;
    ang_frame_stats stats = {0};
    ang_image image = {0};
    if (!draw(b, run, false, &stats, &image, &run->rough_ms, err)) return false;
    bool good = compare(report, run, &image, err);
    run->samples = stats.samples;
    run->passes = stats.passes;
    run->classification = stats.classification;
    run->step_mm = stats.step_mm;
    run->pixels = (uint64_t)image.width * (uint64_t)image.height;
    if (good && run->group == ANG_REPORT_STEPS && !run->subset) {
        char name[160];
        ang_report_picture_name(report, run, name);
        good = ang_report_cache_put_image(report->cache, name, &image, err);
    }
    ang_image_clear(&image);
    if (good && ang_report_is_timed(run)) {
        bool small = run->rough_ms > long_frame_ms;
        double milliseconds = 0;
        good = draw(b, run, small, NULL, NULL, &milliseconds, err);
        if (!small) run->rough_ms = milliseconds;
    }
    run->drawn = good;
    return good;
}

/* Milliseconds that a frame may take, from the method's frames so far; 0: no idea. */
static double predict(const ang_report *report, const ang_report_run *run) {
    double best = 0, ratio = INFINITY;
    for (size_t i = 0; i < report->run_count; i++) {
        const ang_report_run *other = &report->run[i];
        if (!other->drawn || other->method != run->method) continue;
        double more = frame_work(report, run) / frame_work(report, other);
        double apart = fabs(log(more)) + (other->shading != run->shading) + 0.1 * (other->group != run->group);
        if (apart >= ratio) continue;
        ratio = apart;
        best = other->rough_ms * more;
    }
    return best;
}

/* What timing the runs drawn so far will take at least. */
static double reserve(const ang_report *report) {
    double sum = 0;
    for (size_t i = 0; i < report->run_count; i++) {
        const ang_report_run *run = &report->run[i];
        if (run->drawn && ang_report_is_timed(run) && run->frames < ANG_REPORT_LEAST_FRAMES)
            sum += (ANG_REPORT_LEAST_FRAMES - run->frames) * run->rough_ms;
    }
    return sum;
}

static bool fits(const ang_report *report, ang_report_run *run) {
    double frames = ang_report_is_timed(run) ? 2 + ANG_REPORT_LEAST_FRAMES : 1;
    double left = report->limit_ms - elapsed_ms(report) - reserve(report), needed = frames * predict(report, run);
    if (needed <= left && left > 0) return true;
    if (needed > 0)
        snprintf(run->left_out, sizeof run->left_out, "it would take about %.2g s, more than the time limit leaves",
                 needed / 1000);
    else
        snprintf(run->left_out, sizeof run->left_out, "the time limit leaves no time for it");
    return false;
}

/* That are to be drawn before timing. */
static double first_frames(const ang_report_run *run) { return run->drawn ? 0 : ang_report_is_timed(run) ? 2 : 1; }

/* Whether work must stop for what went wrong; else it goes on without this run. */
static bool is_fatal(const ang_error *failure, ang_error *err) {
    if (failure->code != ANG_INTERRUPTED && failure->code != ANG_OUTPUT) return false;
    *err = *failure;
    return true;
}

static bool draw_all(bench *b, ang_error *err) {
    ang_report *report = b->report;
    for (size_t i = 0; i < report->run_count; i++) {
        ang_report_run *run = &report->run[i];
        double after = b->done + first_frames(run) * frame_work(report, run);
        if (!run->drawn && fits(report, run)) {
            ang_error failure = {0};
            if (draw_first(b, run, &failure)) {
                ang_report_cache_put_run(report->cache, report, run);
                if (!ang_report_cache_save(report->cache, false, err)) return false;
            } else if (is_fatal(&failure, err)) {
                return false;
            } else {
                snprintf(run->left_out, sizeof run->left_out, "%.255s", failure.message);
            }
        }
        b->done = after;
    }
    return true;
}

static bool time_all(bench *b, ang_error *err) {
    ang_report *report = b->report;
    for (int round = 0; round < ANG_REPORT_FRAMES; round++)
        for (size_t i = 0; i < report->run_count; i++) {
            ang_report_run *run = &report->run[i];
            if (!run->drawn || !ang_report_is_timed(run) || run->frames > round) continue;
            if (elapsed_ms(report) + run->rough_ms > report->limit_ms) continue;
            ang_error failure = {0};
            if (draw(b, run, false, NULL, NULL, &run->frame_ms[run->frames], &failure))
                run->frames++;
            else if (is_fatal(&failure, err))
                return false;
            ang_report_cache_put_run(report->cache, report, run);
            if (!ang_report_cache_save(report->cache, false, err)) return false;
        }
    return true;
}

/* Whether every method that was asked for refused. */
static bool none_can(const bench *b) {
    for (size_t i = 0; i < b->report->run_count; i++)
        if (b->report->run[i].drawn || !b->refusal[index_of(b, b->report->run[i].method)][0]) return false;
    return true;
}

static bool open_bench(bench *b, ang_error *err) {
    while (b->methods[b->method_count]) b->method_count++;
    b->renderer = ang_alloc(b->method_count, sizeof(ang_renderer *), "renderers", err);
    b->refusal = b->renderer ? ang_alloc(b->method_count, sizeof *b->refusal, "renderers", err) : NULL;
    return b->refusal != NULL;
}

static void close_bench(bench *b) {
    for (size_t m = 0; b->renderer && m < b->method_count; m++)
        if (b->renderer[m]) b->methods[m]->destroy(b->renderer[m]);
    free(b->renderer);
    free(b->refusal);
}

bool ang_report_measure(ang_report *report, ang_error *err) {
    bench b = {.report = report, .methods = ang_methods()};
    for (size_t i = 0; i < report->run_count; i++) {
        ang_report_run *run = &report->run[i];
        ang_report_cache_get_run(report->cache, report, run);
        double frames = first_frames(run);
        if (ang_report_is_timed(run)) frames += ANG_REPORT_FRAMES - run->frames;
        b.work += frames * frame_work(report, run);
    }
    b.work = fmax(b.work, 1);
    bool done = open_bench(&b, err) && draw_all(&b, err) && time_all(&b, err);
    if (done && none_can(&b)) {
        ang_fail(err, b.code, "there is nothing to report: %s", b.refusal[index_of(&b, report->run[0].method)]);
        done = false;
    }
    close_bench(&b);
    return done;
}

bool ang_report_picture(const ang_report *report, const ang_report_run *run, ang_image *image) {
    const ang_scene *scene = &report->picture.scene;
    char name[160];
    if (!run || !run->drawn || run->subset) return false;
    ang_report_picture_name(report, run, name);
    if (ang_report_cache_get_image(report->cache, name, scene->width, scene->height, image)) return true;
    ang_report again = *report;
    ang_report_run same = *run;
    bench b = {.report = &again, .methods = ang_methods(), .work = 1};
    double milliseconds;
    bool drawn = open_bench(&b, NULL) && draw(&b, &same, false, NULL, image, &milliseconds, NULL);
    close_bench(&b);
    if (drawn && ang_report_cache_put_image(report->cache, name, image, NULL))
        ang_report_cache_use_image(report->cache, name);
    return drawn;
}
