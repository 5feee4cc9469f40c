/* What was measured before: numbers in one JSON file, pictures in a file each, all under hashes of what decides them.
 */
#include "app/report/report.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "io/checksum.h"
#include "io/json.h"
#include "io/machine.h"
#include "io/replace.h"

#include <dirent.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double save_every_ms = 5000;
static const char magic[8] = "ANGRGBA1";

struct ang_report_cache {
    char folder[4096];
    uint64_t key;      /* of what all results depend on */
    cJSON *old, *kept; /* results by hash: as found; asked for or made since */
    char (*pictures)[24];
    size_t picture_count;
    double saved_ms;
    bool changed;
};

/* FNV-1a, 64 bits (Fowler, Noll & Vo, IETF draft-eastlake-fnv). */
static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t length) {
    const unsigned char *p = bytes;
    for (size_t i = 0; i < length; i++) hash = (hash ^ p[i]) * 0x100000001b3u;
    return hash;
}

static void add(uint64_t *hash, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add(uint64_t *hash, const char *format, ...) {
    char text[4608];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    /* The final NUL parts one piece from the next. */
    *hash = hash_bytes(*hash, text, length < (int)sizeof text ? (size_t)length + 1 : sizeof text);
}

static void add_option(void *context, const char *name, const char *value) {
    /* These change nothing of what is measured. The file of a preset counts by what is in it. */
    static const char *const other[] = {"output", "quiet", "verbose", "help", "preset", "method", "time-limit"};
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
        if (strcmp(name, other[i]) == 0) return;
    add(context, "%s=%s", name, value);
}

static void add_volume(uint64_t *hash, const ang_volume *volume) {
    size_t count = ang_volume_count(volume);
    add(hash, "volume %08x %dx%dx%d %a %a %zu", ang_checksum(0, volume->data, count * sizeof *volume->data),
        volume->dims[0], volume->dims[1], volume->dims[2], volume->slope, volume->intercept, volume->padding_count);
    *hash = hash_bytes(*hash, &volume->affine, sizeof volume->affine);
    if (volume->padding)
        add(hash, "padding %08x", ang_checksum(0, volume->padding, (count + 63) / 64 * sizeof *volume->padding));
}

/* What of a scene the options do not say: the preset's part. */
static void add_scene(uint64_t *hash, const ang_scene *scene) {
    add(hash, "scene %d %d %a %a %a", (int)scene->mode, (int)scene->shading, scene->iso_hu, scene->window_centre,
        scene->window_width);
    add(hash, "phong %a %a %a %a %a", scene->phong.ambient, scene->phong.diffuse, scene->phong.specular,
        scene->phong.power, scene->phong.g0);
    const ang_transfer *transfer = scene->transfer;
    add(hash, "transfer %zu %a %d", transfer->count, transfer->unit_distance, (int)transfer->by_extinction);
    for (size_t i = 0; i < transfer->count; i++) {
        const ang_transfer_point *point = &transfer->points[i];
        add(hash, "%a %a %a %a %a", point->hu, point->colour[0], point->colour[1], point->colour[2], point->opacity);
    }
}

static uint64_t key_of(const ang_report *report) {
    uint64_t hash = 0xcbf29ce484222325u;
    add(&hash, "angioscope %s %08x", ANG_VERSION, ang_machine_program_checksum());
    add_volume(&hash, report->volume);
    add_scene(&hash, &report->picture.scene);
    ang_options_each(ANG_VERB_REPORT, report->options, add_option, &hash);
    if (report->gl)
        add(&hash, "%s %s %s", ang_gl_backend(report->gl), ang_gl_renderer(report->gl), ang_gl_version(report->gl));
    add(&hash, "%s %d", report->processor, report->threads);
    return hash;
}

static void name_of(const ang_report_cache *cache, const char *what, char name[17]) {
    uint64_t hash = cache->key;
    add(&hash, "%s", what);
    snprintf(name, 17, "%016llx", (unsigned long long)hash);
}

static bool path_of(const ang_report_cache *cache, const char *name, const char *ending, char *path, size_t size) {
    int length = snprintf(path, size, "%s/%s%s", cache->folder, name, ending);
    return length > 0 && (size_t)length < size;
}

ang_report_cache *ang_report_cache_open(const ang_report *report, ang_error *err) {
    ang_report_cache *cache = ang_alloc(1, sizeof *cache, "results", err);
    if (!cache) return NULL;
    snprintf(cache->folder, sizeof cache->folder, "%s/cache", report->options->output);
    cache->key = key_of(report);
    cache->saved_ms = ang_now_ms();
    cache->kept = cJSON_CreateObject();
    if (!cache->kept || !ang_folder_make(cache->folder, err)) {
        if (!cache->kept) ang_fail(err, ANG_LIMIT, "no memory for results");
        ang_report_cache_close(cache);
        return NULL;
    }
    char path[4200];
    ang_json json = {0};
    /* What cannot be read is measured again. */
    if (path_of(cache, "results", ".json", path, sizeof path) && ang_json_open(path, &json, NULL)) {
        cache->old = json.root;
        json.root = NULL;
    }
    ang_json_close(&json);
    return cache;
}

void ang_report_cache_close(ang_report_cache *cache) {
    if (!cache) return;
    cJSON_Delete(cache->old);
    cJSON_Delete(cache->kept);
    free(cache->pictures);
    free(cache);
}

bool ang_report_cache_save(ang_report_cache *cache, bool at_once, ang_error *err) {
    if (!cache->changed || (!at_once && ang_now_ms() - cache->saved_ms < save_every_ms)) return true;
    /* Results of other settings stay until a report is done: it may be interrupted and they be asked for again. */
    cJSON *all = cJSON_Duplicate(cache->kept, true);
    for (const cJSON *item = cache->old ? cache->old->child : NULL; item && all; item = item->next)
        if (!cJSON_GetObjectItemCaseSensitive(all, item->string))
            cJSON_AddItemToObject(all, item->string, cJSON_Duplicate(item, true));
    char path[4200], *text = all ? cJSON_PrintUnformatted(all) : NULL;
    cJSON_Delete(all);
    if (!text) return ang_fail(err, ANG_LIMIT, "no memory for results");
    bool done =
        path_of(cache, "results", ".json", path, sizeof path) && ang_file_replace(path, text, strlen(text), err);
    free(text);
    cache->saved_ms = ang_now_ms();
    cache->changed = !done;
    return done;
}

const cJSON *ang_report_cache_get(ang_report_cache *cache, const char *what) {
    char name[17];
    name_of(cache, what, name);
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(cache->kept, name);
    if (item || !cache->old) return item;
    cJSON *found = cJSON_DetachItemFromObjectCaseSensitive(cache->old, name);
    if (found) cJSON_AddItemToObject(cache->kept, name, found);
    return found;
}

void ang_report_cache_put(ang_report_cache *cache, const char *what, cJSON *value) {
    char name[17];
    name_of(cache, what, name);
    const cJSON *before = ang_report_cache_get(cache, what);
    if (before && cJSON_Compare(before, value, true)) {
        cJSON_Delete(value);
        return;
    }
    cJSON_DeleteItemFromObjectCaseSensitive(cache->kept, name);
    cJSON_AddItemToObject(cache->kept, name, value);
    cache->changed = true;
}

/* What tells one run from all others of a report. The subset, and whether there is a whole truth, decide errors. */
static void run_name(const ang_report *report, const ang_report_run *run, char name[160]) {
    const ang_report_truth *truth = &report->truth;
    snprintf(name, 160, "%s %s %a %a %s %s|%d %d %d %d", ang_report_group_name(run->group), run->method->name,
             run->options.step_voxels, run->options.termination, run->switched, run->subset ? "subset" : "all",
             truth->stride, truth->first_x, truth->first_y, truth->whole.rgba != NULL);
}

void ang_report_picture_name(const ang_report *report, const ang_report_run *run, char name[160]) {
    run_name(report, run, name);
}

static cJSON *metrics_json(const ang_metrics *metrics) {
    return cJSON_CreateDoubleArray((double[]){metrics->max, metrics->rms, metrics->p999,
                                              isfinite(metrics->psnr) ? metrics->psnr : -1,
                                              isfinite(metrics->ssim) ? metrics->ssim : -2, metrics->flipped},
                                   6);
}

static double number(const cJSON *array, int index) { return cJSON_GetNumberValue(cJSON_GetArrayItem(array, index)); }

static ang_metrics metrics_from(const cJSON *array) {
    double psnr = number(array, 3), ssim = number(array, 4);
    return (ang_metrics){.max = number(array, 0),
                         .rms = number(array, 1),
                         .p999 = number(array, 2),
                         .psnr = psnr < 0 ? (double)INFINITY : psnr,
                         .ssim = ssim < -1 ? (double)NAN : ssim,
                         .flipped = number(array, 5)};
}

void ang_report_cache_put_run(ang_report_cache *cache, const ang_report *report, const ang_report_run *run) {
    cJSON *value = cJSON_CreateObject();
    cJSON_AddItemToObject(value, "error", metrics_json(&run->error));
    cJSON_AddItemToObject(value, "subset_error", metrics_json(&run->subset_error));
    cJSON_AddItemToObject(
        value, "counts",
        cJSON_CreateDoubleArray((double[]){(double)run->compared, (double)run->samples, (double)run->pixels,
                                           run->passes, run->step_mm, run->rough_ms, run->classification},
                                7));
    cJSON_AddItemToObject(value, "frame_ms", cJSON_CreateDoubleArray(run->frame_ms, run->frames));
    char name[160];
    run_name(report, run, name);
    ang_report_cache_put(cache, name, value);
}

bool ang_report_cache_get_run(ang_report_cache *cache, const ang_report *report, ang_report_run *run) {
    char name[160];
    run_name(report, run, name);
    const cJSON *value = ang_report_cache_get(cache, name);
    const cJSON *error = cJSON_GetObjectItemCaseSensitive(value, "error");
    const cJSON *subset = cJSON_GetObjectItemCaseSensitive(value, "subset_error");
    const cJSON *counts = cJSON_GetObjectItemCaseSensitive(value, "counts");
    const cJSON *times = cJSON_GetObjectItemCaseSensitive(value, "frame_ms");
    if (cJSON_GetArraySize(error) != 6 || cJSON_GetArraySize(subset) != 6 || cJSON_GetArraySize(counts) != 7)
        return false;
    run->error = metrics_from(error);
    run->subset_error = metrics_from(subset);
    run->compared = (size_t)number(counts, 0);
    run->samples = (uint64_t)number(counts, 1);
    run->pixels = (uint64_t)number(counts, 2);
    run->passes = (int)number(counts, 3);
    run->step_mm = number(counts, 4);
    run->rough_ms = number(counts, 5);
    run->classification = (ang_classify)number(counts, 6);
    run->frames = 0;
    for (int i = 0; i < cJSON_GetArraySize(times) && i < ANG_REPORT_FRAMES; i++)
        run->frame_ms[run->frames++] = number(times, i);
    run->drawn = true;
    return true;
}

/* Pictures in use are remembered, so that all others can be removed. */
static void use_picture(ang_report_cache *cache, const char *name) {
    char(*more)[24] = realloc(cache->pictures, (cache->picture_count + 1) * sizeof *more);
    if (!more) return;
    cache->pictures = more;
    snprintf(more[cache->picture_count++], sizeof *more, "%s.rgba", name);
}

void ang_report_cache_use_image(ang_report_cache *cache, const char *what) {
    char name[17];
    name_of(cache, what, name);
    use_picture(cache, name);
}

bool ang_report_cache_get_image(ang_report_cache *cache, const char *what, int width, int height, ang_image *image) {
    char name[17], path[4200], found[sizeof magic];
    name_of(cache, what, name);
    FILE *file = path_of(cache, name, ".rgba", path, sizeof path) ? fopen(path, "rb") : NULL;
    if (!file) return false;
    int size[2];
    size_t values = 4 * (size_t)width * (size_t)height;
    bool good = fread(found, sizeof found, 1, file) == 1 && memcmp(found, magic, sizeof magic) == 0 &&
                fread(size, sizeof size, 1, file) == 1 && size[0] == width && size[1] == height &&
                ang_image_create(image, width, height, NULL);
    if (good && fread(image->rgba, sizeof(float), values, file) != values) {
        ang_image_clear(image);
        good = false;
    }
    fclose(file);
    if (good) use_picture(cache, name);
    return good;
}

bool ang_report_cache_put_image(ang_report_cache *cache, const char *what, const ang_image *image, ang_error *err) {
    size_t values = 4 * (size_t)image->width * (size_t)image->height * sizeof(float);
    int size[2] = {image->width, image->height};
    unsigned char *bytes = ang_alloc(sizeof magic + sizeof size + values, 1, "a picture", err);
    if (!bytes) return false;
    memcpy(bytes, magic, sizeof magic);
    memcpy(bytes + sizeof magic, size, sizeof size);
    memcpy(bytes + sizeof magic + sizeof size, image->rgba, values);
    char name[17], path[4200];
    name_of(cache, what, name);
    bool done = path_of(cache, name, ".rgba", path, sizeof path) &&
                ang_file_replace(path, bytes, sizeof magic + sizeof size + values, err);
    free(bytes);
    return done;
}

static bool is_picture(const char *file) {
    return strlen(file) == 21 && strspn(file, "0123456789abcdef") == 16 && strcmp(file + 16, ".rgba") == 0;
}

void ang_report_cache_prune(ang_report_cache *cache) {
    if (cache->old && cache->old->child) cache->changed = true;
    cJSON_Delete(cache->old);
    cache->old = NULL;
    DIR *folder = opendir(cache->folder);
    for (const struct dirent *entry; folder && (entry = readdir(folder));) {
        bool used = !is_picture(entry->d_name);
        for (size_t i = 0; i < cache->picture_count && !used; i++)
            used = strcmp(cache->pictures[i], entry->d_name) == 0;
        if (!used) unlinkat(dirfd(folder), entry->d_name, 0);
    }
    if (folder) closedir(folder);
}
