/* angioscope render: a volume becomes one or more pictures. */
#include "app/picture.h"
#include "app/picture_state.h"
#include "app/render_json.h"
#include "app/render_output.h"
#include "app/sweep.h"
#include "app/unused.h"
#include "app/verbs.h"
#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/error/metrics.h"
#include "core/render/context.h"
#include "core/render/kept.h"
#include "io/image/annotate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Voxels: a step beyond this misses structures of a few voxels, and a user is told. */
static const double coarse_step = 2;

/* All that one call holds, so that it can be let go of in one place. */
typedef struct session {
    ang_stated stated;
    const ang_options *options; /* with what the state says */
    ang_app_progress *progress;
    ang_volume *volume;
    ang_load_report report;
    ang_picture picture;
    ang_view view; /* of the frame that is being drawn */
    ang_gl *gl;
    const ang_method *method;
    ang_renderer *renderer;
    ang_image image;
    ang_image drawn; /* where pixels between are interpolated: those that are not */
    ang_kept kept;
    float *counts; /* of each pixel, for --mode lookups */
    ang_sweep sweep;
    ang_render_output output;
    ang_render_summary summary;
} session;

static void take_gl(session *run, ang_gl *gl) {
    run->gl = gl;
    if (!gl) return;
    run->summary.gl_backend = ang_gl_backend(run->gl);
    run->summary.gl_renderer = ang_gl_renderer(run->gl);
    run->summary.gl_version = ang_gl_version(run->gl);
}

/* Options that leave this method as it is. */
static void note_ignored(session *run, const ang_render_options *given) {
    static const struct {
        unsigned takes;
        const char *option;
    } names[] = {{ANG_TAKES_TERMINATION, "--termination"},
                 {ANG_TAKES_MANUAL_FILTER, "--manual-filter"},
                 {ANG_TAKES_NO_SKIP, "--no-skip"},
                 {ANG_TAKES_PROXY, "--proxy"},
                 {ANG_TAKES_BRICKS, "--bricks"},
                 {ANG_TAKES_PASS_STEPS, "--passes-steps"},
                 {ANG_TAKES_SHOW_BRICKS, "--show-bricks"},
                 {ANG_TAKES_GPU_MEMORY, "--gpu-memory"},
                 {ANG_TAKES_GRADIENTS, "--gradients"},
                 {ANG_TAKES_ENVELOPE, "--skipping or --quads"},
                 {ANG_TAKES_SEPARATE_PASSES, "--separate-passes"},
                 {ANG_TAKES_COUNT_SHOWN, "--count-shown"},
                 {ANG_TAKES_CLASSIFICATION, "--classification"}};
    unsigned ignored = ang_method_ignores(run->method, given);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (ignored & names[i].takes)
            ang_notes_add(&run->summary.warnings, "%s has no effect with --method %s", names[i].option,
                          run->method->name);
    const ang_scene *scene = &run->picture.scene;
    if (given->count_shown && (scene->mode != ANG_MODE_DVR || scene->shading != ANG_SHADING_NONE) &&
        !(ignored & ANG_TAKES_COUNT_SHOWN))
        ang_notes_add(&run->summary.warnings, "--count-shown has no effect but in mode dvr with --shading none");
}

/* Method, step and pixels that keep --max-error and --max-time. */
static bool open_planned(session *run, ang_error *err) {
    ang_app_budget *budget = &run->summary.budget;
    const ang_render_options given = run->picture.render; /* of which the plan changes some */
    double start = ang_now_ms(), usual = ang_render_options_default.step_voxels;
    if (run->options->every > 1)
        ang_notes_add(&run->summary.warnings,
                      "--every has no effect beside --max-error and --max-time, which choose it");
    if (fabs(run->options->step - usual) > 0)
        ang_notes_add(&run->summary.warnings,
                      "--step has no effect beside --max-error and --max-time, which choose it");
    if (!ang_app_budget_plan(budget, run->options, run->gl, run->volume, &run->picture, run->method,
                             ang_app_progress_sink(run->progress), err))
        return false;
    run->summary.upload_ms = ang_now_ms() - start - budget->planned.planning_ms;
    run->picture.every = budget->planned.stride;
    run->method = budget->planned.method;
    run->renderer = budget->planned.renderer;
    ang_plan_use(&run->summary.plan, "%s: %s", run->method->name, run->method->title);
    ang_app_budget_explain(budget, &run->summary.plan);
    note_ignored(run, &given);
    return true;
}

