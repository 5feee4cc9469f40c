#include "io/dicom/choose.h"

#include <stdlib.h>
#include <string.h>

static bool ends_with(const char *text, const char *end) {
    size_t a = strlen(text), b = strlen(end);
    return b > 0 && a >= b && strcmp(text + a - b, end) == 0;
}

static double worth(const ang_dicom_slice *slices, const ang_dicom_group *group) {
    const ang_dicom_slice *first = &slices[group->order[0]];
    double voxels = (double)first->rows * first->columns * (double)group->count;
    if (group->count == 1) voxels *= 1e-6; /* a volume, if there is one */
    return voxels * (strcmp(first->modality, "CT") == 0 ? 1e24 : 1) * (group->derived ? 1e-12 : 1);
}

static bool is_lossy(const ang_dicom_slice *slices, const ang_dicom_group *group) {
    for (size_t i = 0; i < group->count; i++)
        if (slices[group->order[i]].lossy) return true;
    return false;
}

/* Whether `a` is rather to be shown than `b`, which comes first in the list. */
static bool is_better(const ang_dicom_slice *slices, const ang_dicom_group *a, const ang_dicom_group *b) {
    double left = worth(slices, a), right = worth(slices, b);
    return left > right || (left == right && is_lossy(slices, b) && !is_lossy(slices, a));
}

static bool choose_named(const ang_dicom_slice *slices, const ang_dicom_groups *groups, const char *series,
                         size_t *chosen, ang_error *err) {
    char *rest;
    long number = strtol(series, &rest, 10);
    size_t found = groups->count;
    if (*series && !*rest && number >= 1 && number <= groups->series_count) {
        found = ang_dicom_series_start(groups, (int)number);
    } else {
        for (size_t i = 0; i < groups->count; i++) {
            const ang_dicom_group *group = &groups->group[i];
            if (!ends_with(slices[group->order[0]].series_uid, series)) continue;
            if (found == groups->count || (group->loadable && (!groups->group[found].loadable ||
                                                               is_better(slices, group, &groups->group[found]))))
                found = i;
        }
    }
    if (found == groups->count)
        return ang_fail(err, ANG_INPUT, "--series %s: there are series 1 to %d, and no UID ends so", series,
                        groups->series_count);
    found = ang_dicom_series_start(groups, groups->group[found].series);
    if (!groups->group[found].loadable)
        return ang_fail(err, ANG_INPUT, "--series %s: cannot be loaded: %s", series, groups->group[found].remark);
    *chosen = found;
    return true;
}

bool ang_dicom_choose(const ang_dicom_slice *slices, const ang_dicom_groups *groups, const char *series, size_t *chosen,
                      ang_error *err) {
    if (series) return choose_named(slices, groups, series, chosen, err);
    size_t best = groups->count;
    for (size_t i = 0; i < groups->count; i++) {
        if (!groups->group[i].loadable) continue;
        if (best == groups->count || is_better(slices, &groups->group[i], &groups->group[best])) best = i;
    }
    if (best == groups->count) {
        if (groups->series_count == 1)
            return ang_fail(err, ANG_INPUT, "no 3D image series: %s", groups->group[0].remark);
        return ang_fail(err, ANG_INPUT, "no 3D image series among the %d found: the first is: %s", groups->series_count,
                        groups->count ? groups->group[0].remark : "");
    }
    *chosen = ang_dicom_series_start(groups, groups->group[best].series);
    return true;
}
