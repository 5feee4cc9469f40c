/* Following the rays of a tile from cell to cell, LANES at once. Between the faces of a cell the field along a ray is a
 * smooth cubic, so that its values at the two faces and in the middle, from one fetch of the cell's voxels, tell it as
 * well as many samples of equal steps do; what the transfer function does between them is integrated
 * (core/transfer/means.h, docs/adaptive.md). Compiled once for each width: core/CMakeLists.txt. */
#define LANES_PUT_OFF
#include "core/cpu/cast_rays.h"
#include "core/cpu/cast_shade.h"

#ifndef CAST_CELLS
#define CAST_CELLS ang_cast_cells_baseline
#endif

enum {
    AT_ONCE = 2,        /* pieces of each lane whose voxels are fetched at once */
    ENDS = 2 * AT_ONCE, /* of halves of these pieces */
};

/* Halves of pieces that show, shaded once all lanes can be filled with them. */
typedef struct seen {
    int count;
    float ray[2 * LANES], added[2 * LANES], colour[3][2 * LANES], place[3][2 * LANES];
} seen;

/* A value on the way, in intervals of the table; its record, and of that what a mean is made of. */
typedef struct mark {
    lanes x;
    lanes_int record, sum[4];
    lanes within[4], value[4], whole[4]; /* integral up to x; value there; integral over the interval */
} mark;

/* What each lane follows. */
typedef struct walk {
    lanes start[3], direction[3], inverse[3]; /* mm a voxel, signed */
    lanes_int ahead[3];                       /* 1 where it goes towards the last voxel, else 0 */
    lanes at, to, end;                        /* mm along the ray: so far, of the stretch, of the ray */
    lanes_int cell[3];                        /* that lies ahead */
    lanes value;                              /* here, from the cell behind, so that it is the same whoever asks */
    mark mark[2];                             /* the first: of it; the second: of what lies between */
    lanes_int anew;                           /* the value is not known yet: that of the cell ahead is taken */
    lanes opacity, light[3], taken;
    lanes_int ray; /* RAYS: none is left */
    int next;      /* of the tile's active rays, to be taken up */
    int stretch[LANES];
    float reached[RAYS + 1]; /* mm: a ray's that was let go of */
} walk;

INLINE void put(lanes *x, lanes_int lane, float value) { *x = lanes_pick(lane, lanes_all(value), *x); }

/* Sets lane `l` to the next stretch of its ray that is not yet behind it; false where there is none. A stretch begins
 * between its first sample's middle and that of the one before; what lies before it shows nothing. `anew`: the lane
 * does not know its cell. */
INLINE bool begin_stretch(const ang_cast *cast, const tile *t, walk *w, int l, bool anew) {
    lanes_int lane = lanes_number() == l;
    int ray = w->ray[l];
    float end = w->end[l], at = w->at[l];
    for (; w->stretch[l] < t->stretches[ray]; w->stretch[l]++) {
        float to = fminf((t->to[ray][w->stretch[l]] + 0.5f) * cast->step, end);
        if (t->to[ray][w->stretch[l]] >= t->end[ray]) to = end;
        if (!(to > at)) continue;
        put(&w->to, lane, to);
        float from = (t->from[ray][w->stretch[l]] - 0.5f) * cast->step;
        if (!anew && from <= at) return true;
        from = fmaxf(from, at);
        put(&w->at, lane, from);
        w->anew |= lane;
        for (int axis = 0; axis < 3; axis++) {
            float place = t->start[axis][ray] + from * t->direction[axis][ray];
            int cell = (int)fmaxf(fminf(place, cast->top[axis]), 0);
            w->cell[axis] = lanes_pick_int(lane, lanes_all_int(cell), w->cell[axis]);
        }
        return true;
    }
    return false;
}

