#include "io/dicom/assemble.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "io/checksum.h"
#include "io/dicom/decode.h"
#include "io/dicom/mask.h"
#include "io/dicom/stored.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

/* What is known of one slice once it is decoded. */
typedef struct decoded {
    ang_dicom_map map;
    bool has_padding, masked;
    uint16_t padding_first, padding_last; /* declared */
    uint16_t least, greatest;             /* of its values, declared padding left out; least > greatest: none */
    size_t padding_count;
    uint32_t crc;
} decoded;

typedef struct decode_job {
    const ang_dicom_stack *stack;
    const ang_progress *progress;
    ang_volume *volume;
    decoded *decoded;
    bool *failed;
    char **reasons;
    atomic_size_t done;
    atomic_bool stop, any_failed;
} decode_job;

static size_t plane_size(const ang_volume *volume) { return (size_t)volume->dims[0] * (size_t)volume->dims[1]; }

static void measure(const uint16_t *data, size_t count, decoded *slice) {
    slice->crc = ang_checksum(0, data, count * sizeof *data);
    ang_mask_extent(data, count, &slice->least, &slice->greatest);
    if (!slice->has_padding || slice->padding_last < slice->least || slice->padding_first > slice->greatest) return;
    ang_mask_range range = {slice->padding_first, slice->padding_last, 0};
    slice->padding_count = ang_mask_count(data, count, range, &slice->least, &slice->greatest);
}

static void show_slice(const ang_dicom_stack *stack, size_t index, const uint16_t *data) {
    if (!stack->sink.take) return;
    ang_raw_slice slice = ang_dicom_raw_slice(&stack->slices[stack->order[index]], data);
    slice.index = index;
    slice.count = stack->count;
    stack->sink.take(stack->sink.context, &slice);
}

static void decode_slices(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    decode_job *job = context;
    const ang_dicom_stack *stack = job->stack;
    size_t plane = plane_size(job->volume);
    for (size_t i = begin; i < end; i++) {
        if (atomic_load_explicit(&job->stop, memory_order_relaxed)) return;
        const ang_dicom_slice *slice = &stack->slices[stack->order[i]];
        uint16_t *data = job->volume->data + i * plane;
        decoded *out = &job->decoded[i];
        ang_error why = {0};
        if (!ang_dicom_decode(stack->paths[slice->file], stack->labels[slice->file], slice, stack->sandbox, data,
                              &out->masked, &why)) {
            job->failed[i] = true;
            job->reasons[i] = strdup(why.message);
            atomic_store(&job->any_failed, true);
            continue;
        }
        out->map = ang_dicom_map_of(slice);
        out->has_padding = ang_dicom_padding(slice, &out->padding_first, &out->padding_last);
        measure(data, plane, out);
        show_slice(stack, i, data);
        double share = (double)(atomic_fetch_add(&job->done, 1) + 1) / (double)stack->count;
        if (!ang_progress_update(job->progress, "reading slices", share)) atomic_store(&job->stop, true);
    }
}

/* A volume with room for the slices and for the planes between them. */
static ang_volume *create_volume(const ang_dicom_stack *stack, ang_error *err) {
    const ang_dicom_slice *first = &stack->slices[stack->order[0]];
    size_t planes = stack->grid->planes > stack->count ? stack->grid->planes : stack->count;
    double bytes = 2.0 * first->columns * first->rows * (double)planes;
    double memory = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    if (bytes > memory) {
        ang_fail(err, ANG_LIMIT, "a volume of %d x %d x %zu needs %.1f GB, this machine has %.1f GB", first->columns,
                 first->rows, planes, bytes / 1e9, memory / 1e9);
        return NULL;
    }
    ang_volume *volume = ang_volume_create((int[3]){first->columns, first->rows, (int)planes}, err);
    if (!volume) return NULL;
    /* Fresh pages cost as much as the reading: ask for large ones. Nothing is lost where the system has none. */
    uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE), start = (uintptr_t)volume->data;
    uintptr_t stop = (start + ang_volume_count(volume) * sizeof *volume->data) / page * page;
    start = (start + page - 1) / page * page;
    if (stop > start) madvise((void *)start, stop - start, MADV_HUGEPAGE);
    volume->dims[2] = (int)stack->count; /* until resample() fills the other planes */
    return volume;
}

