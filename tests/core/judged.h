/* Scenes drawn by lot, and the estimate of their pictures' errors beside the truth at the same pixels. */
#ifndef ANG_TESTS_CORE_JUDGED_H
#define ANG_TESTS_CORE_JUDGED_H

#include "tests/core/fixtures.h"

#include "core/base/median.h"
#include "core/error/estimate.h"
#include "core/error/metrics.h"
#include "core/scene/objects.h"

#include <string.h>

/* A smooth field of sheets and tubes, and a ball whose surface is a ramp. */
static inline double waves_value(int x, int y, int z) {
    return 200 + 400 * sin(0.35 * x + 0.5 * sin(0.2 * z)) * cos(0.31 * y) * sin(0.23 * z + 0.4);
}
static inline double ball_value(int x, int y, int z) {
    double r = sqrt((x - 31.5) * (x - 31.5) + (y - 31.5) * (y - 31.5) + 4 * (z - 15.5) * (z - 15.5));
    return fmin(fmax(400 - 30 * (r - 22), -1000), 700);
}
static inline ang_volume *judged_volume(double (*value)(int, int, int)) {
    static const double spacing[3] = {0.8, 0.8, 1.5};
    ang_volume *volume = make_volume(64, 64, 32, spacing, value);
    volume->affine.m[1][2] = 0.3;
    return volume;
}

/* Over the volume's values: a smooth rise, a step, a spike of 1 in 125, or a rise to a plateau at opacity 1. NULL for
 * another kind. */
static inline ang_transfer *judged_transfer(const char *kind, const ang_volume *volume) {
    double low = ang_volume_hu(volume, volume->minimum), width = ang_volume_hu(volume, volume->maximum) - low;
    ang_transfer_point point[16];
    size_t count = 0;
#define POINT(at, r, g, b, a)                                                                                          \
    point[count++] = (ang_transfer_point) { .hu = low + (at)*width, .colour = {r, g, b}, .opacity = a }
    if (strcmp(kind, "step") == 0) {
        POINT(0.45, 0.2, 0.3, 0.9, 0);
        POINT(0.45, 0.2, 0.3, 0.9, 0.1);
        POINT(0.6, 0.9, 0.5, 0.2, 0.1);
        POINT(0.6, 0.9, 0.5, 0.2, 0.5);
    } else if (strcmp(kind, "spike") == 0) {
        POINT(0.5, 1, 0.4, 0.2, 0);
        POINT(0.504, 1, 0.8, 0.2, 0.9);
        POINT(0.508, 1, 0.4, 0.2, 0);
    } else if (strcmp(kind, "plateau") == 0) {
        POINT(0.4, 0.7, 0.1, 0.1, 0);
        POINT(0.55, 0.9, 0.5, 0.2, 0.2);
        POINT(0.7, 1, 0.9, 0.8, 1);
        POINT(1, 1, 1, 1, 1);
    } else if (strcmp(kind, "smooth") == 0) {
        for (int i = 0; i < 16; i++) {
            double s = i / 15.0, rise = s * s * (3 - 2 * s);
            POINT(0.2 + 0.8 * s, 0.4 + 0.5 * rise, 0.3 + 0.6 * rise * rise, 0.9 - 0.8 * rise, 0.3 * rise * rise);
        }
    }
#undef POINT
    return count ? ang_transfer_create(point, count, 1, false, NULL, NULL) : NULL;
}

enum { JUDGED_METHODS = 4 };
static const ang_method *const judged_methods[JUDGED_METHODS] = {&ang_method_envelope, &ang_method_raycast,
                                                                 &ang_method_slicing, &ang_method_singlepass};

/* A scene without its transfer function and how it is drawn. Owns `objects`, which the scene borrows once it stays
 * where it is. */
typedef struct drawn {
    ang_view view;
    ang_scene scene;
    ang_objects objects;
    int method; /* of judged_methods */
    ang_render_options options;
} drawn;