/* Gives lane `l` the next ray that has a stretch. */
INLINE void take_up(const ang_cast *cast, const tile *t, walk *w, int l) {
    lanes_int lane = lanes_number() == l;
    while (w->next < t->actives) {
        int ray = t->active[w->next++];
        w->ray = lanes_pick_int(lane, lanes_all_int(ray), w->ray);
        w->stretch[l] = 0;
        put(&w->at, lane, w->reached[ray]);
        put(&w->end, lane, (t->count[ray] - 1) * cast->step + t->last_piece[ray]);
        if (!begin_stretch(cast, t, w, l, true)) continue;
        for (int axis = 0; axis < 3; axis++) {
            float along = t->direction[axis][ray];
            along = fabsf(along) < 1e-9f ? 1e-9f : along;
            put(&w->start[axis], lane, t->start[axis][ray]);
            put(&w->direction[axis], lane, t->direction[axis][ray]);
            put(&w->inverse[axis], lane, 1 / along);
            w->ahead[axis] = lanes_pick_int(lane, lanes_all_int(along > 0), w->ahead[axis]);
            put(&w->light[axis], lane, t->light[ray][axis]);
        }
        put(&w->opacity, lane, t->state[ray]);
        put(&w->taken, lane, 0);
        return;
    }
    w->ray = lanes_pick_int(lane, lanes_all_int(RAYS), w->ray);
    w->anew |= lane;
    put(&w->at, lane, 0);
    put(&w->to, lane, 0);
    put(&w->end, lane, 0);
}

/* What a lane whose stretch has ended goes on with; `over`: its ray has. */
INLINE void go_on(const ang_cast *cast, tile *t, walk *w, int l, bool over, bool phong) {
    int ray = w->ray[l];
    w->stretch[l]++;
    if (!over && begin_stretch(cast, t, w, l, false)) return;
    w->reached[ray] = w->at[l];
    t->taken[ray] += w->taken[l];
    t->state[ray] = w->opacity[l];
    for (int c = 0; c < 3 && !phong; c++) t->light[ray][c] = w->light[c][l];
    if (over) t->begin[ray] = t->end[ray];
    take_up(cast, t, w, l);
}

/* The next pieces of each lane: no longer than the longest, within a cell each. */
typedef struct pieces {
    lanes from[AT_ONCE], to[AT_ONCE], half[AT_ONCE]; /* mm: where they begin and end, and half their length */
    lanes_int cell[AT_ONCE][3];
    int at[AT_ONCE][LANES]; /* of the cell's first voxel in the volume */
} pieces;

/* `cell` where it is one of the volume's, else the nearest. */
INLINE lanes_int cell_within(const ang_cast *cast, int axis, lanes_int cell) {
    lanes_int last = lanes_all_int(cast->last[axis] > 0 ? cast->last[axis] - 1 : 0);
    cell = lanes_pick_int(cell > last, last, cell);
    return cell & (cell > 0);
}

/* Where the cells ahead end: of each axis, and the first of them. */
INLINE lanes faces_ahead(const ang_cast *cast, const walk *w, const lanes_int cell[3], lanes_int side, lanes face[3]) {
    lanes next = lanes_all(1e30f);
    for (int axis = 0; axis < 3; axis++) {
        face[axis] = (lanes_float(cell[axis] + (-w->ahead[axis] & side)) - w->start[axis]) * w->inverse[axis];
        if (cast->last[axis] > 0) next = lanes_min(next, face[axis]);
    }
    return next;
}

/* Lanes before a block in which colour and extinction stay the same take it as one cell: the one in which they leave
 * it, since all its values show the same. */
