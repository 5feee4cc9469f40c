/* Error against time of the ray caster on the processor with steps classified by their middles and as a whole: pictures
 * at steps of 2 to 1/16 voxel against the reference, without ends of rays; processor time of one thread, the least of
 * some frames, both ways in turns. At the end of a scene the time that whole steps take, in that of mid-points, for the
 * largest and the RMS error that mid-points have at 1/2 and 1/4 voxel, between the measured ones by powers of both.
 *   measure_classification PRESETS [FRAMES [SIDE]] VOLUME:PRESET,PRESET,... ...
 * PRESETS: the folder. Every preset is drawn plain and with Phong. */
#include "core/cpu/method_cpu.h"
#include "core/error/metrics.h"
#include "io/load.h"
#include "io/preset/preset.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { STEPS = 6, MOST_RATIOS = 256 };
static const double steps[STEPS] = {2, 1, 0.5, 0.25, 0.125, 0.0625};
static const char *const judged[] = {"max, mid-point 1/2", "max, mid-point 1/4", "rms, mid-point 1/2",
                                     "rms, mid-point 1/4"};
enum { JUDGED = 4 };

typedef struct ratios {
    double of[JUDGED][MOST_RATIOS];
    int count;
} ratios;

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static void stop(const char *what, const ang_error *err) {
    fprintf(stderr, "%s: %s\n", what, err->message);
    exit(2);
}

/* A curve of error against time, by step. */
typedef struct curve {
    double max[STEPS], rms[STEPS], ms[STEPS];
} curve;

/* Time at which the error comes down to `error`, on straight lines between the logarithms; beyond the ends on the line
 * through the last two. */
static double time_at(const double *errors, const double *ms, double error) {
    int i = 0;
    while (i < STEPS - 2 && errors[i + 1] > error) i++;
    double a = log(errors[i]), b = log(errors[i + 1]), share = (log(error) - a) / (b - a);
    return exp(log(ms[i]) + share * (log(ms[i + 1]) - log(ms[i])));
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void judge_scene(const ang_volume *volume, const ang_scene *scene, const char *name, int frames, ratios *found) {
    ang_error err = {0};
    ang_render_options options = ang_render_options_default;
    options.termination = 1;
    ang_renderer *reference = ang_method_reference.create(NULL, volume, &options, &err);
    ang_renderer *cpu = ang_method_cpu.create(NULL, volume, &options, &err);
    ang_image truth = {0}, image = {0};
    if (!reference || !cpu || !ang_image_create(&truth, scene->width, scene->height, &err) ||
        !ang_image_create(&image, scene->width, scene->height, &err) ||
        !ang_method_reference.render(reference, scene, &options, &truth, NULL, NULL, &err))
        stop(name, &err);
    curve curves[2];
    options.threads = 1;
    for (int s = 0; s < STEPS; s++) {
        options.step_voxels = steps[s];
        curves[0].ms[s] = curves[1].ms[s] = INFINITY;
        for (int turn = 0; turn < 2 * frames + 2; turn++) {
            curve *c = &curves[turn % 2];
            options.classification = turn % 2 ? ANG_CLASSIFY_PREFIX : ANG_CLASSIFY_MIDPOINT;
            double start = now_ms();
            if (!ang_method_cpu.render(cpu, scene, &options, &image, NULL, NULL, &err)) stop(name, &err);
            if (turn > 1) c->ms[s] = fmin(c->ms[s], now_ms() - start);
            ang_metrics metrics;
            if (turn < 2 && !ang_metrics_compute(&image, &truth, false, &metrics, &err)) stop(name, &err);
            if (turn < 2) c->max[s] = metrics.max, c->rms[s] = metrics.rms;
        }
        printf("| %s | %g | %.3g | %.3g | %.1f | %.3g | %.3g | %.1f |\n", name, steps[s], curves[0].max[s],
               curves[0].rms[s], curves[0].ms[s], curves[1].max[s], curves[1].rms[s], curves[1].ms[s]);
    }
    printf("%s: time of whole steps in that of mid-points at equal error:", name);
    for (int j = 0; j < JUDGED && found->count < MOST_RATIOS; j++) {
        int at = j % 2 ? 3 : 2;
        const double *middle = j < 2 ? curves[0].max : curves[0].rms, *whole = j < 2 ? curves[1].max : curves[1].rms;
        found->of[j][found->count] = time_at(whole, curves[1].ms, middle[at]) / curves[0].ms[at];
        printf(" %.2f (%s)%s", found->of[j][found->count], judged[j], j < JUDGED - 1 ? "," : "\n");
    }
    fflush(stdout);
    found->count++;
    ang_image_clear(&image);
    ang_image_clear(&truth);
    ang_method_cpu.destroy(cpu);
    ang_method_reference.destroy(reference);
}

static void judge_volume(char *argument, const char *presets, int frames, int side, ratios *found) {
    char *list = strchr(argument, ':');
    if (!list) exit(2);
    *list++ = '\0';
    ang_error err = {0};
    ang_load_report report = {0};
    ang_load_options how = {.threads = 0};
    ang_volume *volume = ang_load(argument, &how, &report, NULL, &err);
    if (!volume) stop(argument, &err);
    const char *slash = strrchr(argument, '/');
    for (char *name = strtok(list, ","); name; name = strtok(NULL, ",")) {
        char path[4096], what[256];
        snprintf(path, sizeof path, "%s/%s.json", presets, name);
        ang_preset *preset = ang_preset_load(path, &err);
        if (!preset) stop(path, &err);
        for (int phong = 0; phong < 2; phong++) {
            ang_scene scene = ang_scene_default(volume);
            scene.width = scene.height = side;
            scene.transfer = preset->transfer;
            scene.shading = phong ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
            ang_view view = ang_view_default;
            view.azimuth_deg = 30 + 50 * phong;
            view.elevation_deg = 20;
            view.zoom = 1.7;
            scene.camera = ang_camera_for(volume, &view);
            snprintf(what, sizeof what, "%.60s, %.60s, %s", slash ? slash + 1 : argument, name,
                     phong ? "Phong" : "plain");
            judge_scene(volume, &scene, what, frames, found);
        }
        ang_preset_free(preset);
    }
    ang_volume_free(volume);
    ang_load_report_clear(&report);
}

int main(int argc, char **argv) {
    if (argc < 3) return 2;
    int frames = 3, side = 192, next = 2;
    if (next < argc && !strchr(argv[next], ':')) frames = atoi(argv[next++]);
    if (next < argc && !strchr(argv[next], ':')) side = atoi(argv[next++]);
    static ratios found;
    printf("| scene | step | mid-point: max | RMS | ms | whole: max | RMS | ms |\n|---|---|---|---|---|---|---|---|\n");
    for (; next < argc; next++) judge_volume(argv[next], argv[1], frames, side, &found);
    if (found.count == 0) return 2;
    printf("medians over %d scenes:", found.count);
    for (int j = 0; j < JUDGED; j++) {
        qsort(found.of[j], (size_t)found.count, sizeof found.of[j][0], by_size);
        printf(" %.2f (%s)%s", found.of[j][found.count / 2], judged[j], j < JUDGED - 1 ? "," : "\n");
    }
    return 0;
}
