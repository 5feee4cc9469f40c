/* angioscope presets sheet: what each preset makes of one volume. */
#include "app/picture.h"
#include "app/presets.h"
#include "app/verbs.h"
#include "core/render/method.h"
#include "core/scene/fit.h"
#include "io/image/image_io.h"
#include "io/image/sheet.h"
#include "io/preset/preset.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* All that one call holds. */
typedef struct sheet_run {
    ang_options draw; /* render's, as by default but for what sheet has too */
    const char *path[2];
    ang_app_progress *progress;
    ang_volume *volume;
    ang_load_report report;
    ang_preset_names names;
    ang_renderer *renderer;
    ang_image *pictures;
    const char **shown; /* names of the pictures */
    size_t count;
    ang_notes warnings;
} sheet_run;

static const ang_method *const method = &ang_method_cpu;

/* Where nobody says how large, as large as goes. */
static bool fit(sheet_run *run, ang_error *err) {
    int size[2];
    ang_view view = ang_view_default;
    if (isfinite(run->draw.zoom)) return true;
    if (!ang_app_parse_dims("size", run->draw.size, 2, 65536, size, err) || !ang_view_parse(run->draw.view, &view, err))
        return false;
    ang_vec3 lower, upper;
    if (ang_load_report_hounsfield(&run->report))
        ang_volume_body_box(run->volume, &lower, &upper);
    else
        ang_volume_box(run->volume, &lower, &upper);
    run->draw.zoom = ang_view_fitting_zoom(run->volume, lower, upper, &view, size[0], size[1]);
    return true;
}

static bool take_options(const ang_options *options, sheet_run *run, ang_error *err) {
    char *argv[2] = {(char *)"render", NULL};
    if (!ang_options_parse(ANG_VERB_RENDER, 1, argv, &run->draw, err)) return false;
    run->draw.series = options->series;
    run->draw.raw_dims = options->raw_dims;
    run->draw.raw_type = options->raw_type;
    run->draw.raw_spacing = options->raw_spacing;
    run->draw.strict = options->strict;
    run->draw.no_sandbox = options->no_sandbox;
    run->draw.threads = options->threads;
    run->draw.size = options->size;
    run->draw.view = options->view;
    run->draw.zoom = options->zoom;
    run->path[0] = options->arguments[1];
    run->draw.arguments = run->path;
    run->draw.argument_count = 1;
    return true;
}

/* A preset that cannot be drawn costs a warning. */
static bool draw(sheet_run *run, const char *path, const char *name, ang_error *err) {
    ang_error own = {0};
    ang_picture picture = {.preset = ang_preset_load(path, &own)};
    ang_image *image = &run->pictures[run->count];
    bool made =
        picture.preset && ang_picture_make(&run->draw, run->volume, &run->report, &picture, &run->warnings, &own);
    bool drawn = made && ang_image_create(image, picture.scene.width, picture.scene.height, &own) &&
                 method->render(run->renderer, &picture.scene, &picture.render, image, NULL, NULL, &own);
    ang_picture_clear(&picture);
    if (drawn) {
        run->shown[run->count++] = name;
        return true;
    }
    ang_image_clear(image);
    if (own.code != ANG_USAGE) return ang_fail(err, own.code, "%s", own.message);
    ang_notes_add(&run->warnings, "preset %s is left out: %s", name, own.message);
    return true;
}

static bool draw_all(sheet_run *run, ang_error *err) {
    size_t most = run->names.count;
    run->pictures = calloc(most, sizeof *run->pictures);
    run->shown = calloc(most, sizeof *run->shown);
    if (!run->pictures || !run->shown) return ang_fail(err, ANG_LIMIT, "no memory for a sheet");
    for (size_t i = 0; i < most; i++) {
        if (!ang_progress_update(ang_app_progress_sink(run->progress), "drawing presets", (double)i / (double)most))
            return ang_fail(err, ANG_INTERRUPTED, "interrupted");
        if (!draw(run, run->names.paths[i], run->names.names[i], err)) return false;
    }
    ang_progress_update(ang_app_progress_sink(run->progress), "drawing presets", 1);
    return run->count > 0 || ang_fail(err, ANG_USAGE, "presets sheet: there is no preset that could be drawn");
}

static bool run_all(sheet_run *run, const ang_options *options, ang_error *err) {
    static const double black[4] = {0, 0, 0, 1};
    int size[2];
    if (!take_options(options, run, err) || !ang_image_writable(options->output, err) ||
        !ang_app_parse_dims("size", options->size, 2, 65536, size, err))
        return false;
    if (ang_load_reads(options->arguments[1], options->output))
        return ang_fail(err, ANG_USAGE, "-o %s: is read as input; give the sheet another name", options->output);
    if (!ang_preset_list(ang_app_preset_folders(), &run->names, err)) return false;
    ang_load_options how = ang_app_load_options(&run->draw);
    run->volume = ang_load(options->arguments[1], &how, &run->report, ang_app_progress_sink(run->progress), err);
    run->renderer = run->volume ? method->create(NULL, run->volume, &ang_render_options_default, err) : NULL;
    if (!run->renderer || !fit(run, err) || !draw_all(run, err)) return false;
    ang_image sheet;
    if (!ang_image_sheet(run->pictures, run->shown, run->count, &sheet, &run->warnings, err)) return false;
    bool written = ang_image_write(options->output, &sheet, black, err);
    ang_image_clear(&sheet);
    return written;
}

int ang_app_presets_sheet(const ang_options *options, ang_error *err) {
    if (!options->output) {
        ang_fail(err, ANG_USAGE, "presets sheet: give a picture to write with -o OUT.png");
        return ANG_USAGE;
    }
    sheet_run run = {.progress = ang_app_progress_start(options->quiet)};
    bool done = run_all(&run, options, err);
    ang_app_progress_end(run.progress);
    if (!options->quiet) {
        ang_app_say(&run.report.warnings, "warning: ", done ? NULL : err);
        ang_app_say(&run.warnings, "warning: ", NULL);
    }
    if (run.renderer) method->destroy(run.renderer);
    for (size_t i = 0; i < run.count; i++) ang_image_clear(&run.pictures[i]);
    free(run.pictures);
    free(run.shown);
    ang_preset_names_clear(&run.names);
    ang_notes_clear(&run.warnings);
    ang_load_report_clear(&run.report);
    ang_volume_free(run.volume);
    return done ? ANG_OK : (int)err->code;
}