static uint32_t join_checksums(const decoded *decoded, size_t count, size_t plane) {
    uLong crc = 0;
    uLong step = (uLong)crc32_combine_gen((z_off_t)(plane * sizeof(uint16_t)));
    for (size_t i = 0; i < count; i++) crc = i ? crc32_combine_op(crc, decoded[i].crc, step) : decoded[i].crc;
    return (uint32_t)crc;
}

typedef struct remap_job {
    ang_volume *volume;
    const decoded *decoded;
    ang_dicom_common common;
    bool mark;             /* declared padding occurs */
    ang_mask_range *range; /* per slice */
    ang_mask_result *result;
} remap_job;

static void remap_slices(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    remap_job *job = context;
    size_t plane = plane_size(job->volume);
    uint16_t *table = job->common.same ? NULL : malloc(65536 * sizeof *table);
    for (size_t i = begin; i < end; i++) {
        const decoded *slice = &job->decoded[i];
        uint16_t *data = job->volume->data + i * plane;
        if (!job->common.same) {
            for (uint32_t v = 0; table && v < 65536; v++)
                table[v] = ang_dicom_remap((uint16_t)v, slice->map, job->common.map);
        }
        ang_mask_range range = job->range[i];
        bool mark = job->mark && range.first <= range.last;
        if (!job->common.same) {
            for (size_t k = 0; k < plane; k++) {
                uint16_t value = data[k];
                bool padding = mark && value >= range.first && value <= range.last;
                if (padding) ang_mask_set(job->volume->padding, i * plane + k);
                job->result[i].count += padding;
                data[k] = padding ? range.fill
                          : table ? table[value]
                                  : ang_dicom_remap(value, slice->map, job->common.map);
                if (padding) continue;
                if (data[k] < job->result[i].least) job->result[i].least = data[k];
                if (data[k] > job->result[i].greatest) job->result[i].greatest = data[k];
            }
        } else if (mark) {
            job->result[i] = ang_mask_mark(data, plane, i * plane, range, job->volume->padding);
        }
    }
    free(table);
}

static bool ensure_mask(ang_volume *volume, ang_error *err) {
    if (volume->padding) return true;
    volume->padding = ang_alloc((ang_volume_count(volume) + 63) / 64, sizeof *volume->padding, "padding mask", err);
    return volume->padding != NULL;
}

/* Marks (rule 10) and remaps in one pass, and sums up the range. */
static bool pass_over(const ang_dicom_stack *stack, remap_job *job, ang_error *err) {
    ang_volume *volume = job->volume;
    if (job->mark && !ensure_mask(volume, err)) return false;
    job->result = ang_alloc(stack->count, sizeof *job->result, "slices", err);
    if (!job->result) return false;
    for (size_t i = 0; i < stack->count; i++)
        job->result[i] = (ang_mask_result){0, job->common.same ? job->decoded[i].least : UINT16_MAX,
                                           job->common.same ? job->decoded[i].greatest : 0};
    ang_parallel_for(stack->count, 1, stack->threads, remap_slices, job);
    volume->minimum = UINT16_MAX;
    volume->maximum = 0;
    for (size_t i = 0; i < stack->count; i++) {
        volume->padding_count += job->result[i].count;
        if (job->result[i].least < volume->minimum) volume->minimum = job->result[i].least;
        if (job->result[i].greatest > volume->maximum) volume->maximum = job->result[i].greatest;
    }
    free(job->result);
    return true;
}

/* The map of the file, where all slices have the same. */
static void report_map(const ang_dicom_stack *stack, const ang_dicom_map *maps, ang_load_report *report) {
    bool is_signed = stack->slices[stack->order[0]].is_signed;
    report->slope = report->intercept = NAN;
    for (size_t i = 1; i < stack->count; i++)
        if (maps[i].slope != maps[0].slope || maps[i].intercept != maps[0].intercept ||
            stack->slices[stack->order[i]].is_signed != is_signed)
            return;
    report->slope = maps[0].slope;
    report->intercept = maps[0].intercept + (is_signed ? 32768 * maps[0].slope : 0);
}

