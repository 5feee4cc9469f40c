#include "io/dicom/dicom.h"

#include "core/base/memory.h"
#include "io/checksum.h"
#include "io/dicom/assemble.h"
#include "io/dicom/decode.h"
#include "io/dicom/folder.h"
#include "io/dicom/parse.h"
#include "io/dicom/series.h"
#include "io/dicom/stored.h"
#include "io/dicom/terms.h"
#include "io/formats.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool ang_dicom_probe(const char *path) {
    ang_dicom_reader *reader = malloc(sizeof *reader);
    if (!reader) return false;
    ang_error ignored;
    bool found = ang_dicom_open(reader, path, "", &ignored) == ANG_DICOM_FOUND;
    ang_dicom_close(reader);
    free(reader);
    return found;
}

/* What a first look at a slice's pixels found: in a series of many volumes each slice is compared with many. */
typedef struct digest {
    bool known, readable;
    uint32_t crc;
} digest;

typedef struct comparison {
    const ang_dicom_folder *folder;
    ang_notes *warnings;
    digest *digests; /* per slice */
} comparison;

/* Decodes a slice; one that cannot be decoded costs a warning. False where memory is out. */
static bool read_pixels(comparison *comparison, size_t index, uint16_t *pixels, ang_error *err) {
    const ang_dicom_folder *folder = comparison->folder;
    const ang_dicom_slice *slice = &folder->slices[index];
    const char *label = folder->labels[slice->file];
    digest *digest = &comparison->digests[index];
    ang_error why = {0};
    digest->readable = ang_dicom_decode(folder->paths[slice->file], label, slice, pixels, &why);
    if (!digest->readable && why.code == ANG_LIMIT) return ang_fail(err, ANG_LIMIT, "%s", why.message);
    if (!digest->readable) ang_dicom_warn_file(comparison->warnings, label, why.message);
    size_t bytes = (size_t)slice->rows * (size_t)slice->columns * sizeof *pixels;
    if (digest->readable) digest->crc = ang_checksum(0, pixels, bytes);
    digest->known = true;
    return true;
}

/* Two files at one position: do they hold the same picture (rule 6)? */
static ang_dicom_likeness compare_pixels(void *context, size_t a, size_t b, ang_error *err) {
    comparison *comparison = context;
    const ang_dicom_slice *left = &comparison->folder->slices[a], *right = &comparison->folder->slices[b];
    const digest *one = &comparison->digests[a], *two = &comparison->digests[b];
    size_t count = (size_t)left->rows * (size_t)left->columns;
    if (left->rows != right->rows || left->columns != right->columns) return ANG_DICOM_DIFFERENT;
    uint16_t *pixels = ang_alloc(count, 2 * sizeof *pixels, "two slices", err);
    bool ok = pixels != NULL;
    if (ok && !one->known) ok = read_pixels(comparison, a, pixels, err);
    if (ok && !two->known) ok = read_pixels(comparison, b, pixels + count, err);
    ang_dicom_map from = ang_dicom_map_of(left), to = ang_dicom_map_of(right);
    bool same = ok && one->readable && two->readable && one->crc == two->crc && from.slope == to.slope &&
                from.intercept == to.intercept;
    if (same) /* probably: now every pixel */
        ok = read_pixels(comparison, a, pixels, err) && read_pixels(comparison, b, pixels + count, err);
    same = same && ok && memcmp(pixels, pixels + count, count * sizeof *pixels) == 0;
    free(pixels);
    if (!ok) return ANG_DICOM_NOT_COMPARED;
    if (!one->readable) return ANG_DICOM_FIRST_UNREADABLE;
    if (!two->readable) return ANG_DICOM_SECOND_UNREADABLE;
    return same ? ANG_DICOM_SAME : ANG_DICOM_DIFFERENT;
}

/* Distance of the slices of a sorted group along their normal (rule 4); their thickness where positions do not say. */
static double slice_distance(const ang_dicom_slice *slices, const ang_dicom_group *group) {
    const ang_dicom_slice *last = &slices[group->order[group->count - 1]];
    ang_dicom_slice first = ang_dicom_with_defaults(&slices[group->order[0]]);
    if (group->count > 1 && first.has_position) {
        ang_vec3 normal = ang_dicom_normal(&first);
        return (ang_dicom_along(last, normal) - ang_dicom_along(&first, normal)) / (double)(group->count - 1);
    }
    return first.has_thickness && first.thickness > 0 ? first.thickness : 1;
}

