/* Following the rays of a tile, LANES at once. Each lane follows a ray of its own from stretch to stretch and takes up
 * the next ray when its own has ended, so that hardly any lane idles whatever the rays meet. Opacity is added up as the
 * samples come; what is seen there is put off (cast_light.h). Compiled once for each width: core/CMakeLists.txt. */
#include "core/cpu/cast_light.h"

#ifndef CAST_TILE
#define CAST_TILE ang_cast_tile_baseline
#endif

/* What each lane follows. */
typedef struct walk {
    lanes start[3], direction[3], count, last_piece;
    lanes i, end; /* of the stretch */
    lanes begin;  /* steps as a whole: the stretch's first, before which `i` once stands to look up where it begins */
    lanes taken;  /* samples of the ray since it was taken up */
    lanes state;  /* opacity, extreme, sum or hit so far */
    lanes light[3], lost[2], weight;
    step_end at;   /* steps as a whole: where the next begins */
    lanes_int ray; /* RAYS: none is left */
    int next;      /* of the tile's active rays, to be taken up */
    int stretch[LANES];
} walk;

INLINE void put(lanes *x, lanes_int lane, float value) { *x = lanes_pick(lane, lanes_all(value), *x); }

INLINE void start_stretch(walk *w, lanes_int lane, float from, float to, ang_cast_kind kind) {
    put(&w->i, lane, is_whole(kind) ? from - 1 : from);
    put(&w->end, lane, to);
    if (is_whole(kind)) put(&w->begin, lane, from);
}

/* Gives lane `l` the next ray that has a stretch. */
INLINE void take_up(const tile *t, walk *w, int l, ang_cast_kind kind) {
    lanes_int lane = lanes_number() == l;
    int ray = RAYS;
    while (w->next < t->actives && ray == RAYS) {
        int candidate = t->active[w->next++];
        if (t->stretches[candidate] > 0) ray = candidate;
    }
    w->ray = lanes_pick_int(lane, lanes_all_int(ray), w->ray);
    w->stretch[l] = 0;
    bool none = ray == RAYS;
    for (int axis = 0; axis < 3; axis++) {
        put(&w->start[axis], lane, none ? 0 : t->start[axis][ray]);
        put(&w->direction[axis], lane, none ? 0 : t->direction[axis][ray]);
        put(&w->light[axis], lane, t->light[ray][axis]);
    }
    put(&w->count, lane, none ? 0 : t->count[ray]);
    put(&w->last_piece, lane, none ? 0 : t->last_piece[ray]);
    start_stretch(w, lane, none ? 0 : t->from[ray][0], none ? -1 : t->to[ray][0], kind);
    put(&w->taken, lane, 0);
    put(&w->state, lane, t->state[ray]);
    put(&w->lost[0], lane, 0);
    put(&w->lost[1], lane, 0);
    put(&w->weight, lane, 0);
}

/* What a ray that is let go of has come to. */
typedef struct outcome {
    float state[LANES], taken[LANES], light[3][LANES];
    int ray[LANES];
} outcome;

/* Lane `l` is at the end of its stretch, or `over` with its ray. */
INLINE void go_on(tile *t, walk *w, int l, bool over, ang_cast_kind kind, bool dense, const outcome *o) {
    int r = o->ray[l], next = w->stretch[l] + 1;
    if (!over && next < t->stretches[r]) {
        w->stretch[l] = next;
        start_stretch(w, lanes_number() == l, t->from[r][next], t->to[r][next], kind);
        return;
    }
    t->taken[r] += o->taken[l];
    t->state[r] = o->state[l];
    for (int c = 0; c < 3 && dense; c++) t->light[r][c] = o->light[c][l];
    if (over) t->begin[r] = t->end[r];
    take_up(t, w, l, kind);
}

/* Samples of each lane that are taken at once: the steps of one do not wait for those of another. */
enum { AT_ONCE = 4 };

/* Of steps as a whole `value` is what lies at their ends, `place` their middle. */
typedef struct samples {
    lanes place[AT_ONCE][3], inside[AT_ONCE][3], piece[AT_ONCE], value[AT_ONCE];
    lanes_int counts[AT_ONCE]; /* within the stretch */
    int at[AT_ONCE][LANES];
} samples;

