#include "app/picture.h"

#include "core/base/clock.h"
#include "core/volume/histogram.h"
#include "io/preset/preset.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A preset for values that are no Hounsfield units: bright things, from the histogram. */
static ang_preset *preset_from_histogram(const ang_volume *volume, int threads, ang_error *err) {
    ang_histogram *histogram = ang_histogram_build(volume, threads, err);
    if (!histogram) return NULL;
    /* Where most voxels are empty their value is background, whatever it is. */
    uint16_t background = ang_histogram_quantile(histogram, 0.5);
    histogram->total -= histogram->bin[background];
    histogram->bin[background] = 0;
    double low = ang_volume_hu(volume, ang_histogram_quantile(histogram, 0.5));
    double high = ang_volume_hu(volume, ang_histogram_quantile(histogram, 0.995));
    free(histogram);
    low = fmax(low, ang_volume_hu(volume, background) + volume->slope);
    high = fmax(high, low + volume->slope);
    ang_transfer_point points[] = {{.hu = low, .colour = {0.55, 0.2, 0.15}, .opacity = 0},
                                   {.hu = 0.5 * (low + high), .colour = {0.9, 0.55, 0.4}, .opacity = 0.2},
                                   {.hu = high, .colour = {1, 0.95, 0.85}, .opacity = 0.8}};
    ang_preset *preset = calloc(1, sizeof *preset);
    if (!preset) {
        ang_fail(err, ANG_LIMIT, "no memory for a preset");
        return NULL;
    }
    double floor_hu = ang_volume_hu(volume, volume->minimum);
    preset->name = strdup("from-histogram");
    preset->modality = strdup("any");
    preset->description = strdup("Bright structures, from the histogram of the volume.");
    preset->version = 1;
    preset->shading = ANG_SHADING_PHONG;
    preset->phong = ang_phong_default;
    preset->iso_hu = low;
    preset->window_width = fmax(high - floor_hu, volume->slope);
    preset->window_centre = floor_hu + preset->window_width / 2;
    preset->transfer = ang_transfer_create(points, 3, 1, false, NULL, err);
    if (preset->name && preset->modality && preset->description && preset->transfer) return preset;
    ang_preset_free(preset);
    return NULL;
}

ang_preset *ang_picture_choose_preset(const ang_options *options, const ang_volume *volume,
                                      const ang_load_report *report, ang_notes *assumptions, ang_error *err) {
    if (!ang_load_report_hounsfield(report)) {
        ang_notes_add(assumptions, "no --preset given: opacity, colour and window come from the histogram");
        return preset_from_histogram(volume, options->threads, err);
    }
    int mode = options->mode ? ang_mode_from_name(options->mode) : -1; /* lookups: of the preset's */
    bool values = mode == ANG_MODE_MIP || mode == ANG_MODE_MINIP || mode == ANG_MODE_MEAN;
    const char *name = values ? "ct-mip" : "ct-bone";
    ang_notes_add(assumptions, "no --preset given: %s is used; 'angioscope presets list' shows others", name);
    return ang_preset_find(name, ang_app_preset_folders(), err);
}

static bool read_background(const ang_options *options, double background[4], ang_error *err) {
    int count;
    background[3] = 1;
    if (!ang_app_parse_numbers("background", options->background, 3, 4, background, &count, err)) return false;
    for (int i = 0; i < 4; i++)
        if (background[i] < 0 || background[i] > 1)
            return ang_fail(err, ANG_USAGE, "--background %s: each number must lie in 0..1", options->background);
    return true;
}

/* Axes, cut planes and marks. */
static bool add_objects(const ang_options *options, const ang_volume *volume, ang_picture *picture, ang_error *err) {
    ang_objects *objects = &picture->objects;
    enum { most = 6 * 64 };
    double at[most];
    int count = 0;
    if (options->axes && !ang_objects_add_axes(objects, volume, err)) return false;
    if (options->cut_plane && !ang_objects_add_cut_planes(objects, volume, options->cut_plane, err)) return false;
    if (options->measure && !ang_app_parse_numbers("measure", options->measure, 6, most, at, &count, err)) return false;
    if (count % 6 != 0)
        return ang_fail(err, ANG_USAGE, "--measure %s: give pairs of points, six numbers each", options->measure);
    for (int i = 0; i < count; i += 6)
        if (!ang_objects_add_mark(objects, volume, (ang_vec3){at[i], at[i + 1], at[i + 2]},
                                  (ang_vec3){at[i + 3], at[i + 4], at[i + 5]}, err))
            return false;
    picture->scene.objects = objects->count > 0 ? objects : NULL;
    return true;
}

bool ang_picture_start(const ang_options *options, ang_picture *picture, ang_error *err) {
    if (!options->preset) return true;
    picture->preset = ang_preset_find(options->preset, ang_app_preset_folders(), err);
    return picture->preset != NULL;
}

