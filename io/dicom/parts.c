#include "io/dicom/parts.h"

#include "io/dicom/geometry.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { fewest_slices = 3 }; /* of a part that is known to be regular */

bool ang_dicom_key_text(const ang_dicom_slice *slice, ang_dicom_key key, char *out, size_t size) {
    switch (key) {
    case ANG_DICOM_BY_IMAGE_TYPE:
        snprintf(out, size, "%s", slice->image_type);
        break;
    case ANG_DICOM_BY_TEMPORAL_POSITION:
        snprintf(out, size, "%d", slice->temporal_position);
        return slice->has_temporal_position;
    case ANG_DICOM_BY_TRIGGER_TIME:
        snprintf(out, size, "%.10g", slice->trigger_time);
        return slice->has_trigger_time;
    case ANG_DICOM_BY_CARDIAC_PHASE:
        snprintf(out, size, "%.10g", slice->cardiac_phase);
        return slice->has_cardiac_phase;
    case ANG_DICOM_BY_DIMENSIONS:
        snprintf(out, size, "%s", slice->dimensions);
        break;
    case ANG_DICOM_BY_ACQUISITION_NUMBER:
        snprintf(out, size, "%d", slice->acquisition_number);
        return slice->has_acquisition_number;
    case ANG_DICOM_BY_OBJECT:
        if (slice->object[0])
            snprintf(out, size, "%s", slice->object);
        else
            snprintf(out, size, "file %zu", slice->file);
        return slice->frame > 0;
    case ANG_DICOM_BY_ACQUISITION_TIME:
        snprintf(out, size, "%s", slice->acquisition_time);
        break;
    default:
        snprintf(out, size, "%s", slice->content_time);
        break;
    }
    return out[0] != 0;
}

int ang_dicom_parts_by_key(const ang_dicom_slice *slices, const size_t *order, size_t count, ang_dicom_key key,
                           int *part) {
    char known[ang_dicom_most_parts][129];
    int parts = 0;
    for (size_t i = 0; i < count; i++) {
        char text[129];
        if (!ang_dicom_key_text(&slices[order[i]], key, text, sizeof text)) return 0;
        int k = 0;
        while (k < parts && strcmp(known[k], text) != 0) k++;
        if (k == parts) {
            if (parts == ang_dicom_most_parts) return 0;
            memcpy(known[parts++], text, sizeof text);
        }
        part[i] = k;
    }
    return parts;
}

/* Slices of one value of a key, or of several that continue one another. */
typedef struct stack {
    size_t count;
    double start, end; /* mm along the normal */
    double spacing;    /* least distance of its slices */
    bool regular;      /* all distances are multiples of it, as rule 5 has them */
} stack;

/* How many slices of a stack of this spacing are missing in a gap; -1 where it is no multiple (rule 5). */
static double missing_in(double gap, double spacing) {
    if (fabs(gap - spacing) <= fmax(0.01, 0.01 * spacing)) return 0;
    double k = nearbyint(gap / spacing);
    return k >= 2 && fabs(gap - k * spacing) <= 0.05 * k * spacing ? k - 1 : -1;
}

/* The stack of the slices that have number `wanted`; of all where `part` is NULL. */
static stack measure(const ang_dicom_slice *slices, const size_t *order, size_t count, ang_vec3 normal, const int *part,
                     int wanted) {
    stack found = {.spacing = INFINITY, .regular = true};
    for (int pass = 0; pass < 2; pass++) { /* the least distance, then all against it */
        found.count = 0;
        for (size_t i = 0; i < count; i++) {
            if (part && part[i] != wanted) continue;
            double at = ang_dicom_along(&slices[order[i]], normal);
            if (found.count++ == 0)
                found.start = at;
            else if (pass == 0)
                found.spacing = fmin(found.spacing, at - found.end);
            else if (missing_in(at - found.end, found.spacing) < 0)
                found.regular = false;
            found.end = at;
        }
    }
    return found;
}

