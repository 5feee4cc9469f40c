/* The field between voxels and its gradient, for all lanes at once. Part of cast_kernel.c. */
#ifndef ANG_CPU_CAST_FIELD_H
#define ANG_CPU_CAST_FIELD_H

#include "core/cpu/cast.h"
#include "core/cpu/lanes.h"

#include <stdbool.h>

/* Where a sample lies among voxels. */
typedef struct spot {
    lanes_int cell[3];
    lanes inside[3]; /* 0..1 */
    lanes_int at;    /* of the cell's first voxel in the volume */
} spot;

INLINE lanes mix(lanes a, lanes b, lanes s) { return a + s * (b - a); }
INLINE lanes low_of(lanes_int word) { return lanes_float(word & 0xffff); }
INLINE lanes high_of(lanes_int word) { return lanes_float((lanes_int)((lanes_uint)word >> 16)); }
INLINE lanes along_x(lanes_int word, lanes s) { return mix(low_of(word), high_of(word), s); }

/* `place` in voxels from the first, clamped to the volume. */
INLINE spot find_spot(const ang_cast *cast, const lanes place[3]) {
    spot s;
    for (int axis = 0; axis < 3; axis++) {
        lanes p = lanes_max(lanes_min(place[axis], lanes_all(cast->top[axis])), lanes_all(0));
        s.cell[axis] = lanes_truncate(p);
        s.inside[axis] = p - lanes_float(s.cell[axis]);
    }
    s.at = s.cell[0] + s.cell[1] * cast->row + s.cell[2] * cast->slice;
    return s;
}

/* The four rows that a cell lies between, from the first voxel of `values` on. */
typedef struct rows {
    const uint16_t *row[4];
} rows;

INLINE rows rows_of(const ang_cast *cast, const uint16_t *values) {
    return (rows){{values, values + cast->row, values + cast->slice, values + cast->row + cast->slice}};
}

INLINE lanes interpolate_at(const rows *r, const int place[LANES], const lanes inside[3]) {
    lanes_int word[4];
    lanes_words(r->row, place, word);
    lanes near = mix(along_x(word[0], inside[0]), along_x(word[1], inside[0]), inside[1]);
    lanes far = mix(along_x(word[2], inside[0]), along_x(word[3], inside[0]), inside[1]);
    return mix(near, far, inside[2]);
}

INLINE lanes interpolate(const ang_cast *cast, const uint16_t *values, const spot *s) {
    rows r = rows_of(cast, values);
    int place[LANES];
    lanes_store_int(place, s->at);
    LANES_IN_MEMORY(place);
    return interpolate_at(&r, place, s->inside);
}

/* Of the four rows that a cell lies between: interpolated along x, and the difference of what is ahead and behind. */
INLINE void differences_along_x(const ang_cast *cast, const spot *s, lanes row[4], lanes difference[4]) {
    const rows r = rows_of(cast, cast->values);
    const lanes f = s->inside[0];
    lanes_int first = s->cell[0] == 0, last = s->cell[0] >= cast->last[0] - 1;
    lanes_int behind[4], ahead[4];
    int place[LANES];
    lanes_store_int(place, s->at);
    LANES_IN_MEMORY(place);
    bool border = lanes_bits(first | last);
    if (!border) {
        lanes_int word[4];
        lanes_rows_of_four(r.row, place, word);
        behind[0] = word[0], ahead[0] = word[1], behind[1] = word[2], ahead[1] = word[3];
        lanes_rows_of_four(r.row + 2, place, word);
        behind[2] = word[0], ahead[2] = word[1], behind[3] = word[2], ahead[3] = word[3];
    } else {
        /* Clamped voxels stand for clamped places. */
        lanes_int here[4];
        lanes_words(r.row, place, here);
        lanes_store_int(place, s->at + ~first);
        LANES_IN_MEMORY(place);
        lanes_words(r.row, place, behind);
        lanes_store_int(place, s->at - ~last);
        LANES_IN_MEMORY(place);
        lanes_words(r.row, place, ahead);
        for (int i = 0; i < 4; i++) {
            behind[i] = (behind[i] & 0xffff) | here[i] << 16;
            ahead[i] = (lanes_int)((lanes_uint)here[i] >> 16) | (ahead[i] & ~0xffff);
        }
    }
    for (int i = 0; i < 4; i++) {
        lanes v0 = high_of(behind[i]), v1 = low_of(ahead[i]);
        row[i] = mix(v0, v1, f);
        difference[i] = mix(v1, high_of(ahead[i]), f) - mix(low_of(behind[i]), v0, f);
    }
}

/* Differences of the field one voxel ahead and one behind along each axis (DESIGN.md, "Gradient"): the cells there
 * share their fractions with this one, so that a row of four voxels serves both. */
INLINE void differences(const ang_cast *cast, const spot *s, lanes out[3]) {
    const lanes *f = s->inside;
    const int *last = cast->last;
    lanes row[4], d[4];
    differences_along_x(cast, s, row, d);
    out[0] = mix(mix(d[0], d[1], f[1]), mix(d[2], d[3], f[1]), f[2]);

    lanes_int behind[3], ahead[3], word[4]; /* by axis; [0] unused */
    behind[1] = s->at - (lanes_all_int(cast->row) & (s->cell[1] > 0));
    ahead[1] = s->at + cast->row + (lanes_all_int(cast->row) & (s->cell[1] < last[1] - 1));
    behind[2] = s->at - (lanes_all_int(cast->slice) & (s->cell[2] > 0));
    ahead[2] = s->at + cast->slice + (lanes_all_int(cast->slice) & (s->cell[2] < last[2] - 1));
    lanes_two_words(cast->values, behind[1], ahead[1], cast->slice, word);
    lanes near = mix(row[1], along_x(word[2], f[0]), f[1]) - mix(along_x(word[0], f[0]), row[0], f[1]);
    lanes far = mix(row[3], along_x(word[3], f[0]), f[1]) - mix(along_x(word[1], f[0]), row[2], f[1]);
    out[1] = mix(near, far, f[2]);

    lanes_two_words(cast->values, behind[2], ahead[2], cast->row, word);
    lanes plane[4] = {mix(along_x(word[0], f[0]), along_x(word[1], f[0]), f[1]), mix(row[0], row[1], f[1]),
                      mix(row[2], row[3], f[1]), mix(along_x(word[2], f[0]), along_x(word[3], f[0]), f[1])};
    out[2] = mix(plane[2], plane[3], f[2]) - mix(plane[0], plane[1], f[2]);
}

#endif
