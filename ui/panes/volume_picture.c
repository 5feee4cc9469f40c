#include "ui/panes/volume_picture.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/scene/annotation.h"
#include "ui/panes/interruption.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double budget_ms_software = 100, budget_ms_gpu = 33;
static const double coarse_step = 1; /* smallest spacings; half of that when fine */
static const double least_scale = 0.25, first_pixels = 30000;
/* Without a change, before the fine picture is begun: less where it stops within milliseconds. */
static const double rest_seconds = 0.15, rest_seconds_splitting = 0.05;

ang_scene ang_volume_scene(const ang_viewer *viewer, const ang_document *document, const ang_transfer *transfer,
                           int width, int height) {
    ang_scene scene = ang_scene_default(viewer->study.volume);
    scene.width = width;
    scene.height = height;
    scene.camera = ang_camera_for(viewer->study.volume, &document->view);
    scene.mode = document->mode;
    scene.shading = document->shading;
    scene.phong = document->phong;
    scene.iso_hu = document->iso_hu;
    scene.window_centre = document->window_centre;
    scene.window_width = document->window_width;
    scene.transfer = transfer;
    if (document->crop) {
        scene.clip_lower = document->crop_lower;
        scene.clip_upper = document->crop_upper;
    }
    scene.clip_plane = document->clip;
    return scene;
}

static void drop_renderer(ang_volume_picture *volume) {
    if (volume->renderer) volume->method->destroy(volume->renderer);
    volume->renderer = NULL;
    volume->method = NULL;
    volume->warm = false;
}

void ang_volume_picture_clear(ang_viewer *viewer) {
    ang_volume_picture *volume = &viewer->volume;
    unsigned version = volume->version;
    drop_renderer(volume);
    ang_kept_picture_clear(viewer);
    ang_transfer_free(volume->transfer);
    ang_objects_clear(&volume->objects);
    ang_image_clear(&volume->image);
    ang_progressive_clear(&volume->refining.picture);
    free(volume->rgba);
    ang_painter_forget(viewer->painter, &volume->texture);
    *volume = (ang_volume_picture){.version = version};
}

const char *ang_volume_method_choice(const ang_viewer *viewer) {
    int method = viewer->document.method;
    return method > 0 ? ang_methods()[method - 1]->name : "auto";
}

static void follow_method(ang_viewer *viewer) {
    ang_volume_picture *volume = &viewer->volume;
    if (viewer->document.method == volume->choice) return;
    drop_renderer(volume);
    ang_kept_picture_clear(viewer);
    volume->choice = viewer->document.method;
    volume->shown = volume->refining.begun = false;
}

/* Where OpenGL is drawn by the processor too, the method that needs none of it is several times as fast. */
static const ang_method *choose(ang_viewer *viewer, const ang_scene *scene) {
    const ang_volume_picture *volume = &viewer->volume;
    const char *why;
    if (volume->choice > 0) return ang_methods()[volume->choice - 1];
    if (volume->software) return &ang_method_cpu;
    return ang_method_choose(ang_window_gl(viewer->window), viewer->study.volume, scene, &ang_render_options_default,
                             &why);
}

static bool make_renderer(ang_viewer *viewer, const ang_scene *scene, ang_error *err) {
    ang_volume_picture *volume = &viewer->volume;
    if (volume->renderer) return true;
    ang_gl *gl = ang_window_gl(viewer->window);
    volume->software = ang_gl_is_software(gl);
    volume->method = choose(viewer, scene);
    volume->renderer = volume->method->create(volume->method->needs_gl ? gl : NULL, viewer->study.volume,
                                              &ang_render_options_default, err);
    return volume->renderer != NULL;
}

/* The picture over black, as 8 bit, into `*rgba`, which grows. */
static bool show(ang_viewer *viewer, const ang_image *image, uint8_t **rgba, ang_paint_texture *texture,
                 ang_error *err) {
    size_t pixels = (size_t)image->width * (size_t)image->height;
    uint8_t *bytes = realloc(*rgba, 4 * pixels);
    if (!bytes) return ang_fail(err, ANG_LIMIT, "no memory for a picture");
    *rgba = bytes;
    for (size_t i = 0; i < 4 * pixels; i++) {
        float value = i % 4 == 3 ? 1 : image->rgba[i];
        bytes[i] = (uint8_t)(255 * (value > 0 ? value < 1 ? value : 1 : 0) + 0.5f);
    }
    return ang_painter_picture(viewer->painter, texture, image->width, image->height, bytes, true, err);
}