/* A GL context where the method, which may yet have to be chosen, needs one. Where no GPU answers and the processor is
 * faster without OpenGL the method is chosen here, and `why` becomes the reason. */
static bool open_gl(session *run, const char **why, ang_error *err) {
    ang_backend backend = (ang_backend)ang_backend_from_name(run->options->backend);
    const ang_picture *picture = &run->picture;
    bool automatic = !run->method, forced = picture->render.forced >> ANG_PART_GL & 1u;
    bool wants_gl = automatic || forced ? backend != ANG_BACKEND_NONE : run->method->needs_gl;
    if (!wants_gl) return true;
    if (automatic && !forced && backend == ANG_BACKEND_AUTO && !ang_app_budget_given(run->options)) {
        take_gl(run, ang_gl_create_on_gpu());
        if (!run->gl) run->method = ang_method_choose_without_gl(run->volume, &picture->render, why);
        if (run->gl || run->method) return true;
    }
    take_gl(run, ang_gl_create(backend, err));
    return run->gl != NULL;
}

/* Finds the method and, where it needs one, a GL context. */
static bool open_renderer(session *run, ang_error *err) {
    const char *name = run->options->method, *why = "--method";
    bool automatic = strcmp(name, "auto") == 0;
    run->method = automatic ? NULL : ang_method_find(name);
    if (!automatic && !run->method) return ang_fail(err, ANG_USAGE, "--method %s: there is no such method", name);
    if (!open_gl(run, &why, err)) return false;
    if (ang_app_budget_given(run->options) && !run->picture.lookups) return open_planned(run, err);
    if (ang_app_budget_given(run->options))
        ang_notes_add(&run->summary.warnings, "--max-error and --max-time have no effect with --mode lookups");
    if (!run->method)
        run->method = ang_method_choose(run->gl, run->volume, &run->picture.scene, &run->picture.render, &why);
    ang_plan_use(&run->summary.plan, "%s: %s", run->method->name, run->method->title);
    if (automatic) ang_plan_leave_out(&run->summary.plan, "other methods", "%s", why);
    double start = ang_now_ms();
    run->renderer = run->method->create(run->gl, run->volume, &run->picture.render, err);
    run->summary.upload_ms = ang_now_ms() - start;
    note_ignored(run, &run->picture.render);
    return run->renderer != NULL;
}

/* Progress over all frames from that within one. */
typedef struct frame_progress {
    const ang_progress *sink;
    const char *what;
    int frame, frames;
} frame_progress;

static bool update_frames(void *context, const char *what, double fraction) {
    (void)what;
    const frame_progress *progress = context;
    return ang_progress_update(progress->sink, progress->what, (progress->frame + fraction) / progress->frames);
}

/* Counting samples costs time, so frames that are timed go without `stats`, and are drawn even where nothing has
 * changed. */
static bool render_frame(session *run, frame_progress *frames, ang_frame_stats *stats, double *milliseconds,
                         ang_error *err) {
    frames->sink = ang_app_progress_sink(run->progress);
    ang_progress progress = {update_frames, frames};
    int stride = run->picture.every;
    ang_scene scene = stride > 1 ? ang_scene_subset(&run->picture.scene, stride, 0, 0) : run->picture.scene;
    ang_image *image = stride > 1 ? &run->drawn : &run->image;
    if (!image->rgba && !ang_image_create(image, scene.width, scene.height, err)) return false;
    const ang_render_options *options = &run->picture.render;
    double start = ang_now_ms();
    bool done =
        stats ? ang_kept_render(&run->kept, run->method, run->renderer, &scene, options, image, stats, &progress, err)
              : run->method->render(run->renderer, &scene, options, image, NULL, &progress, err);
    if (done && stride > 1) ang_image_enlarge(image, stride, 0, &run->image);
    *milliseconds = ang_now_ms() - start;
    return done && (!run->gl || ang_gl_check(run->gl, err));
}

