/* The estimate of a picture's error beside the truth, over scenes drawn by lot: in how many it is not below, and how
 * many times the truth it is (docs/error.md).
 *   measure_estimate PRESETS [DATA [SCENES [SEED [MODE [cut]]]]]
 * PRESETS: the folder; DATA: the folder of real volumes, "" for synthetic ones alone; SCENES of each volume; MODE dvr,
 * or mip, minip or mean; cut: with a cut plane each. */
#include "tests/core/judged.h"

#include "core/render/context.h"
#include "core/volume/phantom.h"
#include "io/load.h"
#include "io/preset/preset.h"

#include <zlib.h>

enum { SIZE = 384, MOST_TRANSFERS = 8 };

static void stop(const char *what, const ang_error *err) {
    fprintf(stderr, "%s: %s\n", what, err->message);
    exit(1);
}

static ang_volume *make_head(ang_error *err) {
    ang_phantom_params params = ang_phantom_params_default;
    params.dims[0] = params.dims[1] = 224;
    params.dims[2] = 64;
    return ang_phantom_make(&params, 0, NULL, NULL, err);
}

/* Bytes in a gzip file. */
static ang_volume *read_bytes(const char *path, const int dims[3], ang_error *err) {
    ang_volume *volume = ang_volume_create(dims, err);
    gzFile file = gzopen(path, "rb");
    bool good = volume && file;
    for (int row = 0; good && row < dims[1] * dims[2]; row++) {
        unsigned char bytes[4096];
        good = gzread(file, bytes, (unsigned)dims[0]) == dims[0];
        for (int x = 0; x < dims[0]; x++) volume->data[(size_t)row * (size_t)dims[0] + (size_t)x] = bytes[x];
    }
    if (file) gzclose(file);
    if (!good) {
        ang_fail(err, ANG_INPUT, "%s: cannot be read", path);
        return NULL;
    }
    ang_volume_update_range(volume, 0);
    return volume;
}

static ang_volume *read_file(const char *path, ang_error *err) {
    ang_load_options how = {0};
    ang_load_report report = {0};
    ang_volume *volume = ang_load(path, &how, &report, NULL, err);
    ang_load_report_clear(&report);
    return volume;
}

typedef struct source {
    const char *name;
    const char *file; /* in DATA; NULL: synthetic */
    const char *transfers[MOST_TRANSFERS];
} source;

static const source sources[] = {
    {"waves", NULL, {"smooth", "step", "spike", "plateau", "cta-head"}},
    {"ball", NULL, {"smooth", "step", "spike", "plateau", "ct-bone"}},
    {"head", NULL, {"cta-head", "ct-skull", "cta-neck", "ct-bone", "ct-soft-tissue", "ct-skin", "cta-coronaries"}},
    {"chest",
     "chest-contrast-ct",
     {"cta-thorax", "ct-bone", "ct-lung", "cta-pulmonary-arteries", "ct-soft-tissue", "cta-abdominal-aorta",
      "ct-muscle"}},
    {"avm", "volumes/prism_AVM.nii.gz", {"smooth", "step", "cta-head", "cta-runoff", "plateau"}},
    {"aneurism", "volumes/aneurism_256x256x256_uint8.raw.gz", {"smooth", "step", "spike", "mra", "plateau"}},
    {"bonsai", "volumes/bonsai.nii.gz", {"smooth", "step", "spike", "mra", "plateau"}},
};

static ang_volume *open_volume(const source *s, const char *data, ang_error *err) {
    static const int cube[3] = {256, 256, 256};
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", data, s->file ? s->file : "");
    if (strcmp(s->name, "waves") == 0) return judged_volume(waves_value);
    if (strcmp(s->name, "ball") == 0) return judged_volume(ball_value);
    if (strcmp(s->name, "head") == 0) return make_head(err);
    if (strstr(path, ".raw.gz")) return read_bytes(path, cube, err);
    return read_file(path, err);
}

static void print_row(const char *volume, const char *transfer, const drawn *d, const judged *j) {
    const ang_error_estimate *e = &j->estimate;
    printf(
        "%-9s %-22s %4.0f,%-3.0f %-11s %4.1f %-5s %-10s %-5g %-5g | %9.4f %9.4f %6.2f | %9.4f %9.4f %9.4f | %5.2f %5d "
        "%5.0f\n",
        volume, transfer, d->view.azimuth_deg, d->view.elevation_deg, ang_projection_name(d->view.projection),
        d->view.zoom, ang_shading_name(d->scene.shading), judged_methods[d->method]->name, d->options.step_voxels,
        d->options.termination, judged_estimate(j), judged_truth(j), judged_estimate(j) / judged_truth(j), e->step,
        e->termination, e->filtering, e->order, e->pixels, e->ms);
    fflush(stdout);
}

typedef struct bench {
    const source *source;
    const char *presets;
    ang_mode mode;
    bool cut;
    ang_gl *gl;
    ang_volume *volume;
    ang_renderer *renderer[JUDGED_METHODS], *truth;
} bench;

