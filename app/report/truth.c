/* The reference that a report compares with: the whole picture where that is quick enough, else a subset of pixels. */
#include "app/report/report.h"

#include "core/base/clock.h"
#include "core/cpu/reference.h"
#include "io/json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SEED = 1, SUBSET_PIXELS = 4096, LEAST_PIXELS = 64, PILOT_SIDE = 12 };

/* Seconds that the whole picture and that the subset may take, and their shares of the time limit. */
static const double whole_seconds = 60, whole_share = 0.25, subset_seconds = 20, subset_share = 0.1;

bool ang_report_take_subset(const ang_image *image, int stride, int first_x, int first_y, ang_image *out,
                            ang_error *err) {
    int width = (image->width - first_x - 1) / stride + 1, height = (image->height - first_y - 1) / stride + 1;
    if (!ang_image_create(out, width, height, err)) return false;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            size_t from = (size_t)(first_y + y * stride) * (size_t)image->width + (size_t)(first_x + x * stride);
            size_t to = (size_t)y * (size_t)width + (size_t)x;
            memcpy(out->rgba + 4 * to, image->rgba + 4 * from, 4 * sizeof(float));
        }
    return true;
}

void ang_report_truth_clear(ang_report_truth *truth) {
    ang_image_clear(&truth->whole);
    ang_image_clear(&truth->subset);
    ang_image_clear(&truth->other_subset);
}

/* The subset: every stride-th pixel of every stride-th row, from one drawn by lot. */
static void choose_subset(ang_report_truth *truth, int stride) {
    unsigned state = SEED;
    truth->stride = stride > 1 ? stride : 1;
    truth->first_x = rand_r(&state) % truth->stride;
    truth->first_y = rand_r(&state) % truth->stride;
}

static ang_scene subset_of(const ang_scene *scene, const ang_report_truth *truth) {
    return ang_scene_subset(scene, truth->stride, truth->first_x, truth->first_y);
}

static int stride_for(const ang_scene *scene, double pixels) {
    int stride = (int)sqrt((double)scene->width * scene->height / pixels);
    int most = scene->width < scene->height ? scene->width : scene->height;
    return stride < 1 ? 1 : stride > most ? most : stride;
}

/* Fills what is still blank of a picture of `scene`. */
static bool fill(const ang_report *report, const ang_scene *scene, const ang_progress *progress, ang_image *image,
                 ang_error *err) {
    ang_reference *reference = ang_reference_create(report->volume, scene, err);
    if (!reference) return false;
    bool done = ang_reference_fill(reference, image, report->options->threads, progress, NULL, err);
    ang_reference_free(reference);
    return done;
}

static bool make_blank(ang_image *image, const ang_scene *scene, ang_error *err) {
    if (!ang_image_create(image, scene->width, scene->height, err)) return false;
    ang_reference_blank(image);
    return true;
}

/* Milliseconds of a pixel, from a few spread over the picture. */
static bool time_pixels(ang_report *report, ang_error *err) {
    const ang_scene *scene = &report->picture.scene;
    int stride = stride_for(scene, PILOT_SIDE * PILOT_SIDE);
    ang_scene pilot = ang_scene_subset(scene, stride, stride / 2, stride / 2);
    ang_image image = {0};
    if (!make_blank(&image, &pilot, err)) return false;
    double start = ang_now_ms();
    bool done = fill(report, &pilot, ang_app_progress_sink(report->progress), &image, err);
    report->truth.pixel_ms = (ang_now_ms() - start) / ((double)pilot.width * pilot.height);
    ang_image_clear(&image);
    return done;
}

static double seconds(const ang_report *report, double most, double share) {
    return fmin(most, share * report->limit_ms / 1000);
}

/* The decision depends on the time there is. */
static void decision_name(const ang_report *report, char name[64]) { snprintf(name, 64, "truth %a", report->limit_ms); }