INLINE void take_blocks(const ang_cast *cast, walk *w, lanes face[3], lanes *next) {
    lanes_int cell[3], first[3], outside = lanes_all_int(0);
    for (int axis = 0; axis < 3; axis++) {
        cell[axis] = cell_within(cast, axis, w->cell[axis]);
        outside |= cell[axis] != w->cell[axis];
    }
    lanes_int flat = lanes_bytes(cast->flat, node_of(cast->blocks, lanes_all_int(BLOCK_SHIFT), cell)) != 0;
    flat &= ~outside;
    if (!lanes_bits(flat)) return;
    lanes block_face[3];
    for (int axis = 0; axis < 3; axis++) first[axis] = cell[axis] >> BLOCK_SHIFT << BLOCK_SHIFT;
    lanes end = lanes_min(faces_ahead(cast, w, first, lanes_all_int(1 << BLOCK_SHIFT), block_face), w->end);
    for (int axis = 0; axis < 3; axis++) {
        lanes_int last = first[axis] + ((1 << BLOCK_SHIFT) - 1);
        lanes_int leaving = lanes_truncate(lanes_max(w->start[axis] + end * w->direction[axis], lanes_all(0)));
        leaving = lanes_pick_int(leaving < first[axis], first[axis], lanes_pick_int(leaving > last, last, leaving));
        leaving =
            lanes_pick_int(block_face[axis] <= end, lanes_pick_int(w->ahead[axis] != 0, last, first[axis]), leaving);
        w->cell[axis] = lanes_pick_int(flat, leaving, w->cell[axis]);
        face[axis] = lanes_pick(flat, block_face[axis], face[axis]);
    }
    *next = lanes_pick(flat, end, *next);
}

INLINE void find_pieces(const ang_cast *cast, walk *w, pieces *p) {
    for (int k = 0; k < AT_ONCE; k++) {
        lanes face[3], next = faces_ahead(cast, w, w->cell, lanes_all_int(1), face);
        /* What is left of a cell joins the piece before it where it is less than half of one. */
        next = lanes_pick(next - w->at > cast->longest_whole, w->at + cast->longest, next);
        if (cast->flat) take_blocks(cast, w, face, &next);
        next = lanes_max(lanes_min(next, w->end), w->at);
        p->from[k] = w->at;
        p->to[k] = next;
        p->half[k] = 0.5f * (next - w->at);
        w->at = next;
        lanes_int at = lanes_all_int(0);
        for (int axis = 0; axis < 3; axis++) {
            p->cell[k][axis] = cell_within(cast, axis, w->cell[axis]);
            at += p->cell[k][axis] * (axis == 0 ? 1 : axis == 1 ? cast->row : cast->slice);
            w->cell[axis] += (face[axis] <= next) & (2 * w->ahead[axis] - 1);
        }
        lanes_store_int(p->at[k], at);
    }
    LANES_IN_MEMORY(p->at);
}

/* A cell's rows along x: the first voxel of each and the difference to the second. */
typedef struct corners {
    lanes first[4], rise[4];
} corners;

INLINE lanes value_in(const corners *c, const lanes inside[3]) {
    lanes row[4];
    for (int i = 0; i < 4; i++) row[i] = c->first[i] + inside[0] * c->rise[i];
    return mix(mix(row[0], row[1], inside[1]), mix(row[2], row[3], inside[1]), inside[2]);
}

INLINE void look_up(const ang_cast *cast, lanes value, mark *m) {
    m->x = ((cast->jumps ? settle(value) : value) - cast->first) * cast->per_value;
    lanes most = lanes_all((float)cast->intervals);
    lanes_int base = lanes_truncate(lanes_max(lanes_min(m->x, most), lanes_all(0)));
    lanes share = m->x - lanes_float(base), left[4], half[4], sum[4];
    m->record = (base + 1) & (m->x >= 0);
    lanes_fours(cast->means, 3 * m->record, sum);
    lanes_fours(cast->means, 3 * m->record + 1, left);
    lanes_fours(cast->means, 3 * m->record + 2, half);
    for (int c = 0; c < 4; c++) {
        m->sum[c] = (lanes_int)sum[c];
        m->within[c] = share * (left[c] + share * half[c]);
        m->value[c] = left[c] + 2 * share * half[c];
        m->whole[c] = left[c] + half[c];
    }
}

/* Means of light and extinction along half a piece, between two marks; `bend`: by how much the mean of its values lies
 * above that of a line, in intervals. */
