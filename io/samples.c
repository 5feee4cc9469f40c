#include "io/samples.h"

#include "core/base/memory.h"
#include "io/checksum.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <zlib.h>

enum { samples_per_piece = 1 << 16 };

size_t ang_sample_size(ang_sample type) {
    static const unsigned char size[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return size[type];
}

static double sample_at(const uint8_t *p, ang_sample type, bool big_endian) {
    size_t size = ang_sample_size(type);
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++) bits |= (uint64_t)p[big_endian ? size - 1 - i : i] << (8 * i);
    switch (type) {
    case ANG_SAMPLE_I8:
        return (int8_t)bits;
    case ANG_SAMPLE_I16:
        return (int16_t)bits;
    case ANG_SAMPLE_I32:
        return (int32_t)bits;
    case ANG_SAMPLE_I64:
        return (double)(int64_t)bits;
    case ANG_SAMPLE_F32: {
        uint32_t word = (uint32_t)bits;
        float value;
        memcpy(&value, &word, sizeof value);
        return (double)value;
    }
    case ANG_SAMPLE_F64: {
        double value;
        memcpy(&value, &bits, sizeof value);
        return value;
    }
    default:
        return (double)bits;
    }
}

/* How samples become stored values: stored = (sample - low) / step. */
typedef struct quantiser {
    double low, step;
    bool whole; /* all finite samples are whole numbers */
    double least, greatest;
    uint64_t nan_count, inf_count;
} quantiser;

typedef struct reading {
    const ang_sample_source *source;
    gzFile file;
    uint8_t *buffer;
    size_t count; /* voxels */
    const char *what;
    double from, share; /* of the progress */
    const ang_progress *progress;
} reading;

static void scan(const reading *reading, size_t length, quantiser *q) {
    size_t size = ang_sample_size(reading->source->type);
    for (size_t i = 0; i < length; i++) {
        double v = sample_at(reading->buffer + i * size, reading->source->type, reading->source->big_endian);
        if (isnan(v)) {
            q->nan_count++;
        } else if (isinf(v)) {
            q->inf_count++;
        } else {
            if (v < q->least) q->least = v;
            if (v > q->greatest) q->greatest = v;
            if (v != nearbyint(v)) q->whole = false;
        }
    }
}

static void store(const reading *reading, size_t length, const quantiser *q, uint16_t *out) {
    ang_sample type = reading->source->type;
    const uint8_t *p = reading->buffer;
    if (type == ANG_SAMPLE_U8 || type == ANG_SAMPLE_I8) {
        for (size_t i = 0; i < length; i++) out[i] = type == ANG_SAMPLE_U8 ? p[i] : (uint16_t)((int8_t)p[i] + 32768);
        return;
    }
    if (type == ANG_SAMPLE_U16 || type == ANG_SAMPLE_I16) {
        int high = reading->source->big_endian ? 0 : 1, flip = type == ANG_SAMPLE_I16 ? 0x8000 : 0;
        for (size_t i = 0; i < length; i++) out[i] = (uint16_t)((p[2 * i + high] << 8 | p[2 * i + 1 - high]) ^ flip);
        return;
    }
    size_t size = ang_sample_size(type);
    for (size_t i = 0; i < length; i++) {
        double v = sample_at(p + i * size, type, reading->source->big_endian);
        double stored = isnan(v) ? 0 : nearbyint((v - q->low) / q->step);
        out[i] = stored <= 0 ? 0 : stored >= 65535 ? 65535 : (uint16_t)stored;
    }
}

/* The last plane that is complete once `done` samples of the volume are, where it was not before. */
static void show_plane(const ang_sample_source *source, const quantiser *q, const uint16_t *out, size_t before,
                       size_t done) {
    size_t plane = (size_t)source->dims[0] * (size_t)source->dims[1], complete = done / plane;
    if (!source->slices.take || complete == before / plane) return;
    ang_raw_slice slice = {.values = out + (complete - 1) * plane,
                           .width = source->dims[0],
                           .height = source->dims[1],
                           .slope = source->slope * q->step,
                           .intercept = source->slope * q->low + source->intercept,
                           .window_centre = NAN,
                           .window_width = NAN,
                           .pixel_aspect = 1,
                           .index = complete - 1,
                           .count = (size_t)source->dims[2]};
    source->slices.take(source->slices.context, &slice);
}