static bool describe(const ang_dicom_slice *slices, const ang_dicom_group *group, int number, ang_series_info *info,
                     ang_error *err) {
    const ang_dicom_slice *first = &slices[group->order[0]];
    *info = (ang_series_info){.number = number,
                              .description = strdup(first->description),
                              .patient = strdup(first->patient),
                              .uid = strdup(first->series_uid),
                              .remark = strdup(group->remark),
                              .width = first->columns,
                              .height = first->rows,
                              .slices = (int)group->count,
                              .loadable = group->loadable};
    if (!info->description || !info->patient || !info->uid || !info->remark)
        return ang_fail(err, ANG_LIMIT, "no memory for the list of series");
    snprintf(info->modality, sizeof info->modality, "%s",
             first->modality[0] ? ang_dicom_modality(first->modality) : "?");
    info->spacing_mm[0] = first->has_spacing ? first->column_spacing : 1;
    info->spacing_mm[1] = first->has_spacing ? first->row_spacing : 1;
    info->spacing_mm[2] = slice_distance(slices, group);
    return true;
}

static bool list_series(const ang_dicom_folder *folder, const ang_dicom_groups *groups, ang_load_report *report,
                        ang_error *err) {
    report->series = ang_alloc(groups->count, sizeof *report->series, "list of series", err);
    if (!report->series) return false;
    report->series_count = groups->count;
    for (size_t i = 0; i < groups->count; i++)
        if (!describe(folder->slices, &groups->group[i], (int)i + 1, &report->series[i], err)) return false;
    return true;
}

/* A map that cannot be read makes the values wrong, wherever it is. */
static void note_bad_rescale(const ang_dicom_slice *slices, const ang_dicom_group *group, ang_notes *warnings) {
    int slopes = 0, intercepts = 0;
    for (size_t i = 0; i < group->count; i++) {
        slopes += slices[group->order[i]].bad_slope;
        intercepts += slices[group->order[i]].bad_intercept;
    }
    if (slopes)
        ang_notes_add(warnings, "(0028,1053) RescaleSlope is invalid in %d slice%s: 1 is taken", slopes,
                      ang_plural(slopes));
    if (intercepts)
        ang_notes_add(warnings, "(0028,1052) RescaleIntercept is invalid in %d slice%s: 0 is taken", intercepts,
                      ang_plural(intercepts));
}

/* Everything that the header says and that the values do not follow, or that it leaves open. */
static void note_values(const ang_dicom_slice *first, ang_load_report *report) {
    ang_notes *assumptions = &report->assumptions, *warnings = &report->warnings;
    if (strcmp(first->modality, "CT") != 0)
        ang_notes_add(warnings, "modality is %s, not CT: values are not Hounsfield units",
                      first->modality[0] ? ang_dicom_modality(first->modality) : "not given");
    if (first->bad_slope || first->bad_intercept) {
        /* note_bad_rescale has said it */
    } else if (!first->has_slope && !first->has_intercept)
        ang_notes_add(assumptions, "RescaleSlope and RescaleIntercept are missing: 1 and 0 are taken");
    else if (!first->has_slope || first->slope == 0)
        ang_notes_add(assumptions, "RescaleSlope is missing or 0: 1 is taken");
    else if (!first->has_intercept)
        ang_notes_add(assumptions, "RescaleIntercept is missing: 0 is taken");
    if (ang_dicom_map_of(first).slope < 0)
        ang_notes_add(assumptions, "RescaleSlope is negative: stored values were turned over, the result is the same");
    if (strcmp(first->photometric, "MONOCHROME1") == 0)
        ang_notes_add(assumptions, "MONOCHROME1 is a matter of display: values are as stored");
    if (first->lossy) ang_notes_add(warnings, "the pictures were compressed with loss: values are approximate");
    uint16_t low, high;
    if (first->has_padding && !ang_dicom_padding(first, &low, &high))
        ang_notes_add(assumptions, "the declared padding value %u does not fit %d stored bits: ignored", first->padding,
                      first->bits_stored);
}

