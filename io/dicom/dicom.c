#include "io/dicom/dicom.h"

#include "core/base/memory.h"
#include "io/dicom/assemble.h"
#include "io/dicom/choose.h"
#include "io/dicom/identity.h"
#include "io/dicom/listing.h"
#include "io/dicom/parse.h"
#include "io/dicom/remarks.h"
#include "io/dicom/stored.h"
#include "io/formats.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool ang_dicom_probe(const char *path) {
    if (strcasecmp(ang_base_name(path), "DICOMDIR") == 0) return true;
    ang_dicom_reader *reader = malloc(sizeof *reader);
    if (!reader) return false;
    ang_error ignored;
    bool found = ang_dicom_open_meta(reader, path, "", &ignored) == ANG_DICOM_FOUND;
    ang_dicom_close(reader);
    free(reader);
    return found;
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
static ang_volume *build(const ang_dicom_listing *listing, ang_dicom_group *group, const ang_load_options *options,
                         ang_load_report *report, const ang_progress *progress, ang_error *err) {
    const ang_dicom_folder *folder = &listing->folder;
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
            ang_dicom_stack stack = {folder->slices, group->order,     count,           folder->paths,   folder->labels,
                                     &grid,          options->threads, options->slices, listing->sandbox};
            volume = ang_dicom_assemble(&stack, report, progress, failed, reasons, err);
            if (volume) {
                take_grid(&grid, first, report);
                report->slices_read = (int)count;
                report->identity = ang_identity_read(folder->paths[first->file]);
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

/* A folder of two patients: the largest volume may be the wrong one's. */
static void note_patients(const ang_dicom_listing *listing, const ang_dicom_slice *shown, bool asked_for,
                          ang_load_report *report) {
    size_t others = 0, count = listing->folder.slice_count;
    for (size_t i = 0; i < count; i++) others += !ang_dicom_same_patient(shown, &listing->folder.slices[i]);
    if (others > 0)
        ang_notes_add(asked_for ? &report->assumptions : &report->warnings,
                      "%zu of %zu images are another patient's than the series that is shown", others, count);
}

/* A series of mixed planes: what is shown is not all of it. */
static void note_other_planes(const ang_dicom_listing *listing, const ang_dicom_slice *shown, ang_load_report *report) {
    size_t others = 0;
    for (size_t i = 0; i < listing->folder.slice_count; i++) {
        const ang_dicom_slice *slice = &listing->folder.slices[i];
        others += slice->image && strcmp(slice->series_uid, shown->series_uid) == 0 &&
                  ang_dicom_same_patient(shown, slice) && !ang_dicom_same_planes(shown, slice);
    }
    if (others > 0)
        ang_notes_add(&report->assumptions,
                      "%zu image%s of this series differ%s in size, orientation or spacing: listed apart", others,
                      ang_plural((long long)others), others == 1 ? "s" : "");
}

/* What was left out of the group that is shown, and what of it is only assumed. */
static void note_choice(const ang_dicom_listing *listing, size_t chosen, const ang_load_options *options,
                        ang_load_report *report) {
    const ang_dicom_groups *groups = &listing->groups;
    const ang_dicom_group *group = &groups->group[chosen];
    const ang_dicom_slice *first = &listing->folder.slices[group->order[0]];
    if (groups->series_count > 1 && !options->series)
        ang_notes_add(&report->assumptions, "series %d of %d is shown: the largest %s volume; %s picks another",
                      group->series, groups->series_count, strcmp(first->modality, "CT") == 0 ? "CT" : "image",
                      options->series_choice ? options->series_choice : "--series");
    note_patients(listing, first, options->series != NULL, report);
    note_other_planes(listing, first, report);
    if (group->duplicates > 0)
        ang_notes_add(&report->assumptions, "%d slice%s with the same %s and pixels as another: dropped",
                      group->duplicates, ang_plural(group->duplicates),
                      first->has_position ? "position" : "InstanceNumber");
    if (group->set > 0)
        ang_notes_add(&report->assumptions, "phase %d of %d is shown, %s; %s picks another", group->phase,
                      group->phases, group->phase_text, options->phase_choice ? options->phase_choice : "--phase");
    else if (group->phases > 1)
        ang_notes_add(&report->assumptions, "the series holds %d volumes at the same positions: one is shown",
                      group->phases);
    if (group->acquisitions > 1)
        ang_notes_add(&report->assumptions,
                      "the series holds %d acquisitions that do not continue one another: one is shown",
                      group->acquisitions);
    if (group->stacks > 1)
        ang_notes_add(&report->assumptions, "the series holds %d stacks of slices far apart: one is shown",
                      group->stacks);
}

static ang_volume *load_chosen(ang_dicom_listing *listing, size_t chosen, const ang_load_options *options,
                               ang_load_report *report, const ang_progress *progress, ang_error *err) {
    const ang_dicom_slice *slices = listing->folder.slices;
    ang_dicom_group *group = &listing->groups.group[chosen];
    const ang_dicom_slice *first = &slices[group->order[0]];
    report->slices_duplicate = group->duplicates;
    note_choice(listing, chosen, options, report);
    ang_dicom_note_values(slices, group, &report->assumptions, &report->warnings);
    ang_volume *volume = build(listing, group, options, report, progress, err);
    const char *remark = listing->sandbox ? ang_sandbox_remark(listing->sandbox) : NULL;
    if (remark) ang_notes_add(&report->assumptions, "%s", remark);
    if (!volume) return NULL;
    note_result(volume, first, report);
    ang_series_info *info = &report->series[report->chosen];
    info->slices = report->slices_read;
    info->spacing_mm[2] = ang_dicom_slice_distance(slices, group);
    return volume;
}

/* The group to load: series and phase as asked for. */
static bool choose(const ang_dicom_listing *listing, const ang_load_options *options, ang_load_report *report,
                   size_t *chosen, ang_error *err) {
    const ang_dicom_groups *groups = &listing->groups;
    bool found = ang_dicom_choose(listing->folder.slices, groups, options->series, chosen, err);
    if (!found && options->series_remembered)
        found = ang_dicom_choose(listing->folder.slices, groups, NULL, chosen, err);
    if (!found) return false;
    report->chosen = groups->group[*chosen].series - 1;
    const ang_series_info *info = &report->series[report->chosen];
    char what[32];
    snprintf(what, sizeof what, "series %d", info->number);
    if (!ang_load_phase(what, info->phases, options, &report->phase, err)) return false;
    *chosen += (size_t)report->phase - 1;
    return groups->group[*chosen].loadable || ang_fail(err, ANG_INPUT, "phase %d of series %d cannot be loaded: %s",
                                                       report->phase, info->number, groups->group[*chosen].remark);
}

ang_volume *ang_dicom_load(const char *const *paths, size_t count, const ang_load_options *options,
                           ang_load_report *report, const ang_progress *progress, ang_error *err) {
    ang_dicom_listing listing;
    if (!ang_dicom_list(paths, count, options, report, progress, &listing, err)) return NULL;
    ang_volume *volume = NULL;
    size_t chosen = 0;
    ang_error why = {0};
    bool found = choose(&listing, options, report, &chosen, &why);
    if (found) volume = load_chosen(&listing, chosen, options, report, progress, &why);
    /* Where slices lie is the matter of no file of them alone. */
    bool unnamed = found ? why.code == ANG_GEOMETRY || why.code == ANG_LIMIT : !options->series && !options->phase;
    if (!volume)
        ang_fail(err, why.code, "%s%s%s", unnamed ? ang_base_name(paths[0]) : "", unnamed ? ": " : "", why.message);
    ang_dicom_listing_clear(&listing);
    return volume;
}