static void note_step(session *run) {
    double wanted = run->picture.render.step_voxels * ang_volume_smallest_spacing(run->volume);
    if (run->summary.stats.step_mm > wanted * (1 + 1e-6))
        ang_notes_add(&run->summary.warnings,
                      "the step of %.3g mm is finer than method %s can go here: %.3g mm was used", wanted,
                      run->method->name, run->summary.stats.step_mm);
    if (run->picture.render.step_voxels > coarse_step && run->summary.stats.step_mm > 0)
        ang_notes_add(&run->summary.warnings,
                      "samples lie %.3g mm apart, %.3g voxels: what is thinner may be missed, so --step %g is for "
                      "glances only",
                      run->summary.stats.step_mm, run->summary.stats.step_mm / ang_volume_smallest_spacing(run->volume),
                      run->picture.render.step_voxels);
}

/* A picture with nothing in it is seldom what was wanted. */
static void note_empty(session *run) {
    size_t values = 4 * (size_t)run->image.width * (size_t)run->image.height;
    for (size_t i = 3; i < values; i += 4)
        if (run->image.rgba[i] > 0) return;
    ang_notes_add(
        &run->summary.warnings,
        "the picture is empty: the values of the volume, %.6g to %.6g%s, are not visible with this preset, iso "
        "value, clip box or camera",
        ang_volume_hu(run->volume, run->volume->minimum), ang_volume_hu(run->volume, run->volume->maximum),
        ang_load_report_hounsfield(&run->report) ? " HU" : "");
}

/* How the first picture was made, for --explain and the JSON. */
static bool explain(session *run, ang_error *err) {
    ang_plan *plan = &run->summary.plan;
    if (!run->method->explain(run->renderer, &run->picture.scene, &run->picture.render, plan, err)) return false;
    ang_plan_leave_out_saving(plan, "window system", "headless", "a window and its libraries");
    if (!run->options->explain) return true;
    for (size_t i = 0; i < plan->uses.count; i++) fprintf(stderr, "uses      %s\n", plan->uses.item[i].what);
    for (size_t i = 0; i < plan->pass_count; i++) {
        const ang_plan_pass *pass = &plan->pass[i];
        int vertex = (int)strcspn(pass->parts, "|");
        fprintf(stderr, "pass      %s: %d lookup%s a sample\n", pass->name, pass->lookups,
                pass->lookups == 1 ? "" : "s");
        fprintf(stderr, "          vertex parts:   %.*s\n", vertex, pass->parts);
        if (pass->parts[vertex]) fprintf(stderr, "          fragment parts:%s\n", pass->parts + vertex + 1);
    }
    for (size_t i = 0; i < plan->left_out.count; i++) {
        const ang_plan_item *item = &plan->left_out.item[i];
        fprintf(stderr, "left out  %s: %s%s%s\n", item->what, item->why, item->saves ? "; saves " : "",
                item->saves ? item->saves : "");
    }
    return true;
}

/* Projections of a value over air around the body often lie outside the window as a whole. */
static void note_flat(session *run) {
    const ang_scene *scene = &run->picture.scene;
    if (scene->mode != ANG_MODE_MIP && scene->mode != ANG_MODE_MINIP && scene->mode != ANG_MODE_MEAN) return;
    size_t values = 4 * (size_t)run->image.width * (size_t)run->image.height;
    double least = INFINITY, greatest = -INFINITY;
    for (size_t i = 0; i < values; i += 4) {
        if (!(run->image.rgba[i + 3] > 0)) continue;
        double grey = (double)(run->image.rgba[i] / run->image.rgba[i + 3]);
        least = fmin(least, grey);
        greatest = fmax(greatest, grey);
    }
    bool covered = greatest >= least;
    if (!covered || greatest - least > 0.5 / 255) return;
    ang_notes_add(&run->summary.warnings,
                  "the picture is all one grey: in mode %s nothing differs within the window, %.6g to %.6g%s; --preset "
                  "with another window helps, or --clip that leaves the air around the body out",
                  ang_mode_name(scene->mode), scene->window_centre - scene->window_width / 2,
                  scene->window_centre + scene->window_width / 2,
                  ang_load_report_hounsfield(&run->report) ? " HU" : "");
}