/* `cut`: with a cut plane, behind which nothing shows. */
static inline drawn draw_lot(const ang_volume *volume, int size, bool cut, uint64_t *lot) {
    static const double steps[] = {2, 1, 0.5, 0.25, 0.125};
    drawn d = {.scene = ang_scene_default(volume), .options = ang_render_options_default};
    d.view = (ang_view){.azimuth_deg = floor(360 * random_unit(lot)),
                        .elevation_deg = floor(120 * random_unit(lot) - 60),
                        .zoom = exp(random_unit(lot) * log(4)),
                        .fov_deg = 30,
                        .projection = random_unit(lot) < 0.3 ? ANG_PARALLEL : ANG_PERSPECTIVE};
    d.scene.camera = ang_camera_for(volume, &d.view);
    d.scene.width = d.scene.height = size;
    d.scene.shading = random_unit(lot) < 0.5 ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
    if (random_unit(lot) < 0.2) ang_scene_clip_parse("20%,90%,10%,80%,30%,75%", volume, &d.scene, NULL);
    d.method = (int)(JUDGED_METHODS * random_unit(lot));
    d.options.step_voxels = steps[(int)(5 * random_unit(lot))];
    if (random_unit(lot) < 0.2) d.options.termination = 0.95;
    if (cut) {
        char plane[32];
        static const char *const names[] = {"axial", "coronal", "sagittal"};
        snprintf(plane, sizeof plane, "%s:%d%%", names[(int)(3 * random_unit(lot))], (int)(100 * random_unit(lot)));
        ang_objects_add_cut_planes(&d.objects, volume, plane, NULL);
        if (random_unit(lot) < 0.5) d.options.termination = 0.7;
    }
    return d;
}

typedef struct judged {
    ang_error_estimate estimate;
    ang_metrics truth; /* against the reference, at the pixels that the estimate looks at */
} judged;

/* `truth` is a renderer of ang_method_reference for the same volume. False with an error. */
static inline bool judge(const ang_method *method, ang_renderer *renderer, ang_renderer *truth, const ang_scene *scene,
                         const ang_render_options *options, judged *out, ang_error *err) {
    ang_scene subset = ang_error_subset(scene);
    ang_image picture = {0}, exact = {0};
    ang_frame_stats stats = {0};
    bool done = ang_error_estimate_make(method, renderer, scene, options, &out->estimate, NULL, err) &&
                ang_image_create(&picture, subset.width, subset.height, err) &&
                ang_image_create(&exact, subset.width, subset.height, err) &&
                method->render(renderer, &subset, options, &picture, &stats, NULL, err) &&
                ang_method_reference.render(truth, &subset, options, &exact, NULL, NULL, err) &&
                ang_metrics_compute(&picture, &exact, false, &out->truth, err);
    ang_image_clear(&picture);
    ang_image_clear(&exact);
    return done;
}

/* What is judged: the largest error, or where there is no estimate of that the RMS. */
static inline double judged_estimate(const judged *j) { return j->estimate.why ? j->estimate.rms : j->estimate.levels; }
static inline double judged_truth(const judged *j) { return j->estimate.why ? j->truth.rms : j->truth.max; }

/* Over the rows first, first + stride, ...: the share whose estimate is not below the truth, and quantiles of estimate
 * / truth. */
typedef struct verdict {
    int scenes;
    double not_below, lowest, median, highest; /* 0..1; 5 %, 50 %, 95 % */
} verdict;

static inline verdict judge_all(const judged *rows, int count, int first, int stride) {
    double *ratio = calloc((size_t)count + 1, sizeof *ratio);
    verdict v = {0};
    for (int i = first; i < count; i += stride) {
        double estimate = judged_estimate(&rows[i]), truth = judged_truth(&rows[i]);
        v.not_below += estimate >= truth;
        ratio[v.scenes++] = truth > 0 ? estimate / truth : INFINITY;
    }
    v.median = ang_median(ratio, (size_t)v.scenes);
    v.not_below /= v.scenes;
    v.lowest = ratio[(int)(0.05 * v.scenes)];
    v.highest = ratio[(int)(0.95 * v.scenes)];
    free(ratio);
    return v;
}

#endif