INLINE void take_samples(const ang_cast *cast, const walk *w, samples *s) {
    for (int k = 0; k < AT_ONCE; k++) {
        lanes i = w->i + (float)k, along = place_of(cast, i, w->count, w->last_piece, &s->piece[k]);
        for (int axis = 0; axis < 3; axis++) s->place[k][axis] = w->start[axis] + along * w->direction[axis];
        spot at = find_spot(cast, s->place[k]);
        for (int axis = 0; axis < 3; axis++) s->inside[k][axis] = at.inside[axis];
        lanes_store_int(s->at[k], at.at);
        s->counts[k] = i < w->end;
        s->piece[k] = lanes_pick(s->counts[k], s->piece[k], lanes_all(0));
    }
    LANES_IN_MEMORY(s->at);
    const rows r = rows_of(cast, cast->values);
    for (int k = 0; k < AT_ONCE; k++) s->value[k] = interpolate_at(&r, s->at[k], s->inside[k]);
}

/* Steps as a whole: what lies where each ends. */
INLINE void take_ends(const ang_cast *cast, const walk *w, samples *s, bool phong) {
    for (int k = 0; k < AT_ONCE; k++) {
        lanes i = w->i + (float)k, middle = place_of(cast, i, w->count, w->last_piece, &s->piece[k]), place[3];
        lanes along = end_of(cast, i, w->count, w->last_piece);
        for (int axis = 0; axis < 3; axis++) {
            place[axis] = w->start[axis] + along * w->direction[axis];
            if (phong) s->place[k][axis] = w->start[axis] + middle * w->direction[axis];
        }
        spot at = find_spot(cast, place);
        for (int axis = 0; axis < 3; axis++) s->inside[k][axis] = at.inside[axis];
        lanes_store_int(s->at[k], at.at);
        s->counts[k] = (i >= w->begin) & (i < w->end);
        s->piece[k] = lanes_pick(s->counts[k], s->piece[k], lanes_all(0));
    }
    LANES_IN_MEMORY(s->at);
    const rows r = rows_of(cast, cast->values);
    for (int k = 0; k < AT_ONCE; k++) s->value[k] = interpolate_at(&r, s->at[k], s->inside[k]);
}

/* Opacity of the steps whose ends lie at the samples; returns which rays are over. */
INLINE lanes_int add_steps(const ang_cast *cast, tile *t, walk *w, const samples *s, seen *noted, ang_cast_kind kind,
                           uint64_t *shown) {
    lanes opacity[AT_ONCE], from[AT_ONCE], to[AT_ONCE];
    for (int k = 0; k < AT_ONCE; k++) {
        step_end end = end_of_step(cast, cast->jumps ? settle(s->value[k]) : s->value[k]);
        lanes depth = extinction_between(cast, &w->at, &end) * s->piece[k], edge;
        if (cast->plateaus) {
            lanes_int opaque = meets_plateau(cast, &w->at.at, &end.at, &edge) & s->counts[k];
            depth = lanes_pick(opaque, lanes_all(ANG_TABLE_OPAQUE), depth);
        }
        opacity[k] = opacity_of(cast, depth);
        from[k] = w->at.at.x;
        to[k] = end.at.x;
        w->at = end;
    }
    lanes_int over = lanes_all_int(0);
    for (int k = 0; k < AT_ONCE; k++) {
        lanes added = (1 - w->state) * opacity[k];
        added = lanes_pick(s->counts[k] & ~over, added, lanes_all(0));
        w->taken -= lanes_float(s->counts[k] & ~over);
        unsigned shows = lanes_bits(added > 0);
        if (!shows) continue;
        *shown += (unsigned)lanes_count(shows);
        sight x = {added, from[k], to[k], s->piece[k], s->place[k]};
        note_seen(cast, t, noted, shows, w->ray, &x, kind);
        w->state += added;
        over = w->state >= cast->termination;
    }
    return over;
}

