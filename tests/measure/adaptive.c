/* The method adaptive beside cpu at equal error: for each scene and error the processor time of one thread with the
 * coarsest of the steps whose picture keeps that error: its largest difference from the reference, at every fourth
 * pixel each way. measure_adaptive PRESETS PHANTOM DATA KEPT [FRAMES [SCENE]] PRESETS, DATA: the folders; PHANTOM: a
 * volume; KEPT: a folder where pictures by the reference are kept from run to run; SCENE: only those whose names begin
 * so, and each of their steps is printed. With FRAMES 0 nothing is timed, but for each scene what is planned for an
 * error of 0.5 and of 2 levels, and how far that is off. */
#include "core/base/median.h"
#include "core/error/metrics.h"
#include "core/render/planner.h"
#include "io/load.h"
#include "io/preset/preset.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <zlib.h>

enum { SIDE = 512, APART = 4, STEPS = 32, ERRORS = 4 };
static const double errors[ERRORS] = {0.1, 0.25, 0.5, 1}; /* levels */
static const double coarsest[2] = {2, 1};                 /* voxels: of cpu and of adaptive */

typedef struct row {
    const char *volume, *preset;
    ang_shading shading;
    double azimuth_deg, elevation_deg, zoom;
} row;

static const row rows[] = {
    {"phantom", "cta-head", ANG_SHADING_NONE, 90, 0, 1.5},
    {"phantom", "cta-head", ANG_SHADING_PHONG, 30, 20, 1.5},
    {"phantom", "ct-soft-tissue", ANG_SHADING_NONE, 90, 0, 1.5},
    {"phantom", "ct-bone", ANG_SHADING_NONE, 200, 30, 1.5},
    {"phantom", "ct-skull", ANG_SHADING_PHONG, 0, 0, 1.5},
    {"chest", "cta-thorax", ANG_SHADING_NONE, 0, 0, 1.7},
    {"chest", "cta-thorax", ANG_SHADING_PHONG, 0, 0, 1.7},
    {"chest", "ct-bone", ANG_SHADING_NONE, 30, 10, 1.7},
    {"chest", "ct-lung", ANG_SHADING_NONE, 330, 0, 1.7},
    {"chest", "cta-pulmonary-arteries", ANG_SHADING_PHONG, 20, 0, 1.7},
    {"avm", "cta-head", ANG_SHADING_NONE, 0, 0, 1.7},
    {"avm", "cta-runoff", ANG_SHADING_PHONG, 60, 20, 1.7},
    {"aneurism", "mra", ANG_SHADING_NONE, 0, 0, 1.7},
    {"aneurism", "mra", ANG_SHADING_PHONG, 45, 30, 1.7},
    {"bonsai", "mra", ANG_SHADING_NONE, 0, 0, 1.7},
};
enum { ROWS = sizeof rows / sizeof *rows };

static void stop(const char *what, const ang_error *err) {
    fprintf(stderr, "%s: %s\n", what, err->message);
    exit(1);
}

static ang_volume *read_bytes(const char *path, ang_error *err) {
    static const int cube[3] = {256, 256, 256};
    ang_volume *volume = ang_volume_create(cube, err);
    gzFile file = gzopen(path, "rb");
    unsigned char bytes[256];
    for (size_t i = 0; volume && file && i < ang_volume_count(volume); i += sizeof bytes) {
        if (gzread(file, bytes, sizeof bytes) != (int)sizeof bytes) ang_fail(err, ANG_INPUT, "cannot be read");
        for (size_t k = 0; k < sizeof bytes; k++) volume->data[i + k] = bytes[k];
    }
    if (file) gzclose(file);
    if (volume) ang_volume_update_range(volume, 0);
    return volume;
}

static ang_volume *open_volume(const char *name, const char *phantom, const char *data) {
    char path[4096];
    ang_error err = {0};
    ang_volume *volume;
    if (strcmp(name, "aneurism") == 0) {
        snprintf(path, sizeof path, "%s/volumes/aneurism_256x256x256_uint8.raw.gz", data);
        volume = read_bytes(path, &err);
    } else {
        const char *file = strcmp(name, "chest") == 0 ? "chest-contrast-ct"
                           : strcmp(name, "avm") == 0 ? "volumes/prism_AVM.nii.gz"
                                                      : "volumes/bonsai.nii.gz";
        snprintf(path, sizeof path, "%s/%s", data, file);
        ang_load_options how = {0};
        ang_load_report report = {0};
        volume = ang_load(strcmp(name, "phantom") == 0 ? phantom : path, &how, &report, NULL, &err);
        ang_load_report_clear(&report);
    }
    if (!volume || *err.message) stop(name, &err);
    return volume;
}