/* The share of the pane's sides that a coarse picture has. */
static double coarse_scale(const ang_volume_picture *volume, int width, int height) {
    double pixels = volume->coarse_pixels > 0 ? volume->coarse_pixels : first_pixels;
    double scale = sqrt(pixels / ((double)width * height));
    /* In steps, so that it does not flicker. */
    return fmin(fmax(round(scale * 24) / 24, least_scale), 1);
}

/* Slower than the budget: fewer pixels the next time; much faster: more. */
static void adapt(ang_volume_picture *volume, double pixels, double milliseconds) {
    double budget = volume->software ? budget_ms_software : budget_ms_gpu;
    if (milliseconds > budget)
        volume->coarse_pixels = pixels * fmax(0.9 * budget / milliseconds, 0.25);
    else if (milliseconds < 0.6 * budget)
        volume->coarse_pixels = pixels * fmin(0.8 * budget / fmax(milliseconds, 0.1), 1.7);
}

static bool draw_coarse(ang_viewer *viewer, const ang_scene *scene, ang_image *image, ang_error *err) {
    ang_volume_picture *volume = &viewer->volume;
    ang_render_options options = ang_render_options_default;
    options.threads = viewer->host->threads;
    options.step_voxels = coarse_step;
    double start = ang_now_ms();
    if (!make_renderer(viewer, scene, err) || !ang_image_create(image, scene->width, scene->height, err)) return false;
    bool first = !volume->warm;
    bool done = volume->method->render(volume->renderer, scene, &options, image, NULL, NULL, err) &&
                show(viewer, image, &volume->rgba, &volume->texture, err);
    if (!done) return false;
    volume->warm = true;
    volume->frame_ms = ang_now_ms() - start;
    /* The first picture makes textures and programs too: that says nothing of the next. */
    if (!first) adapt(volume, (double)image->width * image->height, volume->frame_ms);
    return true;
}

/* The first level that shows about as much as the coarse picture, or more. */
static int first_level(const ang_volume_picture *volume, int width) {
    int level = 1;
    while (level < ANG_PROGRESSIVE_LEVELS && 1.1 * width < volume->image.width * ang_progressive_stride(level)) level++;
    return level;
}

/* Whether a part of the fine picture of this document is there. */
static bool has_begun(const ang_refining *fine, const ang_document *document, int width, int height) {
    return fine->begun && fine->size[0] == width && fine->size[1] == height &&
           ang_document_same_rendering(&fine->document, document);
}

static bool begin_refining(ang_volume_picture *volume, const ang_document *document, const ang_scene *scene,
                           ang_error *err) {
    ang_refining *fine = &volume->refining;
    if (has_begun(fine, document, scene->width, scene->height)) return true;
    fine->begun = ang_progressive_start(&fine->picture, volume->method, scene, first_level(volume, scene->width), err);
    fine->document = *document;
    fine->size[0] = scene->width;
    fine->size[1] = scene->height;
    fine->spent_ms = 0;
    return fine->begun;
}

/* Draws and shows the next level; after the last `image` becomes the picture. */
static bool refine_more(ang_viewer *viewer, const ang_document *document, const ang_scene *scene, ang_image *image,
                        ang_error *err) {
    ang_volume_picture *volume = &viewer->volume;
    ang_progressive *picture = &volume->refining.picture;
    ang_render_options options = ang_render_options_default;
    options.threads = viewer->host->threads;
    ang_interruption input;
    ang_progress progress = ang_interruption_start(&input, viewer->window);
    double start = ang_now_ms();
    if (!make_renderer(viewer, scene, err) || !begin_refining(volume, document, scene, err)) return false;
    bool done = ang_progressive_step(picture, volume->method, volume->renderer, scene, &options, &progress, err) &&
                show(viewer, &picture->image, &volume->rgba, &volume->texture, err);
    volume->refining.spent_ms += ang_now_ms() - start;
    if (!done) return false;
    volume->frame_ms = volume->refining.spent_ms;
    if (picture->level < ANG_PROGRESSIVE_LEVELS) {
        volume->refining.levels_shown++;
        return true;
    }
    *image = picture->image;
    picture->image = (ang_image){0};
    return true;
}

/* Marks of the lengths that are shown. */
static bool mark_lengths(const ang_viewer *viewer, ang_objects *objects, ang_error *err) {
    const ang_measures *measures = &viewer->document.measures;
    for (int i = 0; i < measures->count && !measures->hidden; i++) {
        const ang_measurement *item = &measures->item[i];
        if (item->kind == ANG_MEASURE_LENGTH &&
            !ang_objects_add_mark(objects, viewer->study.volume, item->point[0], item->point[1], err))
            return false;
    }
    return true;
}

static int scaled(int size, double scale) { return (int)fmax(round(size * scale), 1); }