/* Decides between all pixels and a subset, and remembers it: another run must compare with the same. */
static bool decide(ang_report *report, bool *whole, ang_error *err) {
    ang_report_truth *truth = &report->truth;
    const ang_scene *scene = &report->picture.scene;
    char name[64];
    decision_name(report, name);
    const cJSON *before = ang_report_cache_get(report->cache, name);
    if (before) {
        *whole = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(before, "whole"));
        truth->pixel_ms = cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(before, "pixel_ms"));
        truth->whole_ms = cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(before, "whole_ms"));
        choose_subset(truth, (int)cJSON_GetNumberValue(cJSON_GetObjectItemCaseSensitive(before, "stride")));
        return true;
    }
    if (!time_pixels(report, err)) return false;
    double pixels = (double)scene->width * scene->height;
    *whole = pixels * truth->pixel_ms / 1000 <= seconds(report, whole_seconds, whole_share);
    double most = seconds(report, subset_seconds, subset_share) * 1000 / truth->pixel_ms;
    if (*whole || most > SUBSET_PIXELS) most = SUBSET_PIXELS;
    choose_subset(truth, stride_for(scene, fmax(most, LEAST_PIXELS)));
    truth->whole_ms = (double)NAN;
    return true;
}

static void remember(ang_report *report, bool whole) {
    const ang_report_truth *truth = &report->truth;
    cJSON *now = cJSON_CreateObject();
    cJSON_AddBoolToObject(now, "whole", whole);
    cJSON_AddNumberToObject(now, "stride", truth->stride);
    ang_json_add_number(now, "pixel_ms", truth->pixel_ms);
    ang_json_add_number(now, "whole_ms", truth->whole_timed ? truth->whole_ms : NAN);
    char name[64];
    decision_name(report, name);
    ang_report_cache_put(report->cache, name, now);
}

static size_t blank_pixels(const ang_image *image) {
    size_t blank = 0;
    for (size_t i = 3; i < 4 * (size_t)image->width * (size_t)image->height; i += 4) blank += isnan(image->rgba[i]);
    return blank;
}

/* The pixels of one picture, those computed before taken over; what an interruption leaves is kept. `milliseconds`
 * becomes the time where all of it was computed now. */
static bool compute(ang_report *report, const char *name, const ang_scene *scene, ang_image *image,
                    double *milliseconds, ang_error *err) {
    if (!ang_report_cache_get_image(report->cache, name, scene->width, scene->height, image) &&
        !make_blank(image, scene, err))
        return false;
    size_t blank = blank_pixels(image);
    if (blank == 0) return true;
    double start = ang_now_ms();
    ang_error failure = {0};
    bool done = fill(report, scene, ang_app_progress_sink(report->progress), image, &failure);
    if (done && milliseconds && blank == (size_t)image->width * (size_t)image->height)
        *milliseconds = ang_now_ms() - start;
    ang_report_cache_use_image(report->cache, name);
    if (!ang_report_cache_put_image(report->cache, name, image, done ? err : NULL) && done) return false;
    if (!done) *err = failure;
    return done;
}

bool ang_report_find_truth(ang_report *report, ang_error *err) {
    ang_report_truth *truth = &report->truth;
    const ang_scene *scene = &report->picture.scene;
    bool whole;
    if (!decide(report, &whole, err)) return false;
    remember(report, whole);
    ang_scene subset = subset_of(scene, truth);
    if (whole) {
        if (!compute(report, "truth", scene, &truth->whole, &truth->whole_ms, err) ||
            !ang_report_take_subset(&truth->whole, truth->stride, truth->first_x, truth->first_y, &truth->subset, err))
            return false;
    } else if (!compute(report, "truth-subset", &subset, &truth->subset, NULL, err)) {
        return false;
    }
    truth->whole_timed = isfinite(truth->whole_ms);
    remember(report, whole);
    if (!truth->whole_timed) truth->whole_ms = truth->pixel_ms * scene->width * scene->height;
    if (scene->mode != ANG_MODE_DVR) return true;
    subset.shading = scene->shading == ANG_SHADING_PHONG ? ANG_SHADING_NONE : ANG_SHADING_PHONG;
    return compute(report, "truth-other", &subset, &truth->other_subset, NULL, err);
}