INLINE void means_between(const ang_cast *cast, const mark *a, const mark *b, lanes bend, lanes out[4]) {
    lanes width = b->x - a->x, inverse = 1 / lanes_pick(width == 0, lanes_all(1), width);
    lanes share = lanes_max(lanes_min(bend * inverse, lanes_all(cast->most_bent)), lanes_all(-cast->most_bent));
    lanes_int same = (a->record == b->record) | (width == 0);
    /* Over one end of an interval nothing is subtracted either; below the table nothing is summed. */
    lanes_int up = (b->record == a->record + 1) & (a->record > 0),
              down = (a->record == b->record + 1) & (b->record > 0);
    bool next = lanes_bits(up | down);
    for (int c = 0; c < 4; c++) {
        lanes sum = lanes_float(b->sum[c] - a->sum[c]) * cast->mean_unit;
        if (next) sum = lanes_pick(up, a->whole[c], lanes_pick(down, -b->whole[c], sum));
        lanes mean = (sum + (b->within[c] - a->within[c])) * inverse;
        mean = lanes_pick(same, 0.5f * (a->value[c] + b->value[c]), mean);
        out[c] = lanes_max(mean + share * (b->value[c] - a->value[c]), lanes_all(0));
    }
}

/* Where the half meets a plateau at opacity 1 it is opaque: behind what lies before that shows the plateau's colour. */
INLINE void end_at_plateau(const ang_cast *cast, const mark *a, const mark *b, lanes half, lanes mean[4],
                           lanes *opacity) {
    lanes above, below, from = lanes_float(a->record - 1), to = lanes_float(b->record - 1);
    lanes_pairs(cast->plateaus, a->record, &above, &below);
    lanes_int rises = b->x >= a->x, meets = lanes_pick_int(rises, above <= to, below >= to);
    if (!lanes_bits(meets)) return;
    lanes interval = lanes_pick(rises, above, below), edge = lanes_pick(rises, above, below + 1);
    lanes_int inside = interval == from;
    mark m;
    interval = lanes_pick(meets, interval, lanes_all(0));
    m.x = lanes_pick(inside, a->x, edge);
    m.record = lanes_truncate(interval) + 1;
    lanes sum[4], left[4], rise[4], front[4], share = lanes_max(lanes_min(m.x - interval, lanes_all(1)), lanes_all(0));
    lanes_fours(cast->means, 3 * m.record, sum);
    lanes_fours(cast->means, 3 * m.record + 1, left);
    lanes_fours(cast->means, 3 * m.record + 2, rise);
    for (int c = 0; c < 4; c++) {
        m.sum[c] = (lanes_int)sum[c];
        m.within[c] = m.value[c] = m.whole[c] = lanes_all(0);
    }
    means_between(cast, a, &m, lanes_all(0), front);
    lanes width = b->x - a->x, part = (m.x - a->x) / lanes_pick(width == 0, lanes_all(1), width);
    lanes before = opacity_of(cast, front[3] * (half * part)), inverse = 1 / lanes_max(front[3], lanes_all(1e-30f));
    for (int c = 0; c < 3; c++) {
        lanes colour = lanes_min(front[c] * inverse, lanes_all(1)), behind = left[c] + 2 * share * rise[c];
        mean[c] = lanes_pick(meets, before * colour + (1 - before) * behind, mean[c]);
    }
    mean[3] = lanes_pick(meets, lanes_all(1), mean[3]);
    *opacity = lanes_pick(meets & (half > 0), lanes_all(1), *opacity);
}

INLINE void shade_seen(const ang_cast *cast, tile *t, const seen *s) {
    lanes_int ray = (lanes_int)lanes_load(s->ray), whose = ray;
    lanes added = lanes_load(s->added), light[4], place[3], direction[3];
    for (int axis = 0; axis < 3; axis++) {
        place[axis] = lanes_load(s->place[axis]);
        direction[axis] = lanes_floats(t->direction[axis], whose);
        light[axis] = lanes_load(s->colour[axis]);
    }
    spot at = find_spot(cast, place);
    shade(cast, &at, direction, light);
    add_to_rays(t, ray, added, light);
}