bool ang_picture_use_preset(const ang_options *options, ang_picture *picture, ang_notes *assumptions, ang_error *err) {
    ang_scene *scene = &picture->scene;
    const ang_preset *preset = picture->preset;
    scene->transfer = preset->transfer;
    picture->shift_hu = options->shift;
    ang_transfer_free(picture->shifted);
    picture->shifted = NULL;
    if (options->shift != 0) {
        picture->shifted = ang_transfer_shifted(preset->transfer, options->shift, err);
        if (!picture->shifted) return false;
        scene->transfer = picture->shifted;
    }
    picture->lookups = options->mode && strcmp(options->mode, "lookups") == 0;
    scene->mode = options->mode && !picture->lookups ? (ang_mode)ang_mode_from_name(options->mode) : preset->mode;
    scene->shading = options->shading ? (ang_shading)ang_shading_from_name(options->shading) : preset->shading;
    scene->phong = preset->phong;
    scene->window_centre = preset->window_centre + options->shift;
    scene->window_width = preset->window_width;
    scene->iso_hu = isnan(options->iso) ? preset->iso_hu + options->shift : options->iso;
    if (scene->mode == ANG_MODE_ISO && isnan(scene->iso_hu))
        return ang_fail(err, ANG_USAGE, "--mode iso: preset %s names no iso value; give one with --iso HU",
                        preset->name);
    if (scene->mode != ANG_MODE_ISO && !isnan(options->iso))
        ang_notes_add(assumptions, "--iso has no effect in mode %s; --mode iso shows the surface",
                      ang_mode_name(scene->mode));

    return true;
}

bool ang_picture_make(const ang_options *options, const ang_volume *volume, const ang_load_report *report,
                      ang_picture *picture, ang_notes *assumptions, ang_error *err) {
    ang_scene *scene = &picture->scene;
    *scene = ang_scene_default(volume);
    int size[2];
    if (!ang_app_parse_dims("size", options->size, 2, 65536, size, err)) return false;
    scene->width = size[0];
    scene->height = size[1];

    if (!picture->preset) picture->preset = ang_picture_choose_preset(options, volume, report, assumptions, err);
    if (!picture->preset || !ang_picture_use_preset(options, picture, assumptions, err)) return false;

    picture->view = ang_view_default;
    if (!ang_view_parse(options->view, &picture->view, err)) return false;
    int count;
    if (!ang_app_parse_numbers("pan", options->pan, 2, 2, picture->view.pan_mm, &count, err)) return false;
    picture->view.zoom = options->zoom;
    picture->view.projection = (ang_projection)ang_projection_from_name(options->projection);
    picture->view.fov_deg = options->fov;
    scene->camera = ang_camera_for(volume, &picture->view);
    if (options->clip && !ang_scene_clip_parse(options->clip, volume, scene, err)) return false;
    if (options->clip_plane && !ang_clip_plane_parse(options->clip_plane, &scene->clip_plane, err)) return false;
    if (!read_background(options, scene->background, err) || !add_objects(options, volume, picture, err)) return false;

    picture->every = options->every;
    picture->render = ang_render_options_default;
    picture->render.step_voxels = options->step;
    picture->render.termination = options->no_termination ? 1 : options->termination;
    picture->render.manual_filter = options->manual_filter;
    picture->render.threads = options->threads;
    picture->render.no_skip = options->no_skip;
    picture->render.separate_passes = options->separate_passes;
    picture->render.pass_steps = options->pass_steps;
    picture->render.gradients = strcmp(options->gradients, "lookups") == 0   ? ANG_GRADIENTS_LOOKUPS
                                : strcmp(options->gradients, "texture") == 0 ? ANG_GRADIENTS_TEXTURE
                                                                             : ANG_GRADIENTS_AUTO;
    picture->render.skipping = strcmp(options->skipping, "outside") == 0   ? ANG_SKIP_OUTSIDE
                               : strcmp(options->skipping, "between") == 0 ? ANG_SKIP_BETWEEN
                                                                           : ANG_SKIP_BOTH;
    picture->render.classification = (ang_classify)ang_classify_from_name(options->classification);
    picture->render.count_shown = options->count_shown;
    if (options->force && !ang_parts_parse(options->force, &picture->render.forced, err)) return false;
    picture->render.quads = options->quads;
    picture->render.show_bricks = options->show_bricks;
    picture->render.proxy = (ang_proxy)ang_proxy_from_name(options->proxy);
    if (isfinite(options->gpu_memory)) picture->render.gpu_memory = (size_t)(options->gpu_memory * 1e6);
    if (options->bricks && !ang_app_parse_dims("bricks", options->bricks, 3, 65536, picture->render.bricks, err))
        return false;
    return true;
}

static ang_volume *load(const ang_options *options, const ang_app_progress *progress, ang_load_report *report,
                        double *milliseconds, ang_error *err) {
    ang_load_options how = ang_app_load_options(options);
    double start = ang_now_ms();
    ang_volume *volume = ang_load(options->arguments[0], &how, report, ang_app_progress_sink(progress), err);
    *milliseconds = ang_now_ms() - start;
    return volume;
}

bool ang_picture_open(const ang_options *options, const ang_app_progress *progress, ang_volume **volume,
                      ang_load_report *report, ang_picture *picture, double *milliseconds, ang_error *err) {
    if (!ang_picture_start(options, picture, err)) return false;
    *volume = load(options, progress, report, milliseconds, err);
    if (!*volume) return false;
    ang_notes choices = {0};
    bool made = ang_picture_make(options, *volume, report, picture, &choices, err);
    /* What was chosen for the user is said at once; the loader's assumptions are for `info` and -v. */
    if (made && !options->quiet) ang_app_say(&choices, "note: ", NULL);
    ang_notes_append(&report->assumptions, &choices);
    ang_notes_clear(&choices);
    return made;
}

void ang_picture_clear(ang_picture *picture) {
    ang_preset_free(picture->preset);
    ang_transfer_free(picture->shifted);
    ang_objects_clear(&picture->objects);
    *picture = (ang_picture){0};
}