/* The reference's picture, from the file if there is one. */
static void draw_truth(const char *path, const ang_volume *volume, const ang_scene *scene, ang_image *image) {
    ang_error err = {0};
    ang_scene subset = ang_scene_subset(scene, APART, 1, 2);
    size_t count = (size_t)4 * (size_t)subset.width * (size_t)subset.height;
    FILE *file = fopen(path, "rb");
    bool kept = file && fread(image->rgba, sizeof *image->rgba, count, file) == count;
    if (file) fclose(file);
    if (kept) return;
    ang_renderer *renderer = ang_method_reference.create(NULL, volume, &ang_render_options_default, &err);
    if (!renderer ||
        !ang_method_reference.render(renderer, &subset, &ang_render_options_default, image, NULL, NULL, &err))
        stop("reference", &err);
    ang_method_reference.destroy(renderer);
    file = fopen(path, "wb");
    if (!file || fwrite(image->rgba, sizeof *image->rgba, count, file) != count) fprintf(stderr, "%s not kept\n", path);
    if (file) fclose(file);
}

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

/* The coarsest steps of a method that keep each of the errors. */
typedef struct best {
    double step[ERRORS], ms[ERRORS], samples[ERRORS];
} best;

typedef struct bench {
    const ang_method *method;
    ang_renderer *renderer;
    ang_render_options options;
    const ang_scene *scene;
    const ang_image *truth; /* of the subset */
    bool prints;
} bench;

static void draw(const bench *on, const ang_scene *scene, ang_image *image, ang_frame_stats *stats) {
    ang_error err = {0};
    if (!on->method->render(on->renderer, scene, &on->options, image, stats, NULL, &err)) stop(on->method->name, &err);
}

static void find_steps(bench *on, double coarsest_step, best *out) {
    ang_error err = {0};
    ang_image image = {0};
    ang_scene subset = ang_scene_subset(on->scene, APART, 1, 2);
    if (!ang_image_create(&image, subset.width, subset.height, &err)) stop(on->method->name, &err);
    for (int s = 0; s < STEPS && !(out->step[0] > 0); s++) {
        ang_frame_stats stats = {0};
        ang_metrics off;
        on->options.step_voxels = coarsest_step * pow(2, -0.25 * s);
        draw(on, &subset, &image, &stats);
        if (!ang_metrics_compute(&image, on->truth, false, &off, &err)) stop(on->method->name, &err);
        for (int e = 0; e < ERRORS; e++)
            if (off.max <= errors[e] && !(out->step[e] > 0)) out->step[e] = on->options.step_voxels;
        if (on->prints)
            printf("  %-8s step %7.4f: error %8.3f, p999 %7.3f, rms %7.4f, %9.0f samples\n", on->method->name,
                   on->options.step_voxels, off.max, off.p999, off.rms, (double)stats.samples);
    }
    ang_image_clear(&image);
}

static best measure(const ang_method *method, double coarsest_step, const ang_volume *volume, const ang_scene *scene,
                    const ang_image *truth, int frames, bool prints) {
    ang_error err = {0};
    best out = {{0}, {0}, {0}};
    bench on = {
        .method = method, .options = ang_render_options_default, .scene = scene, .truth = truth, .prints = prints};
    on.options.threads = 1;
    on.options.termination = 1;
    on.renderer = method->create(NULL, volume, &on.options, &err);
    ang_image image = {0};
    if (!on.renderer || !ang_image_create(&image, SIDE, SIDE, &err)) stop(method->name, &err);
    find_steps(&on, coarsest_step, &out);
    for (int e = 0; e < ERRORS; e++) {
        if (!(out.step[e] > 0)) continue;
        on.options.step_voxels = out.step[e];
        out.ms[e] = INFINITY;
        for (int i = 0; i < frames; i++) {
            ang_frame_stats stats = {0};
            double start = now_ms();
            draw(&on, scene, &image, &stats);
            out.ms[e] = fmin(out.ms[e], now_ms() - start);
            out.samples[e] = (double)stats.samples;
        }
        if (prints)
            printf("  %-8s step %7.4f for %g levels: %8.1f ms, %5.1f million samples, %.2f ns each\n", method->name,
                   out.step[e], errors[e], out.ms[e], 1e-6 * out.samples[e], 1e6 * out.ms[e] / out.samples[e]);
    }
    method->destroy(on.renderer);
    ang_image_clear(&image);
    return out;
}

