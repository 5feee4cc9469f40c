#include "core/transfer/means.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Differences of any two integrals are whole numbers of 32 bits, too. */
static const double greatest_whole = 1 << 30;

void ang_means_free(ang_means *means) {
    if (!means) return;
    free(means->records);
    free(means->plateaus);
    free(means);
}

/* What stands for an interval: light and extinction, on a plateau the colours alone. Returns whether it adds. Light is
 * a product of two lines; the line that is nearest to it has its rise and its integral. */
static bool line_of(const ang_transfer_tables *tables, int interval, double left[4], double half[4]) {
    bool plateau = ang_plateaus_has(tables, interval);
    const float *at = tables->entries + 8 * (size_t)interval, *next = at + 4;
    for (int c = 0; c < 4; c++) {
        bool light = c < 3 && !plateau, nothing = c == 3 && plateau;
        double from = nothing ? 0 : (double)at[c], to = nothing ? 0 : (double)next[c], below = 0;
        if (light) {
            below = (to - from) * ((double)next[3] - (double)at[3]) / 6;
            from *= (double)at[3];
            to *= (double)next[3];
        }
        left[c] = from - below;
        half[c] = 0.5 * (to - from);
    }
    return !plateau;
}

static void put_record(float *record, const double sum[4], const double left[4], const double half[4], double unit) {
    for (int c = 0; c < 4; c++) {
        int32_t whole = unit > 0 ? (int32_t)lround(sum[c] / unit) : 0;
        memcpy(record + c, &whole, sizeof whole);
        record[4 + c] = (float)left[c];
        record[8 + c] = (float)half[c];
    }
}

/* What holds outside the table: light and extinction at one of its ends, on a plateau the colours alone. */
static void put_outside(float *record, const double sum[4], const float *entry, bool plateau, double unit) {
    static const double none[4] = {0};
    double level[4] = {0};
    for (int c = 0; c < 3; c++) level[c] = (double)entry[c] * (plateau ? 1 : (double)entry[3]);
    if (!plateau) level[3] = (double)entry[3];
    put_record(record, sum, level, none, unit);
}

static void fill(ang_means *means, const ang_transfer_tables *tables) {
    int last = tables->intervals - 1;
    const float *entries = tables->entries, *end = entries + 8 * (size_t)last + 4;
    double left[4], half[4], sum[4] = {0}, total = 0;
    for (int i = 0; i <= last; i++) /* of all channels the greatest: colours are 0..1 */
        if (line_of(tables, i, left, half)) total += left[3] + half[3];
    means->unit = total / greatest_whole;
    put_outside(means->records, sum, entries, ang_plateaus_has(tables, 0), means->unit);
    for (int i = 0; i <= last; i++) {
        bool adds = line_of(tables, i, left, half);
        put_record(means->records + ((size_t)i + 1) * ANG_MEANS_RECORD, sum, left, half, means->unit);
        for (int c = 0; c < 4 && adds; c++) sum[c] += left[c] + half[c];
    }
    float *outside = means->records + ((size_t)last + 2) * ANG_MEANS_RECORD;
    put_outside(outside, sum, end, ang_plateaus_has(tables, last), means->unit);
}

ang_means *ang_means_create(const ang_transfer_tables *tables, ang_error *err) {
    static const char what[] = "means of the transfer function";
    ang_means *means = ang_alloc(1, sizeof *means, what, err);
    if (!means) return NULL;
    means->intervals = tables->intervals;
    means->records = ang_alloc(((size_t)tables->intervals + 2) * ANG_MEANS_RECORD, sizeof *means->records, what, err);
    if (!means->records || !ang_plateaus_find(tables, &means->plateaus, err)) {
        ang_means_free(means);
        return NULL;
    }
    fill(means, tables);
    return means;
}