/* The picture of how many samples each pixel took, instead of the picture itself. */
static bool show_counts(session *run, const ang_frame_stats *stats, ang_error *err) {
    int width = run->image.width, height = run->image.height;
    float most = 0;
    for (size_t i = 0; i < (size_t)width * (size_t)height; i++) most = fmaxf(most, stats->counts[i]);
    ang_image heat;
    if (!ang_heat_image(stats->counts, most, width, height, &heat, err)) return false;
    ang_image_clear(&run->image);
    run->image = heat;
    if (!run->options->quiet)
        fprintf(stderr, "samples a pixel, from none (black) to %.0f (yellow); %.1f on average\n", (double)most,
                (double)stats->samples / ((double)width * height));
    return true;
}

static void turn_camera(session *run, double degrees) {
    run->view = run->picture.view;
    run->view.azimuth_deg += degrees;
    run->picture.scene.camera = ang_camera_for(run->volume, &run->view);
}

/* How wrong the picture may be: of the first one for the JSON, of each one for its annotation. */
static bool estimate_error(session *run, int frame, ang_error_estimate *estimate, ang_error *err) {
    const ang_options *options = run->options;
    bool wanted = options->annotate || (options->json && frame == 0);
    *estimate = (ang_error_estimate){.levels = NAN};
    if (!wanted || run->picture.lookups) return true;
    run->summary.quantisation = ang_render_output_rounding(options, run->picture.scene.background);
    /* How wrong interpolated pixels are the plan alone knows. */
    if (run->picture.every > 1 && !run->summary.budget.given) return true;
    if (!ang_error_estimate_make(run->method, run->renderer, &run->picture.scene, &run->picture.render, estimate,
                                 ang_app_progress_sink(run->progress), err))
        return false;
    if (run->summary.budget.given) ang_error_estimate_add(estimate, &run->summary.budget.planned.between);
    if (frame > 0) return true;
    run->summary.estimated = true;
    run->summary.error = *estimate;
    return true;
}

/* What a file says of how its picture came to be. A preset's name may be anybody's words: PS3.15 has no room for it. */
static void describe(const session *run, char *text, size_t size) {
    const ang_scene *scene = &run->picture.scene;
    bool names = run->options->keep_phi;
    snprintf(text, size, "Angioscope " ANG_VERSION ": mode %s%s%s, method %s, step %.3g mm. Not for diagnosis.",
             ang_mode_name(scene->mode), names ? ", preset " : "", names ? run->picture.preset->name : "",
             run->method->name, run->summary.stats.step_mm);
}

static bool write_picture(session *run, int frame, const ang_error_estimate *estimate, double milliseconds,
                          ang_error *err) {
    const ang_scene *scene = &run->picture.scene;
    if (run->options->annotate || scene->objects) {
        ang_annotation annotation = run->options->annotate ? ang_annotation_make(scene, run->picture.preset->name)
                                                           : ang_annotation_of_objects(scene);
        if (run->options->annotate && !run->picture.lookups)
            ang_annotation_add_error(&annotation, estimate->levels, estimate->rms, milliseconds);
        if (!ang_image_annotate(&run->image, &annotation, &run->summary.warnings, err)) return false;
    }
    ang_picture shown = run->picture;
    shown.view = run->view;
    char description[512];
    describe(run, description, sizeof description);
    char *state = ang_picture_state_print(run->options, &shown, run->method, &run->report, err);
    ang_render_words words = {.state = state, .description = description, .scene = scene};
    bool written = state && ang_render_output_add(&run->output, frame, &run->image, &words, err);
    free(state);
    return written;
}