static void note_result(const ang_volume *volume, const ang_dicom_slice *first, ang_load_report *report) {
    ang_notes *assumptions = &report->assumptions;
    double share = 100.0 * (double)volume->padding_count / (double)ang_volume_count(volume);
    const char *unit = ang_load_report_hounsfield(report) ? " HU" : "";
    uint16_t low, high;
    if (report->padding_found && !report->padding_declared && ang_dicom_padding(first, &low, &high))
        ang_notes_add(assumptions, "the declared padding value occurs nowhere");
    double shown = ang_volume_hu(volume, ang_volume_padding_value(volume));
    if (report->padding_found && report->padding_declared)
        ang_notes_add(assumptions,
                      "declared padding, %g%s, and %g%s, which fills the corners, together %.1f %% of the voxels, are "
                      "shown as %g%s",
                      report->padding_hu, unit, report->padding_found_hu, unit, share, shown, unit);
    else if (report->padding_found)
        ang_notes_add(assumptions, "%g%s fills the corners: taken for padding (%.1f %%) and shown as %g%s",
                      report->padding_found_hu, unit, share, shown, unit);
    else if (report->padding_declared)
        ang_notes_add(assumptions, "declared padding, %g%s, %.1f %% of the voxels, is shown as %g%s",
                      report->padding_hu, unit, share, shown, unit);
    if (report->padding_declared && fabs(shown + 1000) > fmax(1, volume->slope / 2))
        ang_notes_add(&report->warnings,
                      "16 bits hold no value for -1000%s beside the others: padding is shown as %g%s", unit, shown,
                      unit);
    if (report->padding_declared && report->padding_hu > -900)
        ang_notes_add(&report->warnings, "the declared padding value is %g%s, which may also be tissue",
                      report->padding_hu, unit);
    if (report->rescale_error_hu > 1e-9)
        ang_notes_add(&report->warnings, "rescale differs between slices: one map for all, off by at most %.3g%s",
                      report->rescale_error_hu, unit);
    if (report->tilt_deg > 0.01)
        ang_notes_add(assumptions, "gantry tilt of %.2f degrees is kept as a shear, nothing is resampled for it",
                      report->tilt_deg);
}

static void take_grid(ang_dicom_grid *grid, const ang_dicom_slice *first, ang_load_report *report) {
    report->gaps = grid->gaps;
    report->gap_count = grid->gap_count;
    grid->gaps = NULL;
    grid->gap_count = 0;
    report->slices_missing = grid->missing;
    report->slice_gap_median_mm = grid->median;
    report->slice_gap_min_mm = grid->least;
    report->slice_gap_max_mm = grid->greatest;
    report->resampled = grid->resampled;
    report->tilt_deg = grid->tilt_deg;
    report->tilt_nominal_deg = first->has_tilt ? first->tilt : NAN;
    report->signed_stored = first->is_signed;
    report->bits_stored = first->bits_stored;
    report->window_centre = first->has_window ? first->window_centre : NAN;
    report->window_width = first->has_window ? first->window_width : NAN;
}

/* Takes slices that could not be decoded out of the group, with a warning each; false where none is left. */
static bool leave_out_failed(const ang_dicom_folder *folder, ang_dicom_group *group, const bool *failed, char **reasons,
                             ang_load_report *report, ang_error *err) {
    size_t kept = 0;
    for (size_t i = 0; i < group->count; i++) {
        if (!failed[i]) {
            group->order[kept++] = group->order[i];
            continue;
        }
        const ang_dicom_slice *slice = &folder->slices[group->order[i]];
        const char *reason = reasons[i] ? reasons[i] : "cannot be decoded";
        if (kept == 0 && i + 1 == group->count) ang_fail(err, ANG_INPUT, "%s", reason);
        ang_dicom_warn_file(&report->warnings, folder->labels[slice->file], reason);
    }
    group->count = kept;
    return kept > 0;
}

/* Geometry and voxels; where slices cannot be decoded, again without them, so that they count as missing. */
static ang_volume *build(const ang_dicom_folder *folder, ang_dicom_group *group, int threads, ang_load_report *report,
                         const ang_progress *progress, ang_error *err) {
    ang_volume *volume = NULL;
    ang_dicom_sort(folder->slices, group->order, group->count, &report->assumptions);
    for (bool again = true; again;) {
        again = false;
        size_t count = group->count;
        const ang_dicom_slice *first = &folder->slices[group->order[0]];
        ang_notes assumptions = {0}, warnings = {0};
        ang_dicom_grid grid = {0};
        bool *failed = ang_alloc(count, sizeof *failed, "slices", err);
        char **reasons = failed ? ang_alloc(count, sizeof *reasons, "slices", err) : NULL;
        if (reasons && ang_dicom_geometry(folder->slices, group->order, count, &grid, &assumptions, &warnings, err)) {
            ang_dicom_stack stack = {folder->slices, group->order, count,  folder->paths,
                                     folder->labels, &grid,        threads};
            volume = ang_dicom_assemble(&stack, report, progress, failed, reasons, err);
            if (volume) {
                take_grid(&grid, first, report);
                report->slices_read = (int)count;
                ang_notes_append(&report->assumptions, &assumptions);
                ang_notes_append(&report->warnings, &warnings);
            } else {
                bool any = false;
                for (size_t i = 0; i < count; i++) any = any || failed[i];
                again = any && (!err || err->code == ANG_INPUT) &&
                        leave_out_failed(folder, group, failed, reasons, report, err);
            }
        }
        for (size_t i = 0; reasons && i < count; i++) free(reasons[i]);
        free(reasons);
        free(failed);
        ang_notes_clear(&assumptions);
        ang_notes_clear(&warnings);
        ang_dicom_grid_clear(&grid);
    }
    return volume;
}

