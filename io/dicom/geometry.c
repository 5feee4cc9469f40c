#include "io/dicom/geometry.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { most_planes = 65535 };

void ang_dicom_grid_clear(ang_dicom_grid *grid) {
    free(grid->below);
    free(grid->weight);
    free(grid->gaps);
    *grid = (ang_dicom_grid){0};
}

ang_vec3 ang_dicom_normal(const ang_dicom_slice *slice) {
    ang_vec3 normal = ang_vec3_cross(ang_vec3_unit(slice->row), ang_vec3_unit(slice->column));
    return ang_vec3_length(normal) > 0.5 ? ang_vec3_unit(normal) : (ang_vec3){0, 0, 0};
}

double ang_dicom_along(const ang_dicom_slice *slice, ang_vec3 normal) { return ang_vec3_dot(normal, slice->position); }

typedef struct sorting {
    const ang_dicom_slice *slices;
    ang_vec3 normal;
    bool positions;
} sorting;

static int compare_slices(const void *left, const void *right, void *context) {
    const sorting *sorting = context;
    size_t i = *(const size_t *)left, j = *(const size_t *)right;
    const ang_dicom_slice *a = &sorting->slices[i], *b = &sorting->slices[j];
    if (sorting->positions) {
        double s = ang_dicom_along(a, sorting->normal), t = ang_dicom_along(b, sorting->normal);
        if (s != t) return s < t ? -1 : 1;
    }
    if (a->instance_number != b->instance_number) return a->instance_number < b->instance_number ? -1 : 1;
    return i < j ? -1 : i > j;
}

ang_dicom_slice ang_dicom_with_defaults(const ang_dicom_slice *slice) {
    ang_dicom_slice out = *slice;
    if (!out.has_orientation) {
        out.row = (ang_vec3){1, 0, 0};
        out.column = (ang_vec3){0, 1, 0};
    }
    if (!out.has_spacing) out.row_spacing = out.column_spacing = 1;
    return out;
}

static bool all_have_positions(const ang_dicom_slice *slices, const size_t *order, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (!slices[order[i]].has_position) return false;
    }
    return true;
}

void ang_dicom_sort(const ang_dicom_slice *slices, size_t *order, size_t count, ang_notes *assumptions) {
    if (count == 0) return;
    ang_dicom_slice first = ang_dicom_with_defaults(&slices[order[0]]);
    sorting sorting = {slices, ang_dicom_normal(&first), all_have_positions(slices, order, count)};
    if (!sorting.positions && assumptions && count > 1)
        ang_notes_add(assumptions,
                      "ImagePositionPatient is missing or invalid: slices are in the order of InstanceNumber");
    qsort_r(order, count, sizeof *order, compare_slices, &sorting);
}