/* The preset of a frame of a sweep. */
static bool take_preset(session *run, int frame, ang_error *err) {
    if (run->sweep.count == 0) return true;
    ang_preset *preset = ang_sweep_at(&run->sweep, frame, run->options->frames, err);
    if (!preset) return false;
    ang_preset_free(run->picture.preset);
    run->picture.preset = preset;
    return ang_picture_use_preset(run->options, &run->picture, &run->summary.warnings, err);
}

/* Room for the counts of --mode lookups; NULL where they are not wanted, or with an error. */
static float *make_counts(session *run, ang_error *err) {
    const ang_scene *scene = &run->picture.scene;
    if (!run->picture.lookups) return NULL;
    if (run->method->exact) {
        ang_fail(err, ANG_USAGE, "--mode lookups: --method %s takes no samples; choose another", run->method->name);
        return NULL;
    }
    run->counts = ang_alloc((size_t)scene->width * (size_t)scene->height, sizeof *run->counts, "counts", err);
    return run->counts;
}

static bool render_all(session *run, ang_error *err) {
    const ang_options *options = run->options;
    if (!ang_image_create(&run->image, run->picture.scene.width, run->picture.scene.height, err)) return false;
    if (run->picture.lookups && run->picture.every > 1)
        return ang_fail(err, ANG_USAGE, "--every %d: --mode lookups counts every pixel", run->picture.every);
    if (run->picture.lookups && !make_counts(run, err)) return false;
    for (int frame = 0; frame < options->frames; frame++) {
        double milliseconds;
        if (!take_preset(run, frame, err)) return false;
        turn_camera(run, options->orbit * frame / options->frames);
        frame_progress progress = {.what = "rendering", .frame = frame, .frames = options->frames};
        ang_frame_stats stats = {.counts = run->counts};
        if (!render_frame(run, &progress, &stats, &milliseconds, err)) return false;
        if (stats.note) ang_notes_add(&run->summary.warnings, "%s", stats.note);
        if (run->kept.given && frame == 1)
            ang_plan_explain_part(&run->kept.decisions, ANG_PART_REDRAW, &run->summary.plan);
        if (frame == 0) {
            run->summary.first_frame_ms = milliseconds;
            run->summary.stats = stats;
            if (!explain(run, err)) return false;
        }
        note_step(run);
        if (run->picture.lookups) {
            if (!show_counts(run, &stats, err)) return false;
        } else {
            note_empty(run);
            note_flat(run);
        }
        ang_error_estimate estimate;
        if (!estimate_error(run, frame, &estimate, err)) return false;
        if (!write_picture(run, frame, &estimate, milliseconds, err)) return false;
        if (!options->quiet && options->verbose) fprintf(stderr, "picture %d: %.0f ms\n", frame + 1, milliseconds);
    }
    return ang_render_output_finish(&run->output, err);
}

static bool time_frames(session *run, ang_error *err) {
    int count = run->options->repeat;
    if (count < 1) return true;
    double *milliseconds = calloc((size_t)count, sizeof *milliseconds);
    if (!milliseconds) return ang_fail(err, ANG_LIMIT, "no memory for %d times", count);
    /* Without counting the shader is another one: one more frame warms that up. */
    frame_progress warm_up = {.what = "warming up", .frames = 1};
    bool done = render_frame(run, &warm_up, NULL, milliseconds, err);
    for (int frame = 0; frame < count && done; frame++) {
        turn_camera(run, run->options->orbit * frame / count);
        frame_progress progress = {.what = "timing", .frame = frame, .frames = count};
        done = render_frame(run, &progress, NULL, &milliseconds[frame], err);
    }
    if (done) ang_render_summary_times(&run->summary, milliseconds, count);
    free(milliseconds);
    return done;
}