/* Whether the picture is this document's, coarse or fine. */
static bool is_current(const ang_volume_picture *volume, const ang_document *document, int width, int height) {
    return volume->shown && volume->size[0] == width && volume->size[1] == height &&
           ang_document_same_rendering(&volume->document, document);
}

void ang_volume_await(ang_viewer *viewer, int width, int height) {
    ang_volume_picture *volume = &viewer->volume;
    const ang_document *document = ang_viewer_shown_document(viewer);
    ang_kept_picture_turn(viewer, document, width, height);
    volume->awaited = width >= 1 && height >= 1 && !is_current(volume, document, width, height);
    if (!volume->awaited) return;
    volume->shown = volume->refined = false;
    if (!has_begun(&volume->refining, document, width, height)) volume->asked_seconds = ang_now_ms() / 1000;
}

void ang_volume_update(ang_viewer *viewer, int width, int height, bool refine) {
    ang_volume_picture *volume = &viewer->volume;
    const ang_document *document = ang_viewer_shown_document(viewer);
    if (width < 1 || height < 1) return;
    follow_method(viewer);
    ang_kept_picture_turn(viewer, document, width, height);
    bool current = is_current(volume, document, width, height);
    if (current) volume->awaited = false;
    if (current && (!refine || volume->refined)) return;
    if (!current) volume->asked_seconds = ang_now_ms() / 1000;
    ang_error err = {0};
    ang_transfer *transfer = ang_document_transfer(document, &err);
    double scale = refine ? 1 : coarse_scale(volume, width, height);
    ang_scene scene = ang_volume_scene(viewer, document, transfer, scaled(width, scale), scaled(height, scale));
    ang_image image = {0};
    ang_objects objects = {0};
    scene.objects = &objects;
    bool done =
        transfer && mark_lengths(viewer, &objects, &err) &&
        (refine ? refine_more(viewer, document, &scene, &image, &err) : draw_coarse(viewer, &scene, &image, &err));
    bool interrupted = refine && !done && err.code == ANG_INTERRUPTED;
    if (interrupted || (done && !image.rgba)) {
        ang_objects_clear(&objects);
        ang_transfer_free(transfer);
        if (interrupted) volume->asked_seconds = ang_now_ms() / 1000;
        return;
    }
    ang_transfer_free(volume->transfer);
    ang_image_clear(&volume->image);
    ang_objects_clear(&volume->objects);
    volume->transfer = transfer;
    volume->objects = objects;
    volume->image = image;
    volume->scene = scene;
    volume->scene.objects = &volume->objects;
    volume->document = *document;
    volume->size[0] = width;
    volume->size[1] = height;
    volume->shown = true;
    volume->awaited = volume->refining.begun = false;
    volume->version++;
    /* What failed is not tried again until something changes. */
    volume->refined = refine || !done;
    snprintf(volume->failure, sizeof volume->failure, "%s", done ? "" : err.message);
}

bool ang_volume_thumbnail(ang_viewer *viewer, const ang_document *document, int width, int height,
                          ang_paint_texture *texture, ang_error *err) {
    const ang_volume_picture *volume = &viewer->volume;
    if (!volume->renderer) return ang_fail(err, ANG_USAGE, "there is no picture yet");
    ang_transfer *transfer = ang_document_transfer(document, err);
    ang_image image = {0};
    if (!transfer || !ang_image_create(&image, width, height, err)) {
        ang_transfer_free(transfer);
        return false;
    }
    ang_scene scene = ang_volume_scene(viewer, document, transfer, width, height);
    ang_render_options options = ang_render_options_default;
    options.threads = viewer->host->threads;
    options.step_voxels = coarse_step;
    ang_interruption input;
    ang_progress progress = ang_interruption_start(&input, viewer->window);
    uint8_t *rgba = NULL;
    bool done = volume->method->render(volume->renderer, &scene, &options, &image, NULL, &progress, err) &&
                show(viewer, &image, &rgba, texture, err);
    free(rgba);
    ang_image_clear(&image);
    ang_transfer_free(transfer);
    return done;
}

int ang_volume_level(const ang_viewer *viewer) {
    const ang_volume_picture *volume = &viewer->volume;
    if (!volume->shown || volume->failure[0]) return 0;
    if (volume->refined) return ANG_PROGRESSIVE_LEVELS;
    return volume->refining.begun ? volume->refining.picture.level : 0;
}

double ang_volume_refine_in(const ang_viewer *viewer) {
    const ang_volume_picture *volume = &viewer->volume;
    if (volume->refined || !(volume->shown || volume->awaited)) return INFINITY;
    double rest = volume->method && volume->method->splits ? rest_seconds_splitting : rest_seconds;
    return fmax(volume->asked_seconds + rest - ang_now_ms() / 1000, 0);
}