INLINE void note_seen(const ang_cast *cast, tile *t, seen *s, unsigned bits, lanes_int ray, lanes added,
                      const lanes colour[3], const lanes place[3]) {
    lanes_pack(s->ray + s->count, (lanes)ray, bits);
    lanes_pack(s->added + s->count, added, bits);
    for (int c = 0; c < 3; c++) {
        lanes_pack(s->colour[c] + s->count, colour[c], bits);
        lanes_pack(s->place[c] + s->count, place[c], bits);
    }
    s->count += lanes_count(bits);
    if (s->count < LANES) return;
    shade_seen(cast, t, s);
    s->count -= LANES;
    memmove(s->ray, s->ray + LANES, sizeof s->ray / 2);
    memmove(s->added, s->added + LANES, sizeof s->added / 2);
    for (int c = 0; c < 3; c++) {
        memmove(s->colour[c], s->colour[c] + LANES, sizeof s->colour[c] / 2);
        memmove(s->place[c], s->place[c] + LANES, sizeof s->place[c] / 2);
    }
}

/* What is left: filled up with halves of nobody. */
INLINE void note_rest(const ang_cast *cast, tile *t, seen *s) {
    if (s->count == 0) return;
    for (int i = s->count; i < LANES; i++) {
        int nobody = RAYS;
        memcpy(&s->ray[i], &nobody, sizeof nobody);
        s->added[i] = 0;
        for (int c = 0; c < 3; c++) s->colour[c][i] = s->place[c][i] = 0;
    }
    shade_seen(cast, t, s);
    s->count = 0;
}

INLINE lanes value_at(const walk *w, const corners *c, const lanes_int cell[3], lanes along) {
    lanes inside[3];
    for (int axis = 0; axis < 3; axis++) {
        lanes place = w->start[axis] + along * w->direction[axis] - lanes_float(cell[axis]);
        inside[axis] = lanes_max(lanes_min(place, lanes_all(1)), lanes_all(0));
    }
    return value_in(c, inside);
}

INLINE corners corners_of(const ang_cast *cast, const int at[LANES]) {
    const rows r = rows_of(cast, cast->values);
    lanes_int word[4];
    corners c;
    lanes_words(r.row, at, word);
    for (int i = 0; i < 4; i++) {
        c.first[i] = low_of(word[i]);
        c.rise[i] = high_of(word[i]) - c.first[i];
    }
    return c;
}

/* Values at the ends of the halves of the pieces, and how much each piece bends: the mean of half of it above a line's.
 */
INLINE void find_values(const ang_cast *cast, walk *w, const pieces *p, lanes value[ENDS], lanes bend[AT_ONCE]) {
    for (int k = 0; k < AT_ONCE; k++) {
        corners c = corners_of(cast, p->at[k]);
        if (k == 0 && lanes_bits(w->anew)) {
            w->value = lanes_pick(w->anew, value_at(w, &c, p->cell[k], p->from[k]), w->value);
            w->anew = lanes_all_int(0);
            look_up(cast, w->value, &w->mark[0]);
        }
        lanes middle = value_at(w, &c, p->cell[k], p->from[k] + p->half[k]);
        lanes last = value_at(w, &c, p->cell[k], p->to[k]);
        bend[k] = (2 * middle - (w->value + last)) * (cast->per_value / 12);
        value[2 * k] = middle;
        value[2 * k + 1] = w->value = last;
    }
}