/* Opacity of the samples, and their light where it is `dense`; returns which rays are over. */
INLINE lanes_int add_opacity(const ang_cast *cast, tile *t, walk *w, const samples *s, seen *noted, ang_cast_kind kind,
                             bool dense, uint64_t *shown) {
    lanes opacity[AT_ONCE], colour[AT_ONCE][3];
    for (int k = 0; k < AT_ONCE; k++) {
        lanes value = cast->jumps ? settle(s->value[k]) : s->value[k], extinction;
        if (dense)
            medium_at(cast, value, &extinction, colour[k]);
        else
            extinction = extinction_at(cast, value);
        opacity[k] = opacity_of(cast, extinction * s->piece[k]);
    }
    lanes_int over = lanes_all_int(0);
    for (int k = 0; k < AT_ONCE; k++) {
        lanes added = (1 - w->state) * opacity[k];
        added = lanes_pick(over, lanes_all(0), added);
        w->taken -= lanes_float(s->counts[k] & ~over);
        unsigned shows = lanes_bits(added > 0);
        if (!shows) continue;
        *shown += (unsigned)lanes_count(shows);
        for (int c = 0; c < 3 && dense; c++) w->light[c] += added * colour[k][c];
        if (!dense) {
            sight x = {.added = added, .place = s->place[k]};
            x.value = cast->jumps ? settle(s->value[k]) : s->value[k];
            note_seen(cast, t, noted, shows, w->ray, &x, kind);
        }
        w->state += added;
        over = w->state >= cast->termination;
    }
    return over;
}

/* Values of the samples, for modes that show one; returns which rays are over. */
INLINE lanes_int add_values(const ang_cast *cast, walk *w, const samples *s, ang_cast_kind kind) {
    lanes_int over = lanes_all_int(0);
    rows padding = {{NULL, NULL, NULL, NULL}};
    if (kind == ANG_CAST_MEAN_WEIGHTED) padding = rows_of(cast, cast->weights);
    for (int k = 0; k < AT_ONCE; k++) {
        lanes value = s->value[k];
        lanes_int counts = s->counts[k];
        w->taken -= lanes_float(counts & ~over);
        if (kind == ANG_CAST_HIGHEST) {
            w->state = lanes_max(w->state, lanes_pick(counts, value, lanes_all(0)));
        } else if (kind == ANG_CAST_LOWEST) {
            w->state = lanes_min(w->state, lanes_pick(counts, value, lanes_all(65535)));
        } else if (kind == ANG_CAST_SURFACE) {
            lanes_int hit = (settle(value) >= cast->iso) & counts & ~over;
            w->state = lanes_pick(hit, w->i + (float)k, w->state);
            over |= hit;
        } else {
            /* Thousands of terms: what a sum loses to rounding is added to the next term (Kahan). */
            lanes weight = lanes_all(1);
            if (kind == ANG_CAST_MEAN_WEIGHTED)
                weight = interpolate_at(&padding, s->at[k], s->inside[k]) * (1.0f / 65535);
            lanes term = s->piece[k] * (value - cast->mean_base) - w->lost[0], sum = w->state + term;
            w->lost[0] = (sum - w->state) - term;
            w->state = sum;
            term = s->piece[k] * weight - w->lost[1];
            sum = w->weight + term;
            w->lost[1] = (sum - w->weight) - term;
            w->weight = sum;
        }
    }
    bool extreme = kind == ANG_CAST_HIGHEST || kind == ANG_CAST_LOWEST;
    return extreme && cast->skips ? is_enough(cast, kind, w->state) : over;
}

INLINE lanes mean_of(const ang_cast *cast, const walk *w) {
    lanes_int any = w->weight > 0;
    lanes mean = cast->mean_base + w->state / lanes_pick(any, w->weight, lanes_all(1));
    return lanes_pick(any, mean, lanes_all(cast->mean_empty));
}

/* Follows the stretches of all active rays. `kind` and `dense` are constants; dense: most samples show, and are not
 * worth to be put off. */
