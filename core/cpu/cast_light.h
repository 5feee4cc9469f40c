/* What rays see, put off until all lanes can be filled with samples that show: colour and shading cost far more than
 * opacity. Part of cast_kernel.c. */
#ifndef ANG_CPU_CAST_LIGHT_H
#define ANG_CPU_CAST_LIGHT_H

#include "core/cpu/cast_rays.h"
#include "core/cpu/cast_whole.h"

/* Samples that show: whose, how much of its light arrives, and what is there: a value, or, for steps as a whole, the
 * places of two values in the table and the mm between. */
typedef struct seen {
    int count;
    float ray[3 * LANES], added[3 * LANES], value[3 * LANES], other[3 * LANES], piece[3 * LANES], place[3][3 * LANES];
} seen;

/* Adds the light of the first LANES samples, those of a ray in their order. */
INLINE void add_light(const ang_cast *cast, tile *t, const seen *s, ang_cast_kind kind) {
    lanes_int ray = (lanes_int)lanes_load(s->ray);
    lanes added = lanes_load(s->added), light[4];
    if (is_whole(kind))
        colour_between(cast, lanes_load(s->value), lanes_load(s->other), lanes_load(s->piece), light);
    else
        colour_at(cast, lanes_load(s->value), light);
    if (is_shaded(kind)) {
        lanes place[3], direction[3];
        lanes_int whose = ray;
        for (int axis = 0; axis < 3; axis++) {
            place[axis] = lanes_load(s->place[axis]);
            direction[axis] = lanes_floats(t->direction[axis], whose);
        }
        spot at = find_spot(cast, place);
        shade(cast, &at, direction, light);
    }
    add_to_rays(t, ray, added, light);
}

INLINE void move_down(seen *s, ang_cast_kind kind) {
    s->count -= LANES;
    lanes_store(s->ray, lanes_load(s->ray + LANES));
    lanes_store(s->added, lanes_load(s->added + LANES));
    lanes_store(s->value, lanes_load(s->value + LANES));
    if (is_whole(kind)) {
        lanes_store(s->other, lanes_load(s->other + LANES));
        lanes_store(s->piece, lanes_load(s->piece + LANES));
    }
    for (int axis = 0; axis < 3 && is_shaded(kind); axis++)
        lanes_store(s->place[axis], lanes_load(s->place[axis] + LANES));
}

/* What one sample of each lane shows. */
typedef struct sight {
    lanes added, value, other, piece; /* as in `seen` */
    const lanes *place;               /* voxels from the first, where it is shaded */
} sight;

INLINE void note_seen(const ang_cast *cast, tile *t, seen *s, unsigned bits, lanes_int ray, const sight *x,
                      ang_cast_kind kind) {
    lanes_pack(s->ray + s->count, (lanes)ray, bits);
    lanes_pack(s->added + s->count, x->added, bits);
    lanes_pack(s->value + s->count, x->value, bits);
    if (is_whole(kind)) {
        lanes_pack(s->other + s->count, x->other, bits);
        lanes_pack(s->piece + s->count, x->piece, bits);
    }
    for (int axis = 0; axis < 3 && is_shaded(kind); axis++) lanes_pack(s->place[axis] + s->count, x->place[axis], bits);
    s->count += lanes_count(bits);
    if (s->count < LANES) return;
    add_light(cast, t, s, kind);
    move_down(s, kind);
}

/* What is left: filled up with samples of nobody. */
INLINE void note_rest(const ang_cast *cast, tile *t, seen *s, ang_cast_kind kind) {
    if (s->count == 0) return;
    for (int i = s->count; i < LANES; i++) {
        int nobody = RAYS;
        memcpy(&s->ray[i], &nobody, sizeof nobody);
        s->added[i] = s->value[i] = s->other[i] = s->piece[i] = 0;
        for (int axis = 0; axis < 3; axis++) s->place[axis][i] = 0;
    }
    add_light(cast, t, s, kind);
    s->count = 0;
}

#endif