/* Pictures for an error: by what, and how far from the reference. */
static void print_planned(const char *name, const ang_volume *volume, const ang_scene *scene, const ang_image *truth) {
    static const double limits[] = {0.5, 2};
    ang_scene subset = ang_scene_subset(scene, APART, 1, 2);
    printf("%-42s", name);
    for (int l = 0; l < 2; l++) {
        ang_error err = {0};
        ang_image image = {0};
        ang_budget budget = {limits[l], NAN};
        ang_costs costs = {0};
        ang_planned planned;
        ang_metrics off;
        if (!ang_planner_plan(NULL, volume, scene, &ang_render_options_default, NULL, &budget, &costs, &planned, NULL,
                              &err) ||
            !ang_image_create(&image, subset.width, subset.height, &err))
            stop(name, &err);
        ang_render_options options = ang_render_options_default;
        options.termination = planned.termination;
        if (planned.step_voxels > 0) options.step_voxels = planned.step_voxels;
        if (!planned.method->render(planned.renderer, &subset, &options, &image, NULL, NULL, &err) ||
            !ang_metrics_compute(&image, truth, false, &off, &err))
            stop(name, &err);
        printf(" | %g: %s, step %.3g, estimate %.3g, off by %.3g%s", limits[l], planned.method->name,
               planned.step_voxels, planned.error, off.max, off.max > limits[l] ? " TOO MUCH" : "");
        planned.method->destroy(planned.renderer);
        ang_image_clear(&image);
    }
    printf("\n");
    fflush(stdout);
}

static void print_ratios(const char *name, const ang_volume *volume, const ang_scene *scene, const ang_image *truth,
                         int frames, bool prints, double ratios[ERRORS][ROWS], int scenes) {
    best fixed = measure(&ang_method_cpu, coarsest[0], volume, scene, truth, frames, prints);
    best adaptive = measure(&ang_method_adaptive, coarsest[1], volume, scene, truth, frames, prints);
    printf("%-42s", name);
    for (int e = 0; e < ERRORS; e++) {
        /* What only one of them reaches counts for it. */
        ratios[e][scenes] = !(adaptive.ms[e] > 0) ? INFINITY : fixed.ms[e] > 0 ? adaptive.ms[e] / fixed.ms[e] : 0;
        printf(" | %7.1f %5.2f (%4.2f)", fixed.ms[e], ratios[e][scenes], adaptive.samples[e] / fixed.samples[e]);
    }
    printf("\n");
    fflush(stdout);
}

int main(int count, char **arguments) {
    if (count < 5) {
        fprintf(stderr, "measure_adaptive PRESETS PHANTOM DATA KEPT [FRAMES [SCENE]]\n");
        return 2;
    }
    int frames = count > 5 ? atoi(arguments[5]) : 5, scenes = 0;
    const char *only = count > 6 ? arguments[6] : "", *open = "";
    double ratios[ERRORS][ROWS];
    ang_volume *volume = NULL;
    if (frames > 0) printf("%-42s", "scene: time by cpu ms, by adaptive of it");
    for (int e = 0; e < ERRORS && frames > 0; e++) printf(" | %14.3g levels", errors[e]);
    printf("\n");
    for (int r = 0; r < ROWS; r++) {
        char name[256], path[4096];
        snprintf(name, sizeof name, "%s-%s-%s", rows[r].volume, rows[r].preset, ang_shading_name(rows[r].shading));
        if (strncmp(name, only, strlen(only)) != 0) continue;
        if (strcmp(open, rows[r].volume) != 0) {
            ang_volume_free(volume);
            volume = open_volume(open = rows[r].volume, arguments[2], arguments[3]);
        }
        ang_error err = {0};
        ang_preset *preset = ang_preset_find(rows[r].preset, (const char *const[]){arguments[1], NULL}, &err);
        if (!preset) stop(name, &err);
        ang_scene scene = ang_scene_default(volume);
        scene.width = scene.height = SIDE;
        scene.transfer = preset->transfer;
        scene.phong = preset->phong;
        scene.shading = rows[r].shading;
        ang_view view = ang_view_default;
        view.azimuth_deg = rows[r].azimuth_deg;
        view.elevation_deg = rows[r].elevation_deg;
        view.zoom = rows[r].zoom;
        scene.camera = ang_camera_for(volume, &view);
        ang_image truth = {0};
        if (!ang_image_create(&truth, SIDE / APART, SIDE / APART, &err)) stop(name, &err);
        snprintf(path, sizeof path, "%s/%s.rgba", arguments[4], name);
        draw_truth(path, volume, &scene, &truth);
        if (frames == 0)
            print_planned(name, volume, &scene, &truth);
        else
            print_ratios(name, volume, &scene, &truth, frames, *only, ratios, scenes++);
        ang_image_clear(&truth);
        ang_preset_free(preset);
    }
    if (scenes > 0) printf("%-42s", "median");
    for (int e = 0; e < ERRORS && scenes > 0; e++) printf(" | %20.2f", ang_median(ratios[e], (size_t)scenes));
    printf("\n");
    ang_volume_free(volume);
    return 0;
}