static ang_volume *load_folder(const ang_dicom_folder *folder, const char *path, const ang_load_options *options,
                               ang_load_report *report, const ang_progress *progress, ang_error *err) {
    if (folder->slice_count == 0) {
        if (folder->broken == 1)
            ang_fail(err, ANG_INPUT, "%s", folder->first_error);
        else if (folder->broken > 1)
            ang_fail(err, ANG_INPUT, "none of %zu DICOM files can be read; the first: %s", folder->broken,
                     folder->first_error);
        else if (folder->count == 1)
            ang_fail(err, ANG_INPUT, "%s: holds no DICOM image; a DICOMDIR is an index: give its folder",
                     folder->labels[0]);
        else
            ang_fail(err, ANG_INPUT, "%s: no DICOM image among its %zu files", path, folder->count);
        return NULL;
    }
    if (folder->foreign > 0)
        ang_notes_add(&report->assumptions, "passed over what is no DICOM image: %zu of %zu files", folder->foreign,
                      folder->count);
    ang_dicom_groups groups;
    comparison comparison = {folder, &report->warnings, NULL};
    comparison.digests = ang_alloc(folder->slice_count, sizeof *comparison.digests, "list of slices", err);
    bool grouped = comparison.digests && ang_dicom_group_slices(folder->slices, folder->slice_count, compare_pixels,
                                                                &comparison, &groups, err);
    free(comparison.digests);
    if (!grouped) return NULL;
    ang_volume *volume = NULL;
    size_t chosen = 0;
    ang_error why = {0};
    if (!list_series(folder, &groups, report, err)) {
    } else if (!ang_dicom_choose(folder->slices, &groups, options->series, &chosen, &why)) {
        if (options->series)
            ang_fail(err, why.code, "%s", why.message);
        else
            ang_fail(err, why.code, "%s: %s", ang_base_name(path), why.message);
    } else {
        ang_dicom_group *group = &groups.group[chosen];
        const ang_dicom_slice *first = &folder->slices[group->order[0]];
        report->chosen = (int)chosen;
        report->slices_duplicate = group->duplicates;
        if (groups.count > 1 && !options->series)
            ang_notes_add(&report->assumptions,
                          "series %zu of %zu is shown: the largest %s volume; --series picks another", chosen + 1,
                          groups.count, strcmp(first->modality, "CT") == 0 ? "CT" : "image");
        if (group->duplicates > 0)
            ang_notes_add(&report->assumptions, "%d slice%s with the same %s and pixels as another: dropped",
                          group->duplicates, ang_plural(group->duplicates),
                          first->has_position ? "position" : "InstanceNumber");
        if (group->phases > 1)
            ang_notes_add(&report->assumptions, "the series holds %d volumes at the same positions: one is shown",
                          group->phases);
        if (group->acquisitions > 1)
            ang_notes_add(&report->assumptions,
                          "the series holds %d acquisitions that do not continue one another: one is shown",
                          group->acquisitions);
        if (group->stacks > 1)
            ang_notes_add(&report->assumptions, "the series holds %d stacks of slices far apart: one is shown",
                          group->stacks);
        note_bad_rescale(folder->slices, group, &report->warnings);
        note_values(first, report);
        volume = build(folder, group, options->threads, report, progress, err);
        if (volume) {
            note_result(volume, first, report);
            report->series[chosen].slices = report->slices_read;
            report->series[chosen].spacing_mm[2] = slice_distance(folder->slices, group);
        }
    }
    ang_dicom_groups_clear(&groups);
    return volume;
}

ang_volume *ang_dicom_load(const char *path, const ang_load_options *options, ang_load_report *report,
                           const ang_progress *progress, ang_error *err) {
    snprintf(report->format, sizeof report->format, "DICOM");
    ang_dicom_folder folder;
    if (!ang_dicom_read_folder(path, options->threads, &folder, &report->warnings, progress, err)) return NULL;
    ang_volume *volume = load_folder(&folder, path, options, report, progress, err);
    ang_dicom_folder_clear(&folder);
    return volume;
}