/* Whether `next` goes on where `before` ends, as slabs of one scan do; a few slices may be missing between them. */
static bool continues(const stack *before, const stack *next) {
    if (missing_in(next->spacing, before->spacing) != 0) return false;
    double missing = missing_in(next->start - before->end, before->spacing);
    return missing >= 0 && missing < fmin((double)before->count, (double)next->count);
}

/* Numbers the values of a key by the volumes that they make together, in `volume`. Returns how many; 0 where the key
 * does not stand for stacks of slices: many scanners give every slice a number or a time of its own. */
static int join_stacks(const ang_dicom_slice *slices, const size_t *order, size_t count, ang_vec3 normal,
                       const int *part, int parts, int volume[ang_dicom_most_parts]) {
    stack joined[ang_dicom_most_parts];
    int volumes = 0;
    /* Values appear in order of position, so that a stack can only continue an earlier one. */
    for (int p = 0; p < parts; p++) {
        stack s = measure(slices, order, count, normal, part, p);
        if (s.count < fewest_slices || !s.regular) return 0;
        int v = 0;
        while (v < volumes && !continues(&joined[v], &s)) v++;
        volume[p] = v;
        if (v == volumes) {
            joined[volumes++] = s;
        } else {
            joined[v].end = s.end;
            joined[v].count += s.count;
        }
    }
    return volumes;
}

/* Whether this key may split slices that lie at equal distances when taken together. Times may not: interleaved MR
 * scans take odd and even slices one after the other, and reconstructions are written as they get ready. */
static bool splits_regular(const ang_dicom_slice *slice, ang_dicom_key key) {
    return strcmp(slice->modality, "CT") == 0 &&
           (key == ANG_DICOM_BY_ACQUISITION_NUMBER || key == ANG_DICOM_BY_TEMPORAL_POSITION);
}

static int compare_doubles(const void *left, const void *right) {
    double a = *(const double *)left, b = *(const double *)right;
    return a < b ? -1 : a > b;
}

/* Splits where more slices are missing than there are: what lies between would be invention. */
static int split_far(const ang_dicom_slice *slices, const size_t *order, size_t count, ang_vec3 normal, int *part,
                     double *scratch) {
    for (size_t i = 1; i < count; i++)
        scratch[i - 1] = ang_dicom_along(&slices[order[i]], normal) - ang_dicom_along(&slices[order[i - 1]], normal);
    qsort(scratch, count - 1, sizeof *scratch, compare_doubles);
    double spacing = scratch[(count - 1) / 2];
    int parts = 1;
    part[0] = 0;
    for (size_t i = 1; i < count; i++) {
        double gap = ang_dicom_along(&slices[order[i]], normal) - ang_dicom_along(&slices[order[i - 1]], normal);
        if (gap / spacing - 1 > (double)count) parts++;
        part[i] = parts - 1;
    }
    return parts;
}

ang_dicom_parting ang_dicom_part_volumes(const ang_dicom_slice *slices, const size_t *order, size_t count,
                                         ang_vec3 normal, int *part, int *parts, double *scratch) {
    *parts = 1;
    if (count < fewest_slices) return ANG_DICOM_ONE_VOLUME;
    stack all = measure(slices, order, count, normal, NULL, 0);
    bool even = all.regular && (all.end - all.start) / all.spacing < (double)count - 0.5;
    for (ang_dicom_key key = ANG_DICOM_BY_TEMPORAL_POSITION; key < ANG_DICOM_KEYS; key++) {
        if (even && !splits_regular(&slices[order[0]], key)) continue;
        int volume[ang_dicom_most_parts], values = ang_dicom_parts_by_key(slices, order, count, key, part);
        if (values < 2) continue;
        *parts = join_stacks(slices, order, count, normal, part, values, volume);
        if (*parts < 2) continue;
        for (size_t i = 0; i < count; i++) part[i] = volume[part[i]];
        return ANG_DICOM_ACQUISITIONS;
    }
    *parts = split_far(slices, order, count, normal, part, scratch);
    return *parts > 1 ? ANG_DICOM_FAR_STACKS : ANG_DICOM_ONE_VOLUME;
}