INLINE void follow(const ang_cast *cast, tile *t, seen *noted, ang_cast_kind kind, bool dense, uint64_t *shown) {
    bool mean = kind == ANG_CAST_MEAN || kind == ANG_CAST_MEAN_WEIGHTED;
    walk w = {.next = 0};
    for (int l = 0; l < LANES; l++) take_up(t, &w, l, kind);
    while (lanes_bits(w.ray != RAYS)) {
        samples s;
        lanes_int over;
        if (is_whole(kind))
            take_ends(cast, &w, &s, is_shaded(kind));
        else
            take_samples(cast, &w, &s);
        if (is_whole(kind))
            over = add_steps(cast, t, &w, &s, noted, kind, shown);
        else if (is_light(kind))
            over = add_opacity(cast, t, &w, &s, noted, kind, dense, shown);
        else
            over = add_values(cast, &w, &s, kind);
        w.i += AT_ONCE;
        unsigned ended = lanes_bits((over | (w.i >= w.end)) & (w.ray != RAYS));
        if (!ended) continue;
        outcome o;
        lanes_store(o.state, mean ? mean_of(cast, &w) : w.state);
        lanes_store(o.taken, w.taken);
        lanes_store_int(o.ray, w.ray);
        for (int c = 0; c < 3 && dense; c++) lanes_store(o.light[c], w.light[c]);
        for (unsigned done = lanes_bits(over); ended; ended &= ended - 1) {
            int l = __builtin_ctz(ended);
            go_on(t, &w, l, done >> l & 1, kind, dense, &o);
        }
    }
}

/* Halvings of one step of an iso-surface's ray. */
enum { REFINEMENTS = 18 };

/* The surfaces that rays met: state holds the sample at or above the iso value, -2 where there was none. */
INLINE void find_surfaces(const ang_cast *cast, tile *t) {
    int hits[RAYS + LANES], count = 0;
    for (int ray = 0; ray < RAYS; ray++)
        if (t->state[ray] > -2) hits[count++] = ray;
    for (int l = 0; l < LANES; l++) hits[count + l] = count ? hits[0] : 0;
    for (int first = 0; first < count; first += LANES) {
        lanes_int ray = lanes_load_int(hits + first);
        lanes start[3], direction[3], place[3], piece, colour[3], cut_colour[3];
        for (int axis = 0; axis < 3; axis++) {
            start[axis] = lanes_floats(t->start[axis], ray);
            direction[axis] = lanes_floats(t->direction[axis], ray);
        }
        lanes count_of = lanes_floats(t->count, ray), last_piece = lanes_floats(t->last_piece, ray);
        lanes i = lanes_floats(t->state, ray);
        /* A ray that starts inside meets a cut face, which shows its own value. */
        lanes_int cut = i < 0;
        lanes after = place_of(cast, i, count_of, last_piece, &piece);
        lanes before = place_of(cast, lanes_max(i - 1, lanes_all(-1)), count_of, last_piece, &piece);
        for (int n = 0; n < REFINEMENTS; n++) {
            lanes middle = 0.5f * (before + after);
            for (int axis = 0; axis < 3; axis++) place[axis] = start[axis] + middle * direction[axis];
            spot at = find_spot(cast, place);
            lanes_int above = settle(interpolate(cast, cast->values, &at)) >= cast->iso;
            after = lanes_pick(above, middle, after);
            before = lanes_pick(above, before, middle);
        }
        for (int axis = 0; axis < 3; axis++) place[axis] = start[axis] + after * direction[axis];
        spot at = find_spot(cast, place);
        colour_at(cast, settle(interpolate(cast, cast->values, &at)), cut_colour);
        for (int c = 0; c < 3; c++) colour[c] = lanes_pick(cut, cut_colour[c], lanes_all(cast->iso_colour[c]));
        shade(cast, &at, direction, colour);
        lanes lit[4] = {colour[0], colour[1], colour[2], lanes_all(1)};
        float each[4 * LANES];
        lanes_transpose_back(lit, each);
        for (int l = 0; l < LANES && first + l < count; l++) {
            memcpy(t->light[hits[first + l]], each + 4 * l, sizeof t->light[0]);
            if (t->state[hits[first + l]] >= 0) t->taken[hits[first + l]] += REFINEMENTS;
        }
    }
}