/* Whether the budget was kept: a frame is timed as --repeat times them. */
static bool check_budget(session *run, ang_error *err) {
    ang_app_budget *budget = &run->summary.budget;
    if (!budget->given) return true;
    double ms = isnan(budget->budget.max_ms) ? NAN : run->summary.first_frame_ms;
    if (run->summary.timed_frames > 0) {
        ms = run->summary.median_ms;
    } else if (!isnan(ms) && !run->method->exact) {
        turn_camera(run, 0);
        frame_progress progress = {.what = "checking the time", .frames = 1};
        /* Without counting the shader is another one, which the first frame compiles. */
        for (int i = 0; i < 2; i++)
            if (!render_frame(run, &progress, NULL, &ms, err)) return false;
    }
    ang_app_budget_check(budget, ms, &run->summary.warnings);
    return true;
}

/* Before the volume is read: a preset that is broken is refused at once. */
static bool open_sweep(session *run, ang_error *err) {
    const ang_options *options = run->options;
    if (!options->sweep) return true;
    if (options->preset)
        return ang_fail(err, ANG_USAGE, "--preset %s: --sweep names its presets; give one of both", options->preset);
    if (options->frames < 2) return ang_fail(err, ANG_USAGE, "--sweep %s: needs --frames N", options->sweep);
    if (!ang_sweep_open(&run->sweep, options->sweep, err)) return false;
    run->picture.preset = ang_sweep_at(&run->sweep, 0, options->frames, err);
    return run->picture.preset != NULL;
}

static bool run_all(session *run, ang_error *err) {
    const ang_options *options = run->options;
    if (!ang_render_output_check(options, err)) return false;
    if (!open_sweep(run, err)) return false;
    if (!options->sweep) ang_stated_hand_preset(&run->stated, &run->picture);
    if (!ang_picture_open(options, run->progress, &run->volume, &run->report, &run->picture, &run->summary.load_ms,
                          err))
        return false;
    ang_state_matches(&run->stated.state, &run->report, &run->summary.warnings);
    if (!open_renderer(run, err)) return false;
    ang_app_note_unused(options, &run->picture, run->method, &run->summary.warnings);
    if (!ang_render_output_start(&run->output, options, &run->report, &run->summary.warnings, err) ||
        !render_all(run, err) || !time_frames(run, err) || !check_budget(run, err))
        return false;
    if (!options->json) return true;
    return ang_render_json_write(options->json, run->volume, &run->report, &run->picture, run->method, &run->summary,
                                 options->keep_phi, err);
}

int ang_app_render(const ang_options *options, ang_error *err) {
    if (!options->output) {
        ang_fail(err, ANG_USAGE, "render: give a picture to write with -o OUT.png");
        return ANG_USAGE;
    }
    if (options->frames > 1 && options->orbit == 0 && !options->sweep && !options->quiet)
        fprintf(stderr, "note: without --orbit and --sweep all %d pictures are the same\n", options->frames);
    if (options->orbit != 0 && options->frames == 1 && options->repeat == 0 && !options->quiet)
        fprintf(stderr, "note: --orbit turns nothing without --frames or --repeat\n");
    session run = {.progress = ang_app_progress_start(options->quiet)};
    bool done = ang_stated_open(ANG_VERB_RENDER, options, &run.stated, err);
    run.options = &run.stated.options;
    done =
        done && ang_app_arguments(run.options, 1, "render: give one file or folder to read", err) && run_all(&run, err);
    ang_app_progress_end(run.progress);
    if (!options->quiet) {
        ang_app_say(&run.report.warnings, "warning: ", done ? NULL : err);
        ang_app_say(&run.summary.warnings, "warning: ", NULL);
        if (options->verbose) ang_app_say(&run.report.assumptions, "note: ", NULL);
    }
    if (run.method && run.renderer) run.method->destroy(run.renderer);
    if (run.gl) ang_gl_destroy(run.gl);
    ang_image_clear(&run.image);
    ang_image_clear(&run.drawn);
    ang_kept_clear(&run.kept);
    ang_render_output_clear(&run.output);
    ang_sweep_clear(&run.sweep);
    free(run.counts);
    ang_picture_clear(&run.picture);
    ang_plan_clear(&run.summary.plan);
    ang_notes_clear(&run.summary.warnings);
    ang_load_report_clear(&run.report);
    ang_volume_free(run.volume);
    ang_stated_clear(&run.stated);
    return done ? ANG_OK : (int)err->code;
}
