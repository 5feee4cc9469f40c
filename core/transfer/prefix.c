#include "core/transfer/prefix.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Beyond any interval, and a float. */
static const float NO_PLATEAU = 2147483648.0f;

bool ang_plateaus_has(const ang_transfer_tables *tables, int interval) {
    return tables->entries[8 * (size_t)interval + 3] == ANG_TABLE_OPAQUE &&
           tables->entries[8 * (size_t)interval + 7] == ANG_TABLE_OPAQUE;
}

static void fill_sums(ang_prefix *prefix, const ang_transfer_tables *tables, const ang_transfer *transfer, double slope,
                      double intercept) {
    double sum[4] = {0}, to_intervals = tables->per_value / slope;
    for (int i = 0; i <= tables->intervals; i++) {
        float *out = &prefix->sums[8 * (size_t)i];
        for (int c = 0; c < 4; c++) {
            out[c] = (float)sum[c];
            out[4 + c] = (float)(sum[c] - out[c]);
        }
        if (i == tables->intervals || ang_plateaus_has(tables, i)) continue;
        double left = tables->first + i / tables->per_value, right = tables->first + (i + 1) / tables->per_value;
        ang_transfer_integral piece =
            ang_transfer_integrate_between(transfer, slope * left + intercept, slope * right + intercept);
        for (int c = 0; c < 3; c++) sum[c] += piece.colour[c] * to_intervals;
        sum[3] += piece.extinction * to_intervals;
        prefix->greatest = fmax(prefix->greatest, piece.extinction * to_intervals);
    }
}

bool ang_plateaus_find(const ang_transfer_tables *tables, float **plateaus, ang_error *err) {
    int count = tables->intervals, found = 0;
    for (int i = 0; i < count; i++) found += ang_plateaus_has(tables, i);
    *plateaus = NULL;
    if (found == 0) return true;
    float *out = *plateaus = ang_alloc(2 * ((size_t)count + 2), sizeof *out, "plateaus of the transfer function", err);
    if (!out) return false;
    /* Outside the table the values at its ends hold. */
    float above = ang_plateaus_has(tables, count - 1) ? (float)count : NO_PLATEAU;
    for (int i = count; i >= -1; i--) {
        if (i < count && ang_plateaus_has(tables, i < 0 ? 0 : i)) above = (float)i;
        out[2 * ((size_t)i + 1)] = above;
    }
    float below = ang_plateaus_has(tables, 0) ? -1.0f : -NO_PLATEAU;
    for (int i = -1; i <= count; i++) {
        if (i >= 0 && ang_plateaus_has(tables, i < count ? i : count - 1)) below = (float)i;
        out[2 * ((size_t)i + 1) + 1] = below;
    }
    return true;
}

ang_prefix *ang_prefix_create(const ang_transfer_tables *tables, const ang_transfer *transfer, double slope,
                              double intercept, ang_error *err) {
    static const char what[] = "prefix integrals of the transfer function";
    ang_prefix *prefix = ang_alloc(1, sizeof *prefix, what, err);
    if (!prefix) return NULL;
    prefix->intervals = tables->intervals;
    prefix->sums = ang_alloc(8 * ((size_t)tables->intervals + 1), sizeof *prefix->sums, what, err);
    if (!prefix->sums || !ang_plateaus_find(tables, &prefix->plateaus, err)) {
        ang_prefix_free(prefix);
        return NULL;
    }
    fill_sums(prefix, tables, transfer, slope, intercept);
    return prefix;
}

void ang_prefix_free(ang_prefix *prefix) {
    if (!prefix) return;
    free(prefix->sums);
    free(prefix->plateaus);
    free(prefix);
}