/* One pass over the file: scans into `scanned`, or stores into `out`. */
static bool pass(const reading *reading, quantiser *scanned, const quantiser *q, uint16_t *out, ang_error *err) {
    const ang_sample_source *source = reading->source;
    size_t size = ang_sample_size(source->type);
    if (gzrewind(reading->file) != 0 || gzseek(reading->file, (z_off_t)source->offset, SEEK_SET) < 0)
        return ang_fail(err, ANG_INPUT, "%s: ends before its voxels begin", source->label);
    for (size_t done = 0; done < reading->count;) {
        size_t length = reading->count - done < samples_per_piece ? reading->count - done : samples_per_piece;
        int got = gzread(reading->file, reading->buffer, (unsigned)(length * size));
        if (got < 0 || (size_t)got < length * size) {
            int code;
            const char *why = gzerror(reading->file, &code);
            if (got < 0 && code != Z_BUF_ERROR)
                return ang_fail(err, ANG_INPUT, "%s: %s", source->label, code == Z_ERRNO ? strerror(errno) : why);
            return ang_fail(err, ANG_INPUT, "%s: holds too few voxels, %zu; its dimensions need %zu", source->label,
                            done + (size_t)(got > 0 ? got : 0) / size, reading->count);
        }
        if (scanned)
            scan(reading, length, scanned);
        else
            store(reading, length, q, out + done);
        if (out) show_plane(source, q, out, done, done + length);
        done += length;
        double share = reading->from + reading->share * (double)done / (double)reading->count;
        if (!ang_progress_update(reading->progress, reading->what, share))
            return ang_fail(err, ANG_INTERRUPTED, "interrupted while reading voxels");
    }
    return true;
}

static bool check_size(const ang_sample_source *source, size_t count, gzFile file, ang_error *err) {
    struct stat status;
    size_t bytes = ang_product3(count, ang_sample_size(source->type), 1);
    if (count == 0 || bytes == 0)
        return ang_fail(err, ANG_INPUT, "%s: %d x %d x %d voxels cannot be", source->label, source->dims[0],
                        source->dims[1], source->dims[2]);
    if (stat(source->path, &status) != 0) return ang_fail(err, ANG_INPUT, "%s: %s", source->label, strerror(errno));
    /* deflate packs at most 1032 to 1, so the size bounds a compressed file too */
    double most = (double)status.st_size * (gzdirect(file) ? 1 : 1032);
    if ((double)bytes + (double)source->offset > most)
        return ang_fail(err, ANG_INPUT, "%s: %d x %d x %d voxels of %zu bytes do not fit a file of %lld bytes",
                        source->label, source->dims[0], source->dims[1], source->dims[2], ang_sample_size(source->type),
                        (long long)status.st_size);
    return true;
}

/* Reads the voxels; the volume's map is the source's, with slope > 0. */
static bool fill(reading *reading, ang_volume *volume, ang_load_report *report, ang_error *err) {
    const ang_sample_source *source = reading->source;
    bool keep = ang_sample_size(source->type) <= 2;
    quantiser q = {.low = 0, .step = 1, .whole = true, .least = INFINITY, .greatest = -INFINITY};
    report->bits_stored = keep ? 8 * (int)ang_sample_size(source->type) : 16;
    report->signed_stored = source->type == ANG_SAMPLE_I8 || source->type == ANG_SAMPLE_I16;
    if (report->signed_stored) q.low = -32768;
    if (!keep) {
        reading->share = 0.5;
        if (!pass(reading, &q, NULL, NULL, err)) return false;
        reading->from = 0.5;
        if (q.least > q.greatest) q.least = q.greatest = 0; /* nothing finite */
        q.low = q.least;
        double range = q.greatest - q.least;
        if (!isfinite(range))
            return ang_fail(err, ANG_INPUT, "%s: its values span more than a double holds", source->label);
        q.step = q.whole && range <= 65535 ? 1 : range / 65535;
        if (!(q.step > 0)) q.step = 1; /* one value, or a range of denormal numbers */
        if (q.step != 1 || !q.whole) report->quantisation_hu = q.step * fabs(source->slope);
    }
    if (!pass(reading, NULL, &q, volume->data, err)) return false;
    report->nan_count = q.nan_count;
    report->inf_count = q.inf_count;
    volume->slope = source->slope * q.step;
    volume->intercept = source->slope * q.low + source->intercept;

    report->slope = volume->slope;
    report->intercept = volume->intercept + (report->signed_stored ? 32768 * volume->slope : 0);

    size_t words = reading->count;
    report->stored_crc32 = ang_checksum(0, volume->data, words * sizeof *volume->data);
    if (volume->slope < 0) {
        for (size_t i = 0; i < words; i++) volume->data[i] = (uint16_t)(65535 - volume->data[i]);
        volume->intercept += 65535 * volume->slope;
        volume->slope = -volume->slope;
        ang_notes_add(&report->assumptions,
                      "the slope is negative: stored values were turned over, the result is the same");
    }
    if (report->quantisation_hu > 0)
        ang_notes_add(&report->assumptions, "values were quantised to 16 bits, in steps of %.4g",
                      report->quantisation_hu);
    if (q.nan_count)
        ang_notes_add(&report->warnings, "%llu voxels are not a number: the least value is taken",
                      (unsigned long long)q.nan_count);
    if (q.inf_count)
        ang_notes_add(&report->warnings, "%llu voxels are infinite: the greatest or least finite value is taken",
                      (unsigned long long)q.inf_count);
    return true;
}

