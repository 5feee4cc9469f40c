#include "io/voxels/samples.h"

#include "core/base/memory.h"
#include "io/checksum.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { samples_per_piece = 1 << 16, most_phases = 65536 };

/* How samples become stored values: stored = (sample - low) / step. */
typedef struct quantiser {
    double low, step;
    bool whole; /* all finite samples are whole numbers */
    double least, greatest;
    uint64_t nan_count, inf_count;
} quantiser;

typedef struct reading {
    const ang_sample_source *source;
    ang_byte_stream *stream; /* of the present pass */
    size_t run_left;         /* samples of the phase before those of others follow; see phase_run */
    uint8_t *buffer;
    size_t count; /* voxels */
    const char *what;
    double from, share; /* of the progress */
    const ang_progress *progress;
} reading;

static void scan(const reading *reading, size_t length, quantiser *q) {
    size_t size = ang_sample_size(reading->source->type);
    for (size_t i = 0; i < length; i++) {
        double v = ang_sample_get(reading->buffer + i * size, reading->source->type, reading->source->big_endian);
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
        double v = ang_sample_get(p + i * size, type, reading->source->big_endian);
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

static size_t phases_of(const ang_sample_source *source) { return source->phases > 1 ? (size_t)source->phases : 1; }

/* Opens a stream at the phase's first sample. */
static bool begin(reading *reading, ang_error *err) {
    const ang_sample_source *source = reading->source;
    size_t run = source->phase_run && phases_of(source) > 1 ? source->phase_run : reading->count;
    bool ok;
    ang_byte_stream_close(reading->stream);
    reading->stream = ang_byte_stream_open(&source->parts, err);
    if (!reading->stream) return false;
    reading->run_left = run;
    uint64_t before = (uint64_t)(source->phase > 1 ? source->phase - 1 : 0) * run * ang_sample_size(source->type);
    if (ang_byte_stream_skip(reading->stream, before, &ok, err)) return true;
    return ok ? ang_fail(err, ANG_INPUT, "%s: ends before the voxels of phase %d begin", source->label, source->phase)
              : false;
}

/* The next samples of the phase into the buffer, fewer where the data end. */
static size_t next_samples(reading *reading, size_t length, bool *ok, ang_error *err) {
    const ang_sample_source *source = reading->source;
    size_t size = ang_sample_size(source->type), done = 0;
    *ok = true;
    while (done < length) {
        if (reading->run_left == 0) {
            uint64_t others = (uint64_t)(phases_of(source) - 1) * source->phase_run * size;
            if (!ang_byte_stream_skip(reading->stream, others, ok, err)) break;
            reading->run_left = source->phase_run;
        }
        size_t wanted = length - done < reading->run_left ? length - done : reading->run_left;
        size_t got =
            ang_byte_stream_read(reading->stream, reading->buffer + done * size, wanted * size, ok, err) / size;
        done += got;
        reading->run_left -= got;
        if (got < wanted) break;
    }
    return done;
}

/* One pass over the file: scans into `scanned`, or stores into `out`. */
static bool pass(reading *reading, quantiser *scanned, const quantiser *q, uint16_t *out, ang_error *err) {
    const ang_sample_source *source = reading->source;
    if (!begin(reading, err)) return false;
    for (size_t done = 0; done < reading->count;) {
        size_t length = reading->count - done < samples_per_piece ? reading->count - done : samples_per_piece;
        bool ok;
        size_t got = next_samples(reading, length, &ok, err);
        if (!ok) return false;
        if (got < length)
            return ang_fail(err, ANG_INPUT, "%s: holds too few voxels, %zu; its dimensions need %zu", source->label,
                            done + got, reading->count);
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

/* The length of the parts, and whether the files can hold them. */
static bool check_size(ang_sample_source *source, size_t count, ang_error *err) {
    size_t size = ang_sample_size(source->type), bytes = ang_product3(count, size, phases_of(source));
    if (source->phases > most_phases)
        return ang_fail(err, ANG_INPUT, "%s: %d phases: at most %d are read", source->label, source->phases,
                        (int)most_phases);
    if (bytes == 0)
        return ang_fail(err, ANG_INPUT, "%s: %d x %d x %d voxels cannot be", source->label, source->dims[0],
                        source->dims[1], source->dims[2]);
    if (bytes / size % source->parts.count != 0)
        return ang_fail(err, ANG_INPUT, "%s: %d x %d x %d voxels cannot be shared out among %zu files", source->label,
                        source->dims[0], source->dims[1], source->dims[2], source->parts.count);
    source->parts.part_bytes = bytes / source->parts.count;
    source->parts.type = source->type;
    source->parts.width = source->dims[0];
    source->parts.height = source->dims[1];
    char what[192], phases[32] = "", field[48] = "";
    if (phases_of(source) > 1) snprintf(phases, sizeof phases, "%d phases of ", source->phases);
    if (source->field) snprintf(field, sizeof field, " (%s)", source->field);
    snprintf(what, sizeof what, "%s%d x %d x %d voxels of %zu byte%s%s", phases, source->dims[0], source->dims[1],
             source->dims[2], size, ang_plural((long long)size), field);
    return ang_byte_parts_check(&source->parts, source->label, what, err);
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

ang_volume *ang_samples_read(ang_sample_source *source, int threads, ang_load_report *report,
                             const ang_progress *progress, ang_error *err) {
    reading reading = {.source = source, .what = "reading voxels", .share = 1, .progress = progress};
    if (source->dims[0] > 0 && source->dims[1] > 0 && source->dims[2] > 0)
        reading.count = ang_product3((size_t)source->dims[0], (size_t)source->dims[1], (size_t)source->dims[2]);
    if (!check_size(source, reading.count, err)) return NULL;
    ang_volume *volume = NULL;
    reading.buffer = ang_alloc(samples_per_piece, ang_sample_size(source->type), "voxels", err);
    if (reading.buffer) volume = ang_volume_create(source->dims, err);
    bool ok = volume && fill(&reading, volume, report, err);
    if (ok && ang_byte_stream_more(reading.stream))
        ang_notes_add_file(&report->warnings, source->label, "is longer than its voxels; the rest is not used");
    ang_byte_stream_close(reading.stream);
    free(reading.buffer);
    if (!ok || !finish(volume, threads, report, err)) {
        ang_volume_free(volume);
        return NULL;
    }
    report->slices_read = volume->dims[2];
    return volume;
}

bool ang_samples_list(const ang_volume *volume, int phases, const char *modality, const char *description,
                      ang_load_report *report, ang_error *err) {
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
                              .phases = phases > 1 ? phases : 1,
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

bool ang_samples_name_phases(ang_series_info *info, double first, double step, const char *unit, ang_error *err) {
    if (info->phases < 2 || info->phases > most_phases || !isfinite(first) || !isfinite(step)) return true;
    info->phase_text = ang_alloc((size_t)info->phases, sizeof *info->phase_text, "list of phases", err);
    if (!info->phase_text) return false;
    for (int i = 0; i < info->phases; i++) {
        if (asprintf(&info->phase_text[i], "time %.6g%s%s", first + i * step, unit[0] ? " " : "", unit) < 0) {
            info->phase_text[i] = NULL;
            return ang_fail(err, ANG_LIMIT, "no memory for the list of phases");
        }
    }
    return true;
}