/* Every ray of the tile to its end. `kind` is a constant. */
INLINE void cast_rays(const ang_cast *cast, tile *t, ang_cast_kind kind, ang_cast_took *took) {
    seen s;
    s.count = 0;
    bool dense = kind == ANG_CAST_LIGHT && took->shown > 0.5 * (double)took->samples;
    bool extreme = kind == ANG_CAST_HIGHEST || kind == ANG_CAST_LOWEST;
    if (cast->skips && extreme) {
        for (int first = 0; first < t->actives; first += LANES) find_peaks(cast, t, first, kind);
        follow(cast, t, &s, kind, false, &took->shown);
        keep_unfinished(t);
    }
    while (t->actives > 0) {
        if (!cast->skips) take_all(t);
        for (int first = 0; cast->skips && first < t->actives; first += LANES) find_stretches(cast, t, first, kind);
        if (dense)
            follow(cast, t, &s, kind, true, &took->shown);
        else
            follow(cast, t, &s, kind, false, &took->shown);
        keep_unfinished(t);
    }
    if (is_light(kind)) note_rest(cast, t, &s, kind);
    if (kind == ANG_CAST_SURFACE) find_surfaces(cast, t);
}

/* The pixels of a tile. `kind` is a constant. */
INLINE void cast_tile(const ang_cast *given, ang_cast_kind kind, int x, int y, ang_cast_took *took) {
    /* Of a copy the compiler knows that nothing else writes to it. */
    const ang_cast copy = *given, *cast = &copy;
    tile t;
    t.actives = 0;
    float nothing = kind == ANG_CAST_LOWEST ? 65535 : kind == ANG_CAST_SURFACE ? -2 : 0;
    for (int ray = 0; ray < RAYS; ray += LANES) make_rays(cast, &t, x, y, ray);
    memset(t.taken, 0, sizeof t.taken);
    memset(t.light, 0, sizeof t.light);
    for (int ray = 0; ray <= RAYS; ray++) t.state[ray] = nothing;
    cast_rays(cast, &t, kind, took);
    put_tile(cast, &t, x, y, took);
}

/* A function for each kind: compilers do worse on one large function (by a tenth, GCC 12). */
#define TILE_OF(kind)                                                                                                  \
    static __attribute__((noinline)) void tile_of_##kind(const ang_cast *cast, int x, int y, ang_cast_took *took) {    \
        cast_tile(cast, kind, x, y, took);                                                                             \
    }
TILE_OF(ANG_CAST_LIGHT)
TILE_OF(ANG_CAST_LIGHT_PHONG)
TILE_OF(ANG_CAST_WHOLE)
TILE_OF(ANG_CAST_WHOLE_PHONG)
TILE_OF(ANG_CAST_HIGHEST)
TILE_OF(ANG_CAST_LOWEST)
TILE_OF(ANG_CAST_MEAN)
TILE_OF(ANG_CAST_MEAN_WEIGHTED)
TILE_OF(ANG_CAST_SURFACE)

void CAST_TILE(const ang_cast *cast, int x, int y, ang_cast_took *took) {
    static ang_cast_tile *const of_kind[] = {
        [ANG_CAST_LIGHT] = tile_of_ANG_CAST_LIGHT,     [ANG_CAST_LIGHT_PHONG] = tile_of_ANG_CAST_LIGHT_PHONG,
        [ANG_CAST_WHOLE] = tile_of_ANG_CAST_WHOLE,     [ANG_CAST_WHOLE_PHONG] = tile_of_ANG_CAST_WHOLE_PHONG,
        [ANG_CAST_HIGHEST] = tile_of_ANG_CAST_HIGHEST, [ANG_CAST_LOWEST] = tile_of_ANG_CAST_LOWEST,
        [ANG_CAST_MEAN] = tile_of_ANG_CAST_MEAN,       [ANG_CAST_MEAN_WEIGHTED] = tile_of_ANG_CAST_MEAN_WEIGHTED,
        [ANG_CAST_SURFACE] = tile_of_ANG_CAST_SURFACE,
    };
    of_kind[cast->kind](cast, x, y, took);
}
