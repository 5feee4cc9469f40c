#include "ui/panes/slice_picture.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of a slab: more than this would be felt while it turns (10 ms on two cores). */
static const double most_samples = 2e6;
static const double most_coarse = 4; /* pixels at scale 1 */
static const double rest_seconds = 0.05;

/* Grey of a value under the document's window, 0..255; outside the volume black. */
static uint8_t grey_of(double hu, double centre, double width) {
    if (isnan(hu)) return 0;
    double grey = (hu - centre) / width + 0.5;
    return grey <= 0 ? 0 : grey >= 1 ? 255 : (uint8_t)lround(255 * grey);
}

static bool make_room(ang_slice_picture *picture, size_t pixels, ang_error *err) {
    if (picture->room >= pixels) return true;
    free(picture->hu);
    free(picture->rgba);
    picture->room = 0;
    picture->hu = ang_alloc(pixels, sizeof *picture->hu, "a slice", err);
    picture->rgba = ang_alloc(pixels, 4, "a slice", err);
    if (!picture->hu || !picture->rgba) return false;
    picture->room = pixels;
    return true;
}

static bool same_place(ang_vec3 a, ang_vec3 b) { return ang_vec3_length(ang_vec3_sub(a, b)) == 0; }

static bool same_plane(const ang_reslice_plane *a, const ang_reslice_plane *b) {
    bool same_slab = a->slab == b->slab && a->thickness_mm >= b->thickness_mm && a->thickness_mm <= b->thickness_mm;
    return a->width == b->width && a->height == b->height && a->nearest == b->nearest && same_slab &&
           same_place(a->origin, b->origin) && same_place(a->step_x, b->step_x) && same_place(a->step_y, b->step_y);
}

/* Pixels to a side that share a sample for the picture to be there soon; 1: none. */
static int coarseness(const ang_viewer *viewer, const ang_reslice_plane *plane) {
    int planes = ang_reslice_planes(viewer->study.volume, plane);
    double samples = (double)plane->width * plane->height * planes;
    return planes < 2 ? 1 : (int)fmin(ceil(sqrt(samples / most_samples)), most_coarse * viewer->input.scale);
}

/* Between the values of a grid `step` pixels wide; beside the box, where one of them is none, the nearest. */
static float between(const float *grid, size_t width, size_t step, size_t x, size_t y) {
    const float *at = grid + y / step * width + x / step;
    float u = (float)(x % step) / (float)step, v = (float)(y % step) / (float)step;
    float value = (1 - v) * ((1 - u) * at[0] + u * at[1]) + v * ((1 - u) * at[width] + u * at[width + 1]);
    return isnan(value) ? at[(v >= 0.5f ? width : 0) + (u >= 0.5f)] : value;
}

static bool reslice_coarsely(const ang_viewer *viewer, const ang_reslice_plane *plane, int step, float *hu,
                             ang_error *err) {
    ang_reslice_plane grid = *plane;
    grid.width = (plane->width - 1) / step + 2;
    grid.height = (plane->height - 1) / step + 2;
    grid.step_x = ang_vec3_scale(plane->step_x, step);
    grid.step_y = ang_vec3_scale(plane->step_y, step);
    float *values = ang_alloc((size_t)grid.width * (size_t)grid.height, sizeof *values, "a slice", err);
    bool done = values && ang_reslice(viewer->study.volume, &grid, viewer->host->threads, values, err);
    for (size_t y = 0; done && y < (size_t)plane->height; y++)
        for (size_t x = 0; x < (size_t)plane->width; x++)
            *hu++ = between(values, (size_t)grid.width, (size_t)step, x, y);
    free(values);
    return done;
}

/* What moves may be coarse; what is to be saved is not. */
static int step_for(const ang_viewer *viewer, const ang_slice_picture *picture, const ang_reslice_plane *plane,
                    bool moved) {
    bool saved = viewer->save_wanted || viewer->shot.wanted;
    if (saved || !picture->filled || !(moved || !picture->due)) return 1;
    return coarseness(viewer, plane);
}

static bool reslice(ang_viewer *viewer, ang_slice_picture *picture, const ang_reslice_plane *plane, int step,
                    ang_error *err) {
    picture->coarse = step > 1;
    picture->due = false;
    picture->changed_seconds = ang_now_ms() / 1000;
    picture->version++;
    return step > 1 ? reslice_coarsely(viewer, plane, step, picture->hu, err)
                    : ang_reslice(viewer->study.volume, plane, viewer->host->threads, picture->hu, err);
}

bool ang_slice_picture_fill(ang_viewer *viewer, ang_slice_picture *picture, const ang_reslice_plane *plane,
                            ang_error *err) {
    const ang_document *document = &viewer->document;
    size_t pixels = (size_t)plane->width * (size_t)plane->height;
    bool moved = !picture->filled || !same_plane(&picture->plane, plane);
    bool windowed = picture->centre < document->window_centre || picture->centre > document->window_centre ||
                    picture->width < document->window_width || picture->width > document->window_width;
    int step = step_for(viewer, picture, plane, moved);
    moved = moved || (picture->coarse && step == 1);
    if (!moved && !windowed) return true;
    picture->filled = false;
    if (!make_room(picture, pixels, err)) return false;
    if (moved && !reslice(viewer, picture, plane, step, err)) return false;
    for (size_t i = 0; i < pixels; i++) {
        uint8_t grey = grey_of((double)picture->hu[i], document->window_centre, document->window_width);
        memset(picture->rgba + 4 * i, grey, 3);
        picture->rgba[4 * i + 3] = 255;
    }
    if (!ang_painter_picture(viewer->painter, &picture->texture, plane->width, plane->height, picture->rgba, false,
                             err))
        return false;
    picture->plane = *plane;
    picture->centre = document->window_centre;
    picture->width = document->window_width;
    picture->filled = true;
    return true;
}

void ang_slice_picture_clear(ang_viewer *viewer, ang_slice_picture *picture) {
    ang_painter_forget(viewer->painter, &picture->texture);
    ang_painter_forget(viewer->painter, &picture->mark.texture);
    free(picture->hu);
    free(picture->rgba);
    *picture = (ang_slice_picture){0};
}

bool ang_slice_image(ang_viewer *viewer, ang_orientation orientation, ang_image *image, ang_error *err) {
    const ang_slice_picture *picture = &viewer->slice[orientation];
    if (!picture->filled)
        return ang_fail(err, ANG_USAGE, "the %s slice has not been drawn yet", ang_orientation_name(orientation));
    if (!ang_image_create(image, picture->plane.width, picture->plane.height, err)) return false;
    size_t values = 4 * (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < values; i++) image->rgba[i] = (float)picture->rgba[i] / 255;
    return true;
}

double ang_slices_refine_in(const ang_viewer *viewer) {
    double seconds = INFINITY;
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        const ang_slice_picture *picture = &viewer->slice[i];
        if (!picture->coarse || viewer->pane[i].width < 1) continue;
        seconds = fmin(seconds, fmax(picture->changed_seconds + rest_seconds - ang_now_ms() / 1000, 0));
    }
    return seconds;
}

void ang_slices_refine(ang_viewer *viewer) {
    for (int i = 0; i < ANG_ORIENTATIONS; i++) viewer->slice[i].due = viewer->slice[i].coarse;
}
