/* What the ray caster on the processor takes, width by width: processor time of one thread, the least over several
 * cameras of an orbit, each the least of some frames. Usage: measure_cpu VOLUME BENCH_FOLDER
 * [FRAMES [SCENE [WIDTH]]], the last two by how their names begin. */
#include "core/cpu/method_cpu.h"
#include "io/load.h"
#include "io/preset/preset.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static double least_ms(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, int frames,
                       ang_image *image, ang_frame_stats *stats) {
    double least = 1e30;
    for (int i = 0; i < frames; i++) {
        double start = now_ms();
        if (!ang_method_cpu.render(renderer, scene, options, image, stats, NULL, NULL)) return -1;
        double took = now_ms() - start;
        if (i > 0 && took < least) least = took;
    }
    return least;
}

/* What a change of the transfer function and what a change of the camera costs before the first ray: pictures of one
 * pixel. */
static void measure_changes(ang_renderer *renderer, ang_scene scene, const ang_render_options *options, int frames) {
    ang_transfer *other[2] = {ang_transfer_shifted(scene.transfer, 5, NULL),
                              ang_transfer_shifted(scene.transfer, 9, NULL)};
    ang_image image = {0};
    scene.width = scene.height = 1;
    if (!other[0] || !other[1] || !ang_image_create(&image, 1, 1, NULL)) return;
    double changed = 1e30, same = 1e30;
    for (int i = 0; i < 2 * frames; i++) {
        scene.transfer = other[i % 2];
        double start = now_ms();
        if (!ang_method_cpu.render(renderer, &scene, options, &image, NULL, NULL, NULL)) return;
        double between = now_ms();
        if (!ang_method_cpu.render(renderer, &scene, options, &image, NULL, NULL, NULL)) return;
        if (i > 1 && between - start < changed) changed = between - start;
        if (i > 1 && now_ms() - between < same) same = now_ms() - between;
    }
    printf("another transfer function %.2f ms, the same %.2f ms\n", changed, same);
    ang_transfer_free(other[0]);
    ang_transfer_free(other[1]);
    ang_image_clear(&image);
}

int main(int argc, char **argv) {
    if (argc < 3) return 2;
    int frames = argc > 3 ? atoi(argv[3]) : 3;
    ang_error err = {0};
    ang_load_report report = {0};
    ang_load_options how = {.threads = 0};
    ang_volume *volume = ang_load(argv[1], &how, &report, NULL, &err);
    if (!volume) return fprintf(stderr, "%s\n", err.message), 3;
    ang_render_options options = ang_render_options_default;
    options.threads = 1;
    ang_cast_width widths[ANG_CAST_WIDTHS];
    int count = ang_cast_widths(widths);
    static const struct {
        const char *name, *preset;
        ang_mode mode;
        ang_shading shading;
    } scenes[] = {{"angio plain", "angio", ANG_MODE_DVR, ANG_SHADING_NONE},
                  {"angio shaded", "angio", ANG_MODE_DVR, ANG_SHADING_PHONG},
                  {"mip", "mip", ANG_MODE_MIP, ANG_SHADING_NONE},
                  {"tissue", "tissue", ANG_MODE_DVR, ANG_SHADING_NONE}};
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        char path[4096];
        if (argc > 4 && strncmp(scenes[s].name, argv[4], strlen(argv[4])) != 0) continue;
        snprintf(path, sizeof path, "%s/tf/%s.json", argv[2], scenes[s].preset);
        ang_preset *preset = ang_preset_load(path, &err);
        ang_renderer *renderer = preset ? ang_method_cpu.create(NULL, volume, &options, &err) : NULL;
        ang_scene scene = ang_scene_default(volume);
        ang_image image = {0};
        if (!renderer || !ang_image_create(&image, scene.width, scene.height, &err))
            return fprintf(stderr, "%s\n", err.message), 2;
        scene.mode = scenes[s].mode;
        scene.shading = scenes[s].shading;
        scene.transfer = preset->transfer;
        scene.window_centre = 300;
        scene.window_width = 600;
        for (int w = 0; w < count; w++) {
            if (argc > 5 && strncmp(widths[w].name, argv[5], strlen(argv[5])) != 0) continue;
            ang_cpu_set_width(renderer, &widths[w]);
            double total = 0, samples = 0;
            for (int turn = 0; turn < 3; turn++) {
                ang_view view = ang_view_default;
                view.azimuth_deg = 120 * turn + 10;
                view.elevation_deg = 20;
                view.zoom = 1.7;
                scene.camera = ang_camera_for(volume, &view);
                ang_frame_stats stats = {0};
                total += least_ms(renderer, &scene, &options, frames, &image, &stats) / 3;
                samples += (double)stats.samples / 3;
            }
            printf("%-12s %-18s %7.1f ms, %6.1f million samples, %.2f ns a sample\n", scenes[s].name, widths[w].name,
                   total, samples / 1e6, total * 1e6 / samples);
            fflush(stdout);
        }
        if (s == 0) measure_changes(renderer, scene, &options, frames);
        ang_method_cpu.destroy(renderer);
        ang_image_clear(&image);
        ang_preset_free(preset);
    }
    ang_volume_free(volume);
    ang_load_report_clear(&report);
    return 0;
}
