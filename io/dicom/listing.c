#include "io/dicom/listing.h"

#include "core/base/memory.h"
#include "io/checksum.h"
#include "io/dicom/decode.h"
#include "io/dicom/geometry.h"
#include "io/dicom/stored.h"
#include "io/dicom/terms.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a first look at a slice's pixels found: in a series of many volumes each slice is compared with many. */
typedef struct digest {
    bool known, readable;
    uint32_t crc;
} digest;

typedef struct comparison {
    const ang_dicom_folder *folder;
    ang_sandbox *sandbox;
    ang_notes *warnings;
    digest *digests; /* per slice */
    const ang_progress *progress;
} comparison;

/* Decodes a slice; one that cannot be decoded costs a warning. False where memory is out. */
static bool read_pixels(comparison *comparison, size_t index, uint16_t *pixels, ang_error *err) {
    const ang_dicom_folder *folder = comparison->folder;
    const ang_dicom_slice *slice = &folder->slices[index];
    const char *label = folder->labels[slice->file];
    digest *digest = &comparison->digests[index];
    ang_error why = {0};
    digest->readable =
        ang_dicom_decode(folder->paths[slice->file], label, slice, comparison->sandbox, pixels, NULL, &why);
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
    if (!ang_progress_update(comparison->progress, "reading headers", 1)) {
        ang_fail(err, ANG_INTERRUPTED, "interrupted while comparing slices");
        return ANG_DICOM_NOT_COMPARED;
    }
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

double ang_dicom_slice_distance(const ang_dicom_slice *slices, const ang_dicom_group *group) {
    const ang_dicom_slice *last = &slices[group->order[group->count - 1]];
    ang_dicom_slice first = ang_dicom_with_defaults(&slices[group->order[0]]);
    if (group->count > 1 && first.has_position) {
        ang_vec3 normal = ang_dicom_normal(&first);
        return (ang_dicom_along(last, normal) - ang_dicom_along(&first, normal)) / (double)(group->count - 1);
    }
    return first.has_thickness && first.thickness > 0 ? first.thickness : 1;
}

/* "2024-05-17" of "20240517..."; empty where there is no date. */
static void date_of(const ang_dicom_slice *slice, char date[11]) {
    const char *from = slice->acquisition_time[0] ? slice->acquisition_time : slice->content_time;
    if (strspn(from, "0123456789") >= 8) snprintf(date, 11, "%.4s-%.2s-%.2s", from, from + 4, from + 6);
}

/* What the phases of a series are; a phase of another number of slices says so. */
static bool describe_phases(const ang_dicom_group *first, ang_series_info *info, ang_error *err) {
    info->phases = first->set > 0 ? first->phases : 1;
    if (info->phases == 1) return true;
    info->phase_text = ang_alloc((size_t)info->phases, sizeof *info->phase_text, "list of phases", err);
    for (int p = 0; info->phase_text && p < info->phases; p++) {
        char text[128];
        if (first[p].count == first->count)
            snprintf(text, sizeof text, "%s", first[p].phase_text);
        else
            snprintf(text, sizeof text, "%s, %zu slice%s", first[p].phase_text, first[p].count,
                     ang_plural((long long)first[p].count));
        info->phase_text[p] = strdup(text);
        if (!info->phase_text[p]) return ang_fail(err, ANG_LIMIT, "no memory for the list of phases");
    }
    return info->phase_text != NULL;
}

static bool describe(const ang_dicom_slice *slices, const ang_dicom_group *group, ang_series_info *info,
                     ang_error *err) {
    const ang_dicom_slice *first = &slices[group->order[0]];
    *info = (ang_series_info){.number = group->series,
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
    date_of(first, info->date);
    snprintf(info->modality, sizeof info->modality, "%s",
             first->modality[0] ? ang_dicom_modality(first->modality) : "?");
    info->spacing_mm[0] = first->has_spacing ? first->column_spacing : 1;
    info->spacing_mm[1] = first->has_spacing ? first->row_spacing : 1;
    info->spacing_mm[2] = ang_dicom_slice_distance(slices, group);
    return describe_phases(group, info, err);
}

static bool describe_all(const ang_dicom_folder *folder, const ang_dicom_groups *groups, ang_load_report *report,
                         ang_error *err) {
    report->series = ang_alloc((size_t)groups->series_count, sizeof *report->series, "list of series", err);
    if (!report->series) return false;
    report->series_count = (size_t)groups->series_count;
    for (int i = 0; i < groups->series_count; i++) {
        const ang_dicom_group *group = &groups->group[ang_dicom_series_start(groups, i + 1)];
        if (!describe(folder->slices, group, &report->series[i], err)) return false;
    }
    return true;
}

/* Why there is nothing to list. */
static bool fail_empty(const ang_dicom_folder *folder, const char *path, ang_error *err) {
    if (folder->broken == 1) return ang_fail(err, ANG_INPUT, "%s", folder->first_error);
    if (folder->broken > 1)
        return ang_fail(err, ANG_INPUT, "none of %zu DICOM files can be read; the first: %s", folder->broken,
                        folder->first_error);
    if (folder->count == 1) return ang_fail(err, ANG_INPUT, "%s: holds no DICOM image", path);
    return ang_fail(err, ANG_INPUT, "%s: no DICOM image among its %zu files", path, folder->count);
}

bool ang_dicom_list(const char *const *paths, size_t count, const ang_load_options *options, ang_load_report *report,
                    const ang_progress *progress, ang_dicom_listing *listing, ang_error *err) {
    *listing = (ang_dicom_listing){0};
    snprintf(report->format, sizeof report->format, "DICOM");
    ang_dicom_folder *folder = &listing->folder;
    if (!ang_dicom_read_folder(paths, count, options->threads, folder, &report->warnings, progress, err)) return false;
    if (!options->no_sandbox) listing->sandbox = ang_sandbox_create(ANG_GDCM_MODULE, err);
    bool ok = options->no_sandbox || listing->sandbox;
    ok = ok && (folder->slice_count > 0 || fail_empty(folder, paths[0], err));
    if (ok && folder->indexed > 0)
        ang_notes_add(&report->assumptions, "the DICOMDIR names %zu file%s: others beside it are passed over",
                      folder->indexed, ang_plural((long long)folder->indexed));
    if (ok && folder->foreign > 0)
        ang_notes_add(&report->assumptions, "passed over what is no DICOM image: %zu of %zu files", folder->foreign,
                      folder->count);
    comparison comparison = {folder, listing->sandbox, &report->warnings, NULL, progress};
    if (ok) comparison.digests = ang_alloc(folder->slice_count, sizeof *comparison.digests, "list of slices", err);
    ok = ok && comparison.digests &&
         ang_dicom_group_slices(folder->slices, folder->slice_count, compare_pixels, &comparison, &listing->groups,
                                err) &&
         describe_all(folder, &listing->groups, report, err);
    free(comparison.digests);
    if (!ok) ang_dicom_listing_clear(listing);
    return ok;
}

void ang_dicom_listing_clear(ang_dicom_listing *listing) {
    ang_dicom_groups_clear(&listing->groups);
    ang_dicom_folder_clear(&listing->folder);
    ang_sandbox_free(listing->sandbox);
    listing->sandbox = NULL;
}