/* Adds what the pieces show; returns which rays are over. `phong` is a constant. */
INLINE lanes_int add_pieces(const ang_cast *cast, tile *t, walk *w, const pieces *p, seen *noted, bool phong) {
    lanes value[ENDS], bend[AT_ONCE], opacity[ENDS], mean[ENDS][4];
    find_values(cast, w, p, value, bend);
    for (int h = 0; h < ENDS; h++) {
        mark *from = &w->mark[h & 1], *to = &w->mark[(h + 1) & 1];
        look_up(cast, value[h], to);
        means_between(cast, from, to, bend[h / 2], mean[h]);
        opacity[h] = opacity_of(cast, mean[h][3] * p->half[h / 2]);
        if (cast->plateaus) end_at_plateau(cast, from, to, p->half[h / 2], mean[h], &opacity[h]);
    }
    lanes_int over = lanes_all_int(0);
    for (int h = 0; h < ENDS; h++) {
        lanes added = (1 - w->opacity) * opacity[h];
        added = lanes_pick(over, lanes_all(0), added);
        w->taken -= lanes_float((p->half[h / 2] > 0) & ~over);
        unsigned shows = lanes_bits(added > 0);
        if (!shows) continue;
        lanes inverse = 1 / lanes_max(mean[h][3], lanes_all(1e-30f)), colour[3];
        for (int c = 0; c < 3; c++) colour[c] = lanes_min(mean[h][c] * inverse, lanes_all(1));
        if (phong) {
            lanes along = p->from[h / 2] + (0.5f + (float)(h & 1)) * p->half[h / 2], place[3];
            for (int axis = 0; axis < 3; axis++) place[axis] = w->start[axis] + along * w->direction[axis];
            note_seen(cast, t, noted, shows, w->ray, added, colour, place);
        } else {
            for (int c = 0; c < 3; c++) w->light[c] += added * colour[c];
        }
        w->opacity += added;
        over = w->opacity >= cast->termination;
    }
    return over;
}

/* Follows the stretches of all active rays. */
INLINE void follow(const ang_cast *cast, tile *t, walk *w, seen *noted, bool phong) {
    w->next = 0;
    w->anew = lanes_all_int(0);
    for (int l = 0; l < LANES; l++) take_up(cast, t, w, l);
    while (lanes_bits(w->ray != RAYS)) {
        pieces p;
        find_pieces(cast, w, &p);
        lanes_int over = add_pieces(cast, t, w, &p, noted, phong);
        unsigned ended = lanes_bits((over | (w->at >= w->to)) & (w->ray != RAYS));
        for (unsigned done = lanes_bits(over); ended; ended &= ended - 1) {
            int l = __builtin_ctz(ended);
            go_on(cast, t, w, l, done >> l & 1, phong);
        }
    }
}

/* Every ray of the tile to its end. `kind` is a constant. */
INLINE void cast_rays(const ang_cast *cast, tile *t, ang_cast_kind kind) {
    bool phong = kind == ANG_CAST_LIGHT_PHONG;
    seen s;
    walk w = {.next = 0};
    s.count = 0;
    while (t->actives > 0) {
        if (!cast->skips) take_all(t);
        for (int first = 0; cast->skips && first < t->actives; first += LANES) find_stretches(cast, t, first, kind);
        follow(cast, t, &w, &s, phong);
        keep_unfinished(t);
    }
    note_rest(cast, t, &s);
}

void CAST_CELLS(const ang_cast *given, int x, int y, ang_cast_took *took) {
    /* Of a copy the compiler knows that nothing else writes to it. */
    const ang_cast copy = *given, *cast = &copy;
    tile t;
    t.actives = 0;
    for (int ray = 0; ray < RAYS; ray += LANES) make_rays(cast, &t, x, y, ray);
    memset(t.taken, 0, sizeof t.taken);
    memset(t.light, 0, sizeof t.light);
    memset(t.state, 0, sizeof t.state);
    if (cast->kind == ANG_CAST_LIGHT_PHONG)
        cast_rays(cast, &t, ANG_CAST_LIGHT_PHONG);
    else
        cast_rays(cast, &t, ANG_CAST_LIGHT);
    put_tile(cast, &t, x, y, took);
}