static bool finish(ang_volume *volume, int threads, ang_load_report *report, ang_error *err) {
    uint16_t padding;
    if (ang_volume_find_padding(volume, &padding)) {
        report->padding_found = true;
        report->padding_hu = report->padding_found_hu = ang_volume_hu(volume, padding);
        if (!ang_volume_mark_padding(volume, padding, err)) return false;
        ang_notes_add(&report->assumptions, "%g fills the corners: taken for padding (%.1f %%) and shown as %g",
                      report->padding_hu, 100.0 * (double)volume->padding_count / (double)ang_volume_count(volume),
                      ang_volume_hu(volume, ang_volume_padding_value(volume)));
    }
    ang_volume_update_range(volume, threads);
    return true;
}

ang_volume *ang_samples_read(const ang_sample_source *source, int threads, ang_load_report *report,
                             const ang_progress *progress, ang_error *err) {
    reading reading = {.source = source, .what = "reading voxels", .share = 1, .progress = progress};
    if (source->dims[0] > 0 && source->dims[1] > 0 && source->dims[2] > 0)
        reading.count = ang_product3((size_t)source->dims[0], (size_t)source->dims[1], (size_t)source->dims[2]);
    reading.file = gzopen(source->path, "rb");
    if (!reading.file) {
        ang_fail(err, ANG_INPUT, "%s: %s", source->label, strerror(errno));
        return NULL;
    }
    gzbuffer(reading.file, 1 << 17);
    ang_volume *volume = NULL;
    bool ok = check_size(source, reading.count, reading.file, err);
    if (ok) reading.buffer = ang_alloc(samples_per_piece, ang_sample_size(source->type), "voxels", err);
    if (ok && reading.buffer) volume = ang_volume_create(source->dims, err);
    ok = volume && fill(&reading, volume, report, err);
    if (ok && source->exact_length && gzread(reading.file, reading.buffer, 1) == 1)
        ang_notes_add_file(&report->warnings, source->label, "is longer than its voxels; the rest is not used");
    gzclose(reading.file);
    free(reading.buffer);
    if (!ok || !finish(volume, threads, report, err)) {
        ang_volume_free(volume);
        return NULL;
    }
    report->slices_read = volume->dims[2];
    return volume;
}

bool ang_samples_list(const ang_volume *volume, const char *modality, const char *description, ang_load_report *report,
                      ang_error *err) {
    report->series = ang_alloc(1, sizeof *report->series, "list of series", err);
    if (!report->series) return false;
    report->series_count = 1;
    ang_series_info *info = report->series;
    *info = (ang_series_info){.number = 1,
                              .description = strdup(description),
                              .uid = strdup(""),
                              .remark = strdup(""),
                              .width = volume->dims[0],
                              .height = volume->dims[1],
                              .slices = volume->dims[2],
                              .phases = 1,
                              .loadable = true};
    if (!info->description || !info->uid || !info->remark)
        return ang_fail(err, ANG_LIMIT, "no memory for the list of series");
    snprintf(info->modality, sizeof info->modality, "%s", modality);
    for (int axis = 0; axis < 2; axis++) info->spacing_mm[axis] = ang_volume_spacing(volume, axis);
    info->spacing_mm[2] = ang_volume_slice_distance(volume);
    report->slice_gap_median_mm = report->slice_gap_min_mm = report->slice_gap_max_mm =
        volume->dims[2] > 1 ? info->spacing_mm[2] : 0;
    return true;
}