static void note_masked(const ang_dicom_stack *stack, const decoded *decoded, ang_load_report *report) {
    int masked = 0;
    for (size_t i = 0; i < stack->count; i++) masked += decoded[i].masked;
    if (masked > 0)
        ang_notes_add(
            &report->assumptions,
            "%d slice%s with bits set outside the %d of BitsStored and HighBit, as old overlays are: left out", masked,
            ang_plural(masked), stack->slices[stack->order[0]].bits_stored);
}

/* Declared padding and rescale, then padding that nobody declared. */
static bool finish_values(const ang_dicom_stack *stack, ang_volume *volume, const decoded *decoded,
                          ang_load_report *report, ang_error *err) {
    size_t count = stack->count;
    ang_dicom_map *maps = ang_alloc(count, sizeof *maps, "slices", err);
    uint16_t *least = ang_alloc(count, sizeof *least, "slices", err);
    uint16_t *greatest = ang_alloc(count, sizeof *greatest, "slices", err);
    ang_mask_range *ranges = ang_alloc(count, sizeof *ranges, "slices", err);
    bool ok = maps && least && greatest && ranges;
    size_t declared = 0;
    for (size_t i = 0; ok && i < count; i++) {
        maps[i] = decoded[i].map;
        least[i] = decoded[i].least;
        greatest[i] = decoded[i].greatest;
        ranges[i] = decoded[i].has_padding ? (ang_mask_range){decoded[i].padding_first, decoded[i].padding_last, 0}
                                           : (ang_mask_range){1, 0, 0};
        if (decoded[i].padding_count && declared == 0)
            report->padding_hu = decoded[i].map.slope * decoded[i].padding_first + decoded[i].map.intercept;
        declared += decoded[i].padding_count;
    }
    if (ok) {
        report_map(stack, maps, report);
        ang_dicom_common common = ang_dicom_merge(maps, least, greatest, count);
        if (declared > 0) ang_dicom_make_room(&common, greatest, count);
        volume->slope = common.map.slope;
        volume->intercept = common.map.intercept;
        report->rescale_error_hu = common.error_hu;
        for (size_t i = 0; i < count; i++) ranges[i].fill = ang_volume_padding_value(volume);
        report->padding_declared = declared > 0;
        remap_job job = {.volume = volume, .decoded = decoded, .common = common, .mark = declared > 0, .range = ranges};
        ok = pass_over(stack, &job, err);
        uint16_t found;
        if (ok && ang_volume_find_padding(volume, &found)) {
            report->padding_found = true;
            report->padding_found_hu = ang_volume_hu(volume, found);
            if (declared == 0) report->padding_hu = report->padding_found_hu;
            for (size_t i = 0; i < count; i++)
                ranges[i] = (ang_mask_range){found, found, ang_volume_padding_value(volume)};
            job.mark = true;
            job.common.same = true; /* the values are under the common map by now */
            ok = pass_over(stack, &job, err);
            if (ok && declared > 0)
                ang_volume_update_range(volume, stack->threads); /* that pass saw the other's fill */
        }
    }
    free(maps);
    free(least);
    free(greatest);
    free(ranges);
    return ok;
}

typedef struct resample_job {
    const ang_dicom_stack *stack;
    ang_volume *volume;
    uint64_t *mask; /* of the planes; NULL where there is no padding */
    uint16_t fill;
    uint16_t **values; /* per worker: one row of every slice */
    uint8_t **padding;
} resample_job;

static void resample_rows(void *context, size_t begin, size_t end, int worker) {
    resample_job *job = context;
    const ang_volume *volume = job->volume;
    const ang_dicom_grid *grid = job->stack->grid;
    size_t width = (size_t)volume->dims[0], plane = plane_size(volume), count = job->stack->count;
    uint16_t *values = job->values[worker];
    uint8_t *padding = job->padding[worker];
    for (size_t row = begin; row < end; row++) {
        for (size_t i = 0; i < count; i++) {
            size_t at = i * plane + row * width;
            memcpy(values + i * width, volume->data + at, width * sizeof *values);
            for (size_t x = 0; job->mask && x < width; x++)
                padding[i * width + x] = ang_volume_is_padding(volume, at + x);
        }
        for (size_t p = 0; p < grid->planes; p++) {
            const uint16_t *a = values + grid->below[p] * width, *b = grid->weight[p] > 0 ? a + width : a;
            const uint8_t *pa = padding + grid->below[p] * width, *pb = grid->weight[p] > 0 ? pa + width : pa;
            uint16_t *out = volume->data + p * plane + row * width;
            float weight = grid->weight[p];
            for (size_t x = 0; x < width; x++) {
                uint16_t mixed = (uint16_t)lrintf((float)a[x] + weight * ((float)b[x] - (float)a[x]));
                if (job->mask && (pa[x] || pb[x])) {
                    /* Mixing tissue with what is no measurement would invent a value: the nearer one decides. */
                    bool near_b = weight >= 0.5F, is_padding = near_b ? pb[x] : pa[x];
                    mixed = is_padding ? job->fill : near_b ? b[x] : a[x];
                    if (is_padding) ang_mask_set(job->mask, p * plane + row * width + x);
                }
                out[x] = mixed;
            }
        }
    }
}

