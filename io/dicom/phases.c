#include "io/dicom/phases.h"

#include "io/dicom/terms.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool ang_dicom_phases_differ(const ang_dicom_slice *a, const ang_dicom_slice *b) {
    static const ang_dicom_key telling[] = {ANG_DICOM_BY_TEMPORAL_POSITION,  ANG_DICOM_BY_TRIGGER_TIME,
                                            ANG_DICOM_BY_CARDIAC_PHASE,      ANG_DICOM_BY_DIMENSIONS,
                                            ANG_DICOM_BY_ACQUISITION_NUMBER, ANG_DICOM_BY_ACQUISITION_TIME};
    for (size_t i = 0; i < sizeof telling / sizeof *telling; i++) {
        char left[129], right[129];
        if (ang_dicom_key_text(a, telling[i], left, sizeof left) &&
            ang_dicom_key_text(b, telling[i], right, sizeof right) && strcmp(left, right) != 0)
            return true;
    }
    return false;
}

/* Numbers the slices by a key that has exactly `phases` values and none twice at a place; false where it is no such
 * key. */
static bool number_by_key(const ang_dicom_slice *slices, const size_t *order, const size_t *place, size_t count,
                          int phases, ang_dicom_key key, int *phase) {
    if (ang_dicom_parts_by_key(slices, order, count, key, phase) != phases) return false;
    for (size_t i = 0; i < count; i++) {
        for (size_t j = i; j-- > 0 && place[j] == place[i];) {
            if (phase[j] == phase[i]) return false;
        }
    }
    return true;
}

static int compare_numbers(double a, double b) { return a < b ? -1 : a > b; }

/* Index values one by one: 2 comes before 10. */
static int compare_dimensions(const char *a, const char *b) {
    for (;;) {
        char *after_a, *after_b;
        long left = strtol(a, &after_a, 10), right = strtol(b, &after_b, 10);
        if (left != right) return left < right ? -1 : 1;
        if (!*after_a || !*after_b) return (*after_a != 0) - (*after_b != 0);
        a = after_a + 1;
        b = after_b + 1;
    }
}

static int compare_by_key(const ang_dicom_slice *a, const ang_dicom_slice *b, ang_dicom_key key) {
    char left[129], right[129];
    switch (key) {
    case ANG_DICOM_BY_TEMPORAL_POSITION:
        return compare_numbers(a->temporal_position, b->temporal_position);
    case ANG_DICOM_BY_TRIGGER_TIME:
        return compare_numbers(a->trigger_time, b->trigger_time);
    case ANG_DICOM_BY_CARDIAC_PHASE:
        return compare_numbers(a->cardiac_phase, b->cardiac_phase);
    case ANG_DICOM_BY_DIMENSIONS:
        return compare_dimensions(a->dimensions, b->dimensions);
    case ANG_DICOM_BY_ACQUISITION_NUMBER:
        return compare_numbers(a->acquisition_number, b->acquisition_number);
    case ANG_DICOM_BY_OBJECT:
        if (a->object_number != b->object_number) return compare_numbers(a->object_number, b->object_number);
        return a->file < b->file ? -1 : a->file > b->file;
    default:
        ang_dicom_key_text(a, key, left, sizeof left);
        ang_dicom_key_text(b, key, right, sizeof right);
        return strcmp(left, right);
    }
}

/* Renumbers phases, which have the order of their appearance, by their values. */
static void order_by_key(const ang_dicom_slice *slices, const size_t *order, size_t count, int phases,
                         ang_dicom_key key, int *phase) {
    size_t sample[ang_dicom_most_parts];
    int rank[ang_dicom_most_parts] = {0};
    for (size_t i = 0; i < count; i++) sample[phase[i]] = order[i];
    for (int p = 0; p < phases; p++) {
        for (int q = 0; q < phases; q++) {
            int way = p == q ? 0 : compare_by_key(&slices[sample[q]], &slices[sample[p]], key);
            rank[p] += way < 0 || (way == 0 && q < p);
        }
    }
    for (size_t i = 0; i < count; i++) phase[i] = rank[phase[i]];
}

