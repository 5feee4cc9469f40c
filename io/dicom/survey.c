#include "core/base/memory.h"
#include "io/dicom/decode.h"
#include "io/dicom/dicom.h"
#include "io/dicom/geometry.h"
#include "io/dicom/listing.h"
#include "io/dicom/remarks.h"
#include "io/dicom/stored.h"

#include <stdlib.h>

/* The middle slice of a group in `values` (to be freed), which is NULL where it cannot be read. */
static ang_raw_slice read_middle(const ang_dicom_listing *listing, const ang_dicom_group *group, uint16_t **values) {
    const ang_dicom_folder *folder = &listing->folder;
    const ang_dicom_slice *slice = &folder->slices[group->order[group->count / 2]];
    size_t pixels = slice->rows > 0 && slice->columns > 0 ? (size_t)slice->rows * (size_t)slice->columns : 0;
    bool readable = slice->image && !slice->refusal[0] && pixels > 0;
    *values = readable ? ang_alloc(pixels, sizeof **values, "a slice", NULL) : NULL;
    const char *path = folder->paths[slice->file], *label = folder->labels[slice->file];
    ang_error unread = {0};
    if (*values && !ang_dicom_decode(path, label, slice, listing->sandbox, *values, NULL, &unread)) {
        free(*values);
        *values = NULL;
    }
    return ang_dicom_raw_slice(slice, *values);
}

static void look_at(const ang_dicom_listing *listing, size_t index, const ang_survey_sink *sink) {
    const ang_dicom_slice *slices = listing->folder.slices;
    ang_dicom_group *group = &listing->groups.group[ang_dicom_series_start(&listing->groups, (int)index + 1)];
    ang_notes assumptions = {0}, warnings = {0};
    ang_error err = {0};
    const char *refusal = group->loadable ? NULL : group->remark;
    if (group->loadable) {
        ang_dicom_grid grid = {0};
        ang_dicom_sort(slices, group->order, group->count, &assumptions);
        ang_dicom_note_values(slices, group, &assumptions, &warnings);
        if (!ang_dicom_geometry(slices, group->order, group->count, &grid, &assumptions, &warnings, &err))
            refusal = err.message;
        ang_dicom_grid_clear(&grid);
    }
    uint16_t *values;
    ang_raw_slice middle = read_middle(listing, group, &values);
    sink->looked_at(sink->context, index, values ? &middle : NULL, &warnings, refusal);
    free(values);
    ang_notes_clear(&assumptions);
    ang_notes_clear(&warnings);
}

bool ang_dicom_survey(const char *const *paths, size_t count, const ang_load_options *options, ang_load_report *report,
                      const ang_survey_sink *sink, const ang_progress *progress, ang_error *err) {
    ang_dicom_listing listing;
    if (!ang_dicom_list(paths, count, options, report, progress, &listing, err)) return false;
    sink->listed(sink->context, report);
    bool going = true;
    size_t series = (size_t)listing.groups.series_count;
    for (size_t i = 0; i < series && going; i++) {
        look_at(&listing, i, sink);
        going = ang_progress_update(progress, "looking at series", (double)(i + 1) / (double)series);
    }
    ang_dicom_listing_clear(&listing);
    return going || ang_fail(err, ANG_INTERRUPTED, "interrupted while looking at series");
}