/* Slices in the first planes become all planes of the grid, in place, row by row. */
static bool resample(const ang_dicom_stack *stack, ang_volume *volume, ang_error *err) {
    const ang_dicom_grid *grid = stack->grid;
    int threads = ang_thread_count(stack->threads);
    size_t row = stack->count * (size_t)volume->dims[0], planes = grid->planes, plane = plane_size(volume);
    uint16_t *values[ANG_MAX_THREADS] = {0};
    uint8_t *padding[ANG_MAX_THREADS] = {0};
    resample_job job = {.stack = stack,
                        .volume = volume,
                        .fill = ang_volume_padding_value(volume),
                        .values = values,
                        .padding = padding};
    bool ok = true;
    if (volume->padding) {
        job.mask = ang_alloc((planes * plane + 63) / 64, sizeof *job.mask, "padding mask", err);
        ok = job.mask != NULL;
    }
    for (int t = 0; ok && t < threads; t++) {
        values[t] = ang_alloc(row, sizeof *values[t], "rows", err);
        padding[t] = values[t] ? ang_alloc(row, 1, "rows", err) : NULL;
        ok = padding[t] != NULL;
    }
    if (ok) ang_parallel_for((size_t)volume->dims[1], 1, threads, resample_rows, &job);
    for (int t = 0; t < threads; t++) {
        free(values[t]);
        free(padding[t]);
    }
    if (!ok) {
        free(job.mask);
        return false;
    }
    volume->dims[2] = (int)planes;
    if (!job.mask) return true;
    free(volume->padding);
    volume->padding = job.mask;
    volume->padding_count = 0;
    for (size_t i = 0; i < (planes * plane + 63) / 64; i++)
        volume->padding_count += (size_t)__builtin_popcountll(volume->padding[i]);
    return true;
}

ang_volume *ang_dicom_assemble(const ang_dicom_stack *stack, ang_load_report *report, const ang_progress *progress,
                               bool *failed, char **reasons, ang_error *err) {
    ang_volume *volume = create_volume(stack, err);
    decoded *decoded = volume ? ang_alloc(stack->count, sizeof *decoded, "slices", err) : NULL;
    if (!decoded) {
        ang_volume_free(volume);
        return NULL;
    }
    decode_job job = {.stack = stack,
                      .progress = progress,
                      .volume = volume,
                      .decoded = decoded,
                      .failed = failed,
                      .reasons = reasons};
    ang_parallel_for(stack->count, 1, stack->threads, decode_slices, &job);
    bool ok = true;
    if (job.stop)
        ok = ang_fail(err, ANG_INTERRUPTED, "interrupted while reading slices");
    else if (job.any_failed)
        ok = ang_fail(err, ANG_INPUT, "some slices cannot be decoded");
    if (ok) {
        report->stored_crc32 = join_checksums(decoded, stack->count, plane_size(volume));
        note_masked(stack, decoded, report);
        ok = finish_values(stack, volume, decoded, report, err);
    }
    if (ok && stack->grid->interpolates) {
        ok = resample(stack, volume, err);
        if (ok) ang_volume_update_range(volume, stack->threads);
    }
    free(decoded);
    if (!ok) {
        ang_volume_free(volume);
        return NULL;
    }
    volume->affine = stack->grid->affine;
    if (volume->padding_count == 0) {
        free(volume->padding);
        volume->padding = NULL;
    }
    if (volume->minimum > volume->maximum) volume->minimum = volume->maximum = ang_volume_padding_value(volume);
    return volume;
}