ang_dicom_key ang_dicom_number_phases(const ang_dicom_slice *slices, const size_t *order, const size_t *place,
                                      size_t count, int phases, int *phase) {
    for (ang_dicom_key key = 0; key < ANG_DICOM_KEYS; key++) {
        if (!number_by_key(slices, order, place, count, phases, key, phase)) continue;
        order_by_key(slices, order, count, phases, key, phase);
        return key;
    }
    for (size_t i = 0; i < count; i++) phase[i] = i > 0 && place[i] == place[i - 1] ? phase[i - 1] + 1 : 0;
    return ANG_DICOM_KEYS;
}

/* Seconds of the day of a time "HHMMSS.FFFFFF", alone or after its date; NaN where it says less. */
static double seconds_of(const char *text) {
    const char *time = strchr(text, ' ');
    time = time ? time + 1 : text;
    if (strspn(time, "0123456789") != 6) return NAN;
    int digit[6];
    for (int i = 0; i < 6; i++) digit[i] = time[i] - '0';
    double second = 10 * digit[4] + digit[5], scale = 0.1;
    if (time[6] == '.') {
        for (const char *p = time + 7; *p >= '0' && *p <= '9'; p++, scale /= 10) second += scale * (*p - '0');
    }
    return 3600 * (10 * digit[0] + digit[1]) + 60 * (10 * digit[2] + digit[3]) + second;
}

static bool same_day(const char *a, const char *b) {
    const char *space = strchr(a, ' ');
    if (!space) return !strchr(b, ' ');
    return strncmp(a, b, (size_t)(space - a) + 1) == 0;
}

/* Times of day stay here: they may identify a patient; how much later one is than another does not. */
static void time_words(const char *verb, const char *time, const char *first, char *out, size_t size) {
    double later = same_day(first, time) ? seconds_of(time) - seconds_of(first) : NAN;
    if (later == 0)
        snprintf(out, size, "%s first", verb);
    else if (isfinite(later))
        snprintf(out, size, "%s %.10g s after the first", verb, nearbyint(later * 1e3) / 1e3);
    else
        snprintf(out, size, "%s later", verb);
}

void ang_dicom_phase_words(ang_dicom_key key, const ang_dicom_slice *slice, const ang_dicom_slice *first, int number,
                           char *out, size_t size) {
    char value[65];
    switch (key) {
    case ANG_DICOM_BY_IMAGE_TYPE:
        ang_dicom_value(slice->image_type, 2, value, sizeof value);
        snprintf(out, size, "ImageType %s", ang_dicom_image_kind(value));
        break;
    case ANG_DICOM_BY_TEMPORAL_POSITION:
        snprintf(out, size, "temporal position %d", slice->temporal_position);
        break;
    case ANG_DICOM_BY_TRIGGER_TIME:
        snprintf(out, size, "trigger time %.10g ms", slice->trigger_time);
        break;
    case ANG_DICOM_BY_CARDIAC_PHASE:
        snprintf(out, size, "%.10g %% of the cardiac cycle", slice->cardiac_phase);
        break;
    case ANG_DICOM_BY_DIMENSIONS:
        snprintf(out, size, "dimension index %s", slice->dimensions);
        break;
    case ANG_DICOM_BY_ACQUISITION_NUMBER:
        snprintf(out, size, "acquisition %d", slice->acquisition_number);
        break;
    case ANG_DICOM_BY_OBJECT:
        snprintf(out, size, "multi-frame object %d", slice->object_number);
        break;
    case ANG_DICOM_BY_ACQUISITION_TIME:
        time_words("acquired", slice->acquisition_time, first->acquisition_time, out, size);
        break;
    case ANG_DICOM_BY_CONTENT_TIME:
        time_words("written", slice->content_time, first->content_time, out, size);
        break;
    default:
        snprintf(out, size, "number %d at each position by InstanceNumber", number);
        break;
    }
}