static void judge_one(bench *on, uint64_t *lot, judged *out) {
    ang_error err = {0};
    drawn d = draw_lot(on->volume, SIZE, on->cut, lot);
    if (on->cut) d.scene.objects = &d.objects;
    int transfers = 0;
    while (transfers < MOST_TRANSFERS && on->source->transfers[transfers]) transfers++;
    const char *name = on->source->transfers[(int)(transfers * random_unit(lot))];
    ang_transfer *transfer = judged_transfer(name, on->volume);
    ang_preset *preset = NULL;
    d.scene.transfer = transfer;
    d.scene.mode = on->mode;
    d.scene.iso_hu =
        0.4 * ang_volume_hu(on->volume, on->volume->minimum) + 0.6 * ang_volume_hu(on->volume, on->volume->maximum);
    if (!transfer) {
        preset = ang_preset_find(name, (const char *const[]){on->presets, NULL}, &err);
        if (!preset) stop(name, &err);
        d.scene.transfer = preset->transfer;
        d.scene.phong = preset->phong;
        d.scene.window_centre = preset->window_centre;
        d.scene.window_width = preset->window_width;
    }
    const ang_method *method = judged_methods[d.method];
    ang_renderer **renderer = &on->renderer[d.method];
    if (!*renderer) *renderer = method->create(on->gl, on->volume, &d.options, &err);
    if (!*renderer || !judge(method, *renderer, on->truth, &d.scene, &d.options, out, &err)) stop(method->name, &err);
    print_row(on->source->name, name, &d, out);
    ang_preset_free(preset);
    ang_transfer_free(transfer);
    ang_objects_clear(&d.objects);
}

/* `of` says with what; the rest of the bench is made and let go of here. */
static void judge_source(const bench *of, const char *data, int count, uint64_t *lot, judged *out) {
    ang_error err = {0};
    bench on = *of;
    on.volume = open_volume(of->source, data, &err);
    if (!on.volume) stop(of->source->name, &err);
    on.truth = ang_method_reference.create(NULL, on.volume, &ang_render_options_default, &err);
    for (int i = 0; i < count; i++) judge_one(&on, lot, &out[i]);
    for (int m = 0; m < JUDGED_METHODS; m++)
        if (on.renderer[m]) judged_methods[m]->destroy(on.renderer[m]);
    ang_method_reference.destroy(on.truth);
    ang_volume_free(on.volume);
}

static void print_verdict(const char *which, const judged *rows, int count, int first, int stride) {
    verdict v = judge_all(rows, count, first, stride);
    printf("%s: %d scenes; the estimate is not below the truth in %.1f %%; estimate / truth: median %.2f, 5 %% below "
           "%.2f, 5 %% above %.2f\n",
           which, v.scenes, 100 * v.not_below, v.median, v.lowest, v.highest);
}

int main(int count, char **arguments) {
    if (count < 2 || (count > 5 && ang_mode_from_name(arguments[5]) < 0)) {
        fprintf(stderr, "measure_estimate PRESETS [DATA [SCENES [SEED [MODE [cut]]]]]\n");
        return 2;
    }
    const char *data = count > 2 ? arguments[2] : "";
    int each = count > 3 ? atoi(arguments[3]) : 12;
    uint64_t lot = 0x9E3779B97F4A7C15u * (uint64_t)(count > 4 ? atoi(arguments[4]) : 1);
    for (int i = 0; i < 20; i++) random_unit(&lot);
    int mode = count > 5 ? ang_mode_from_name(arguments[5]) : ANG_MODE_DVR;
    bool cut = count > 6 && strcmp(arguments[6], "cut") == 0;
    ang_error err = {0};
    ang_gl *gl = ang_gl_create(ANG_BACKEND_AUTO, &err);
    if (!gl) stop("OpenGL", &err);
    enum { SOURCES = sizeof sources / sizeof *sources };
    judged *rows = calloc((size_t)(SOURCES * each), sizeof *rows);
    int made = 0;
    printf("%-91s | %9s %9s %6s | %9s %9s %9s | %5s %5s %5s\n",
           "volume    transfer function      view     projection  zoom shading method     step  termination",
           "estimate", "truth", "ratio", "step", "termin.", "filtering", "order", "pixel", "ms");
    for (int s = 0; s < SOURCES; s++) {
        if (sources[s].file && !*data) continue;
        bench with = {.source = &sources[s], .presets = arguments[1], .mode = (ang_mode)mode, .cut = cut, .gl = gl};
        judge_source(&with, data, each, &lot, &rows[made]);
        made += each;
    }
    printf("\n%s\n", ang_gl_renderer(gl));
    print_verdict("even scenes (tuned on)", rows, made, 0, 2);
    print_verdict("odd scenes (judged on)", rows, made, 1, 2);
    print_verdict("all", rows, made, 0, 1);
    ang_gl_destroy(gl);
    free(rows);
    return 0;
}