static int compare_doubles(const void *left, const void *right) {
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

/* Gaps against their median (rule 5): fills `gaps`, `missing` and says whether any is irregular. */
static bool judge_gaps(ang_dicom_grid *grid, const double *gap, size_t count, double *scratch, bool *irregular,
                       ang_error *err) {
    memcpy(scratch, gap, count * sizeof *gap);
    qsort(scratch, count, sizeof *scratch, compare_doubles);
    double median = count % 2 ? scratch[count / 2] : (scratch[count / 2 - 1] + scratch[count / 2]) / 2;
    grid->median = median;
    grid->least = scratch[0];
    grid->greatest = scratch[count - 1];
    grid->gaps = ang_alloc(count, sizeof *grid->gaps, "list of gaps", err);
    if (!grid->gaps) return false;
    *irregular = false;
    for (size_t i = 0; i < count; i++) {
        if (fabs(gap[i] - median) <= fmax(0.01, 0.01 * median)) continue;
        double k = nearbyint(gap[i] / median);
        bool multiple = k >= 2 && k <= most_planes && fabs(gap[i] - k * median) <= 0.05 * k * median;
        int missing = multiple ? (int)k - 1 : 0;
        grid->gaps[grid->gap_count++] = (ang_gap){(int)i, gap[i], missing};
        grid->missing += missing;
        if (!multiple) *irregular = true;
        if (grid->missing > most_planes)
            return ang_fail(err, ANG_LIMIT, "more than %d slices are missing: this is not one series", most_planes);
    }
    return true;
}

static bool allocate_planes(ang_dicom_grid *grid, ang_error *err) {
    if (grid->planes > most_planes)
        return ang_fail(err, ANG_LIMIT,
                        "%zu planes would be needed for slices at such distances: this is not one series",
                        grid->planes);
    grid->below = ang_alloc(grid->planes, sizeof *grid->below, "list of planes", err);
    grid->weight = grid->below ? ang_alloc(grid->planes, sizeof *grid->weight, "list of planes", err) : NULL;
    return grid->weight != NULL;
}

/* Planes where slices are, and between them where some are missing. */
static bool fill_missing(ang_dicom_grid *grid, size_t count, ang_error *err) {
    grid->planes = count + (size_t)grid->missing;
    if (!allocate_planes(grid, err)) return false;
    size_t plane = 0, next_gap = 0;
    for (size_t i = 0; i < count; i++) {
        grid->below[plane++] = i;
        if (next_gap >= grid->gap_count || (size_t)grid->gaps[next_gap].after != i) continue;
        int missing = grid->gaps[next_gap++].missing;
        for (int m = 1; m <= missing; m++) {
            grid->below[plane] = i;
            grid->weight[plane++] = (float)m / (float)(missing + 1);
        }
    }
    grid->interpolates = grid->missing > 0;
    return true;
}

/* Planes from the first slice on at the distance of the smallest sensible gap (rule 5), over slices at positions `s`
 * (rising). Less than one such gap may be left over behind the last plane. */
static bool resample(ang_dicom_grid *grid, const double *s, size_t count, double *step, ang_error *err) {
    double least = grid->median, length = s[count - 1] - s[0];
    for (size_t i = 1; i < count; i++) {
        double gap = s[i] - s[i - 1];
        if (gap >= grid->median / 4 && gap < least) least = gap;
    }
    double intervals = floor(length / least + 1e-3);
    grid->planes = intervals < most_planes ? (size_t)intervals + 1 : most_planes + 1;
    *step = least;
    grid->resampled = grid->interpolates = true;
    if (!allocate_planes(grid, err)) return false;
    size_t below = 0;
    for (size_t p = 0; p < grid->planes; p++) {
        double t = s[0] + (double)p * *step;
        while (below + 2 < count && s[below + 1] <= t) below++;
        double weight = count > 1 ? (t - s[below]) / (s[below + 1] - s[below]) : 0;
        weight = fmin(fmax(weight, 0), 1);
        if (weight > 1 - 1e-9) {
            grid->below[p] = below + 1;
            continue;
        }
        grid->below[p] = below;
        grid->weight[p] = weight < 1e-9 ? 0 : (float)weight;
    }
    return true;
}

static void set_affine(ang_dicom_grid *grid, const ang_dicom_slice *first, ang_vec3 z) {
    ang_vec3 x = ang_vec3_scale(ang_vec3_unit(first->row), first->column_spacing);
    ang_vec3 y = ang_vec3_scale(ang_vec3_unit(first->column), first->row_spacing), o = first->position;
    grid->affine = (ang_mat4){{{x.x, y.x, z.x, o.x}, {x.y, y.y, z.y, o.y}, {x.z, y.z, z.z, o.z}, {0, 0, 0, 1}}};
}

/* Distance to the next slice where positions do not say it. A single slice is as thick as it is. */
static double nominal_distance(const ang_dicom_slice *slice, size_t count, ang_notes *assumptions) {
    double distance = 0;
    const char *source = NULL;
    if (slice->has_slice_distance && slice->slice_distance > 0) {
        distance = slice->slice_distance;
        source = "SpacingBetweenSlices";
    }
    if (slice->has_thickness && slice->thickness > 0 && (!source || count == 1)) {
        distance = slice->thickness;
        source = "SliceThickness";
    }
    if (!source)
        ang_notes_add(assumptions, "no positions to measure: slice distance taken as 1 mm");
    else if (count == 1)
        ang_notes_add(assumptions, "a single slice: its depth is taken from %s, %g mm", source, distance);
    else
        ang_notes_add(assumptions, "no positions to measure: slice distance taken from %s, %g mm", source, distance);
    return source ? distance : 1;
}

static void note_header(const ang_dicom_slice *slice, ang_notes *warnings) {
    if (!slice->has_orientation)
        ang_notes_add(warnings, "(0020,0037) ImageOrientationPatient is %s: axial slices are assumed",
                      slice->bad_orientation ? "invalid" : "missing");
    if (!slice->has_spacing)
        ang_notes_add(warnings, "(0028,0030) PixelSpacing is %s: 1 mm is assumed, do not measure",
                      slice->bad_spacing ? "invalid" : "missing");
    if (slice->has_orientation && fabs(ang_vec3_dot(ang_vec3_unit(slice->row), ang_vec3_unit(slice->column))) > 1e-3)
        ang_notes_add(warnings, "(0020,0037) ImageOrientationPatient: row and column are not at right angles");
}

/* How far the slices lie off the line from the first to the last: one matrix holds a shear, nothing more. */
static void check_line(const ang_dicom_slice *slices, const size_t *order, size_t count, const double *s,
                       const ang_dicom_slice *first, ang_notes *warnings) {
    ang_vec3 start = slices[order[0]].position, v = ang_vec3_sub(slices[order[count - 1]].position, start);
    double worst = 0;
    for (size_t i = 1; i + 1 < count; i++) {
        ang_vec3 on = ang_vec3_along(start, v, (s[i] - s[0]) / (s[count - 1] - s[0]));
        worst = fmax(worst, ang_vec3_length(ang_vec3_sub(slices[order[i]].position, on)));
    }
    if (worst > 0.5 * fmin(first->row_spacing, first->column_spacing))
        ang_notes_add(warnings, "slices lie up to %.2f mm beside the line from the first to the last", worst);
}

static bool stack_slices(const ang_dicom_slice *slices, const size_t *order, size_t count, const ang_dicom_slice *first,
                         double *s, ang_dicom_grid *grid, ang_notes *assumptions, ang_notes *warnings, ang_error *err) {
    ang_vec3 normal = ang_dicom_normal(first);
    double *gap = s + count, *scratch = s + 2 * count;
    for (size_t i = 0; i < count; i++) s[i] = ang_dicom_along(&slices[order[i]], normal);
    for (size_t i = 0; i + 1 < count; i++) {
        gap[i] = s[i + 1] - s[i];
        if (!(gap[i] > 0))
            return ang_fail(err, ANG_GEOMETRY,
                            "(0020,0032) ImagePositionPatient: two slices, InstanceNumber %d and %d, lie at one "
                            "position, %.3f mm along the normal: take one of them out of the folder",
                            slices[order[i]].instance_number, slices[order[i + 1]].instance_number, s[i]);
    }
    bool irregular;
    if (!judge_gaps(grid, gap, count - 1, scratch, &irregular, err)) return false;
    ang_vec3 v = ang_vec3_sub(slices[order[count - 1]].position, slices[order[0]].position);
    double forward = ang_vec3_dot(normal, v);
    grid->tilt_deg =
        atan2(ang_vec3_length(ang_vec3_along(v, normal, -forward)), forward) * 180 / 3.14159265358979323846;
    if (grid->tilt_deg < 1e-4) grid->tilt_deg = 0;
    check_line(slices, order, count, s, first, warnings);

    double step = 0, length = s[count - 1] - s[0];
    if (irregular) {
        if (!resample(grid, s, count, &step, err)) return false;
        ang_notes_add(warnings,
                      "slice distances are irregular, %.2f to %.2f mm: resampled linearly to %zu planes %.4g mm apart",
                      grid->least, grid->greatest, grid->planes, step);
        double rest = length - step * (double)(grid->planes - 1);
        if (rest > 0.01) ang_notes_add(assumptions, "resampling leaves the last %.2f mm of the series out", rest);
    } else {
        if (!fill_missing(grid, count, err)) return false;
        step = length / (double)(grid->planes - 1);
        if (grid->missing > 0)
            ang_notes_add(warnings, "%d missing slice%s: interpolated from the neighbours", grid->missing,
                          ang_plural(grid->missing));
    }
    set_affine(grid, first, ang_vec3_scale(v, step / length));
    return true;
}

/* Without positions InstanceNumber alone may order slices (rule 2): each must have its own. */
static bool check_instances(const ang_dicom_slice *slices, const size_t *order, size_t count, ang_error *err) {
    for (size_t i = 0; i < count; i++) {
        const ang_dicom_slice *slice = &slices[order[i]];
        if (!slice->has_instance_number)
            return ang_fail(err, ANG_GEOMETRY,
                            "(0020,0032) ImagePositionPatient and (0020,0013) InstanceNumber are missing: nothing says "
                            "how the slices follow one another");
        if (i > 0 && slice->instance_number == slices[order[i - 1]].instance_number)
            return ang_fail(err, ANG_GEOMETRY,
                            "(0020,0032) ImagePositionPatient is missing and (0020,0013) InstanceNumber %d is there "
                            "twice: nothing says how the slices follow one another",
                            slice->instance_number);
    }
    return true;
}

bool ang_dicom_geometry(const ang_dicom_slice *slices, const size_t *order, size_t count, ang_dicom_grid *grid,
                        ang_notes *assumptions, ang_notes *warnings, ang_error *err) {
    *grid = (ang_dicom_grid){0};
    if (count == 0) return ang_fail(err, ANG_GEOMETRY, "the series has no slices");
    ang_dicom_slice first = ang_dicom_with_defaults(&slices[order[0]]);
    note_header(&slices[order[0]], warnings);
    ang_vec3 normal = ang_dicom_normal(&first);
    if (ang_vec3_length(normal) == 0)
        return ang_fail(err, ANG_GEOMETRY, "(0020,0037) ImageOrientationPatient: row and column have no plane");
    bool ok = true;
    if (count > 1 && all_have_positions(slices, order, count)) {
        double *s = ang_alloc(count, 3 * sizeof *s, "positions", err);
        ok = s && stack_slices(slices, order, count, &first, s, grid, assumptions, warnings, err);
        free(s);
    } else {
        if (!first.has_position) first.position = (ang_vec3){0, 0, 0};
        ok = (count == 1 || check_instances(slices, order, count, err)) && fill_missing(grid, count, err);
        double distance = nominal_distance(&first, count, assumptions);
        set_affine(grid, &first, ang_vec3_scale(normal, distance));
        if (!first.has_position)
            ang_notes_add(warnings, "(0020,0032) ImagePositionPatient is %s: where the volume lies is unknown",
                          first.bad_position ? "invalid" : "missing");
    }
    if (!ok) ang_dicom_grid_clear(grid);
    return ok;
}
