/* A tile's rays, and the stretches of them that may show something. Part of cast_kernel.c. */
#ifndef ANG_CPU_CAST_RAYS_H
#define ANG_CPU_CAST_RAYS_H

#include "core/cpu/cast_field.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum {
    TILE = ANG_CAST_TILE,
    RAYS = TILE * TILE,
    STRETCHES = 8, /* found of a ray before it is followed: those behind what ends it are looked for in vain */
    BLOCK_SHIFT = 2
};

_Static_assert(1 << BLOCK_SHIFT == ANG_SKIP_BLOCK, "blocks are found by a shift");

INLINE bool is_whole(ang_cast_kind kind) { return kind == ANG_CAST_WHOLE || kind == ANG_CAST_WHOLE_PHONG; }
INLINE bool is_shaded(ang_cast_kind kind) { return kind == ANG_CAST_LIGHT_PHONG || kind == ANG_CAST_WHOLE_PHONG; }
INLINE bool is_light(ang_cast_kind kind) { return kind == ANG_CAST_LIGHT || is_whole(kind) || is_shaded(kind); }

/* Rays are numbered in squares of four by four, so that lanes hold neighbours. The ray RAYS is nobody's. Samples are
 * numbered along the lattice (DESIGN.md, "Samples"); an iso-surface looks at the entry, -1, and the exit too. */
typedef struct tile {
    float start[3][RAYS], direction[3][RAYS]; /* voxels from the first, per mm */
    float begin[RAYS];                        /* the next sample to look for stretches from */
    float end[RAYS];                          /* behind the last one */
    float count[RAYS], last_piece[RAYS];      /* samples; mm of the last one */
    float taken[RAYS];
    float state[RAYS + 1]; /* opacity, extreme, sum or hit so far */
    float light[RAYS + 1][4];
    float from[RAYS][STRETCHES], to[RAYS][STRETCHES];
    int stretches[RAYS];
    int active[RAYS + LANES], actives; /* rays not yet at their ends */
} tile;

/* Adds the light of LANES samples, of which `added` arrives, each to its ray. Colours are in `light`, whose last takes
 * `added`; lanes may share a ray. */
INLINE void add_to_rays(tile *t, lanes_int ray, lanes added, lanes light[4]) {
    for (int c = 0; c < 3; c++) light[c] *= added;
    light[3] = added;
    float each[4 * LANES];
    int whose[LANES];
    lanes_transpose_back(light, each);
    lanes_store_int(whose, ray);
    typedef float four __attribute__((vector_size(16)));
    for (int l = 0; l < LANES; l++) {
        four sum, more;
        memcpy(&sum, t->light[whose[l]], sizeof sum);
        memcpy(&more, each + 4 * l, sizeof more);
        sum += more;
        memcpy(t->light[whose[l]], &sum, sizeof sum);
    }
}

INLINE int ray_x(int ray) { return (ray & 3) | (ray >> 4 & 3) << 2; }
INLINE int ray_y(int ray) { return (ray >> 2 & 3) | (ray >> 6) << 2; }

INLINE lanes_double wide(double x) { return (lanes_double){0} + x; }

/* Cuts the stretches of rays at the clip plane. */
INLINE void cut_rays(const ang_ray_frame *frame, const lanes_double start[3], const lanes_double direction[3],
                     lanes_double *enter, lanes_double *leave) {
    const double gradient[3] = {frame->beyond.gradient.x, frame->beyond.gradient.y, frame->beyond.gradient.z};
    lanes_double beyond = wide(frame->beyond.constant), rate = wide(0);
    for (int axis = 0; axis < 3; axis++) {
        beyond += gradient[axis] * start[axis];
        rate += gradient[axis] * direction[axis];
    }
    lanes_long along = rate == 0;
    lanes_double at = -beyond / lanes_pick_double(along, wide(1), rate);
    *enter = lanes_pick_double((rate < 0) & (at > *enter), at, *enter);
    *leave = lanes_pick_double((rate > 0) & (at < *leave), at, *leave);
    *leave = lanes_pick_double(along & (beyond > 0), wide(-INFINITY), *leave);
}

/* ang_ray_through for the rays from `first` on of the tile at (x0, y0). */
INLINE void make_rays(const ang_cast *cast, tile *t, int x0, int y0, int first) {
    const ang_ray_frame *frame = &cast->frame;
    const double origin[3] = {frame->origin.x, frame->origin.y, frame->origin.z};
    const double centre[3] = {frame->centre.x, frame->centre.y, frame->centre.z};
    const double lower[3] = {frame->lower.x, frame->lower.y, frame->lower.z};
    const double upper[3] = {frame->upper.x, frame->upper.y, frame->upper.z};
    const double step_x[3] = {frame->step_x.x, frame->step_x.y, frame->step_x.z};
    const double step_y[3] = {frame->step_y.x, frame->step_y.y, frame->step_y.z};
    const double step_x_mm[3] = {frame->step_x_mm.x, frame->step_x_mm.y, frame->step_x_mm.z};
    const double step_y_mm[3] = {frame->step_y_mm.x, frame->step_y_mm.y, frame->step_y_mm.z};
    const double axis_mm[3] = {frame->axis_mm.x, frame->axis_mm.y, frame->axis_mm.z};
    bool spread = frame->perspective;
    ang_vec3 from = spread ? ang_vec3_sub(frame->origin, frame->eye) : frame->axis;
    ang_vec3 from_mm = spread ? ang_vec3_sub(frame->origin_mm, frame->eye_mm) : frame->axis_mm;
    const double along[3] = {from.x, from.y, from.z}, along_mm[3] = {from_mm.x, from_mm.y, from_mm.z};

    lanes_double x, y, leave;
    for (int l = 0; l < LANES; l++) {
        int px = x0 + ray_x(first + l), py = y0 + ray_y(first + l);
        bool inside = px < cast->width && py < cast->height;
        x[l] = px + 0.5;
        y[l] = py + 0.5;
        leave[l] = !inside          ? -INFINITY
                   : cast->limit_mm ? (double)cast->limit_mm[(size_t)py * (size_t)cast->width + (size_t)px]
                                    : INFINITY;
    }
    lanes_double squared = wide(0), depth = wide(0), direction[3], start[3];
    for (int axis = 0; axis < 3; axis++) {
        lanes_double mm = wide(along_mm[axis]), index = wide(along[axis]);
        if (spread) {
            mm += x * step_x_mm[axis] + y * step_y_mm[axis];
            index += x * step_x[axis] + y * step_y[axis];
        }
        squared += mm * mm;
        depth += mm * axis_mm[axis];
        direction[axis] = index;
        start[axis] = origin[axis] + x * step_x[axis] + y * step_y[axis];
    }
    lanes_double scale = 1 / lanes_sqrt_double(squared), enter = frame->near_depth / (depth * scale);
    for (int axis = 0; axis < 3; axis++) {
        direction[axis] *= scale;
        lanes_double d = direction[axis], low = lower[axis] - start[axis], high = upper[axis] - start[axis];
        lanes_long still = d == 0, misses = still & ((low > 0) | (high < 0));
        d = lanes_pick_double(still, wide(1), d);
        lanes_double t0 = low / d, t1 = high / d;
        lanes_double near = lanes_pick_double(t0 < t1, t0, t1), far = lanes_pick_double(t0 < t1, t1, t0);
        near = lanes_pick_double(still, enter, near);
        far = lanes_pick_double(still, leave, far);
        enter = lanes_pick_double(near > enter, near, enter);
        leave = lanes_pick_double(far < leave, far, leave);
        leave = lanes_pick_double(misses, wide(-INFINITY), leave);
    }
    if (frame->cuts) cut_rays(frame, start, direction, &enter, &leave);
    for (int axis = 0; axis < 3; axis++) {
        lanes_store(t->start[axis] + first, lanes_narrow(start[axis] + enter * direction[axis] + centre[axis]));
        lanes_store(t->direction[axis] + first, lanes_narrow(direction[axis]));
    }
    bool ends = cast->kind == ANG_CAST_SURFACE;
    for (int l = 0; l < LANES; l++) {
        int ray = first + l;
        double reach = leave[l] - enter[l];
        /* A remainder below a thousandth of a step joins the piece before it (lattice.glsl). */
        double count = reach > 0 ? fmax(1, ceil(reach / (double)cast->step - 1e-3)) : 0;
        t->count[ray] = (float)count;
        t->last_piece[ray] = reach > 0 ? (float)(reach - (count - 1) * (double)cast->step) : 0;
        t->begin[ray] = ends && count > 0 ? -1 : 0;
        t->end[ray] = (float)(ends && count > 0 ? count + 1 : count);
        if (count > 0) t->active[t->actives++] = ray;
    }
}

/* Where sample `i` lies, mm from the entry, and the mm that it stands for. */
INLINE lanes place_of(const ang_cast *cast, lanes i, lanes count, lanes last_piece, lanes *piece) {
    *piece = lanes_pick(i + 1 < count, lanes_all(cast->step), last_piece);
    lanes along = i * cast->step + 0.5f * *piece;
    if (cast->kind != ANG_CAST_SURFACE) return along;
    lanes reach = (count - 1) * cast->step + last_piece;
    return lanes_max(lanes_min(along, reach), lanes_all(0));
}

/* Where step `i` ends, mm from the entry; before the first one the entry. */
INLINE lanes end_of(const ang_cast *cast, lanes i, lanes count, lanes last_piece) {
    return lanes_pick(i + 1 < count, (i + 1) * cast->step, (count - 1) * cast->step + last_piece);
}

/* How a ray goes through blocks. */
typedef struct stride {
    lanes rate[3];      /* samples from one voxel to the next, signed */
    lanes_int ahead[3]; /* whether it goes towards the last voxel */
} stride;

INLINE stride make_stride(const ang_cast *cast, const lanes direction[3]) {
    stride s;
    for (int axis = 0; axis < 3; axis++) {
        lanes along = direction[axis] * cast->step;
        along = lanes_pick(lanes_abs(along) < 1e-9f, lanes_all(1e-9f), along);
        s.ahead[axis] = along >= 0;
        s.rate[axis] = 1 / along;
    }
    return s;
}

/* Samples from the one at `place`, in `cell`, to the first that may lie outside its block of 2^shift cells a side and
 * the cube of such blocks up to `around` blocks away; at least 1. */
INLINE lanes steps_out(const ang_cast *cast, const stride *s, const lanes place[3], const lanes_int cell[3],
                       lanes_int shift, lanes_int around) {
    lanes least = lanes_all(1e30f);
    for (int axis = 0; axis < 3; axis++) {
        /* From an axis of one voxel no ray leaves. */
        if (cast->last[axis] == 0) continue;
        lanes_int block = cell[axis] >> shift;
        lanes_int face = lanes_pick_int(s->ahead[axis], block + around + 1, block - around) << shift;
        lanes way = lanes_float(face) - place[axis];
        least = lanes_min(least, way * s->rate[axis] - cast->room * lanes_abs(s->rate[axis]));
    }
    least = lanes_max(lanes_min(least - 1e-3f, lanes_all(1e6f)), lanes_all(0));
    return lanes_float(lanes_truncate(least)) + 1;
}

INLINE lanes_int node_of(const int dims[3], lanes_int shift, const lanes_int cell[3]) {
    return (cell[0] >> shift) + dims[0] * ((cell[1] >> shift) + dims[1] * (cell[2] >> shift));
}

/* Whether no better extreme would look different. */
INLINE lanes_int is_enough(const ang_cast *cast, ang_cast_kind kind, lanes best) {
    return kind == ANG_CAST_HIGHEST ? best >= cast->enough : best <= cast->enough;
}

/* Whether a range has something that looks better than the best so far. Interpolation may go beyond the voxels by a
 * unit in the last place. */
INLINE lanes_int is_better(const ang_cast *cast, ang_cast_kind kind, lanes_int range, lanes best) {
    lanes_int better =
        kind == ANG_CAST_HIGHEST ? high_of(range) * (1 + 1e-6f) > best : low_of(range) * (1 - 1e-6f) < best;
    return better & ~is_enough(cast, kind, best);
}

/* The rays active[first..] of a tile. */
typedef struct group {
    int count;
    lanes_int ray, active;
    lanes start[3], direction[3], i, end, samples, last_piece;
    stride stride;
} group;

INLINE group make_group(const ang_cast *cast, const tile *t, int first) {
    group g;
    g.count = t->actives - first < LANES ? t->actives - first : LANES;
    for (int l = 0; l < LANES; l++) g.ray[l] = t->active[first + (l < g.count ? l : 0)];
    for (int axis = 0; axis < 3; axis++) {
        g.start[axis] = lanes_floats(t->start[axis], g.ray);
        g.direction[axis] = lanes_floats(t->direction[axis], g.ray);
    }
    g.stride = make_stride(cast, g.direction);
    g.i = lanes_floats(t->begin, g.ray);
    g.end = lanes_floats(t->end, g.ray);
    g.samples = lanes_floats(t->count, g.ray);
    g.last_piece = lanes_floats(t->last_piece, g.ray);
    g.active = (lanes_number() < g.count) & (g.i < g.end);
    return g;
}

/* Where the rays' samples lie, or where their steps begin. */
INLINE void place_group(const ang_cast *cast, const group *g, bool whole, lanes place[3], lanes_int cell[3]) {
    lanes piece, along = place_of(cast, g->i, g->samples, g->last_piece, &piece);
    if (whole) along = g->i * cast->step;
    for (int axis = 0; axis < 3; axis++) place[axis] = g->start[axis] + along * g->direction[axis];
    spot at = find_spot(cast, place);
    for (int axis = 0; axis < 3; axis++) cell[axis] = at.cell[axis];
}

/* For modes that show an extreme: the one stretch of each ray in the block with the best range. What is found there
 * spares most of the other blocks. */
INLINE void find_peaks(const ang_cast *cast, tile *t, int first, ang_cast_kind kind) {
    const ang_cast_ranges *ranges = &cast->ranges[1];
    group g = make_group(cast, t, first);
    lanes best = lanes_floats(t->state, g.ray), from = lanes_all(0), to = lanes_all(0);
    lanes_int shift = lanes_all_int(ranges->shift);
    while (lanes_bits(g.active)) {
        lanes place[3];
        lanes_int cell[3];
        place_group(cast, &g, false, place, cell);
        lanes_int range = lanes_ints(ranges->nodes, node_of(ranges->dims, shift, cell));
        lanes_int better = is_better(cast, kind, range, best) & g.active;
        lanes next = g.i + steps_out(cast, &g.stride, place, cell, shift, lanes_all_int(0));
        best = lanes_pick(better, kind == ANG_CAST_HIGHEST ? high_of(range) : low_of(range), best);
        from = lanes_pick(better, g.i, from);
        to = lanes_pick(better, lanes_min(next, g.end), to);
        g.i = next;
        g.active &= g.i < g.end;
    }
    for (int l = 0; l < g.count; l++) {
        int ray = g.ray[l];
        t->from[ray][0] = from[l];
        t->to[ray][0] = to[l];
        t->stretches[ray] = from[l] < to[l];
    }
}

/* Whether the steps that begin at `place` may touch a block that shows, judged by where they end: blocks around that
 * one are all that steps shorter than a block touch. */
INLINE lanes_int may_cross(const ang_cast *cast, const group *g, const lanes place[3]) {
    lanes end[3];
    lanes_int longer = lanes_all_int(0);
    for (int axis = 0; axis < 3; axis++) {
        end[axis] = place[axis] + cast->step * g->direction[axis];
        longer |= lanes_abs(cast->step * g->direction[axis]) > 0.95f * (1 << BLOCK_SHIFT);
    }
    spot at = find_spot(cast, end);
    return longer | (lanes_bytes(cast->distance, node_of(cast->blocks, lanes_all_int(BLOCK_SHIFT), at.cell)) < 2);
}

/* Looks for stretches of the rays active[first..], up to STRETCHES of each. `kind` is a constant. */
INLINE void find_stretches(const ang_cast *cast, tile *t, int first, ang_cast_kind kind) {
    bool extreme = kind == ANG_CAST_HIGHEST || kind == ANG_CAST_LOWEST;
    const ang_cast_ranges *fine = &cast->ranges[0], *coarse = &cast->ranges[2];
    group g = make_group(cast, t, first);
    lanes best = lanes_floats(t->state, g.ray), from = g.i;
    lanes_int inside = lanes_all_int(0), found = lanes_all_int(0);
    while (lanes_bits(g.active)) {
        lanes place[3];
        lanes_int cell[3], shift = lanes_all_int(BLOCK_SHIFT);
        place_group(cast, &g, is_whole(kind), place, cell);
        lanes_int block = node_of(cast->blocks, shift, cell);
        lanes_int distance = lanes_bytes(cast->distance, block), shows = distance == 0;
        if (extreme) {
            lanes_int coarse_shift = lanes_all_int(coarse->shift);
            lanes_int range = lanes_ints(coarse->nodes, node_of(coarse->dims, coarse_shift, cell));
            lanes_int worth = is_better(cast, kind, range, best);
            shows &= worth & is_better(cast, kind, lanes_ints(fine->nodes, block), best);
            shift = lanes_pick_int(worth | (distance > 0), shift, coarse_shift);
        }
        lanes steps = steps_out(cast, &g.stride, place, cell, shift, distance + (distance > 0));
        if (is_whole(kind)) {
            /* Only those steps are passed over that also end among blocks that do not show. */
            lanes_int crosses = (distance > 0) & (steps < 2);
            if (lanes_bits(crosses & g.active)) crosses &= may_cross(cast, &g, place);
            steps = lanes_pick((distance > 0) & ~crosses, lanes_max(steps - 1, lanes_all(1)), steps);
            shows |= crosses;
        }
        shows &= g.active;
        lanes_int begins = shows & ~inside, ends = inside & ~shows & g.active;
        from = lanes_pick(begins, g.i, from);
        for (unsigned bits = lanes_bits(ends); bits; bits &= bits - 1) {
            int l = __builtin_ctz(bits), r = g.ray[l];
            t->from[r][found[l]] = from[l];
            t->to[r][found[l]] = g.i[l];
        }
        found -= ends;
        inside = lanes_pick_int(g.active, shows, inside);
        g.active &= found < STRETCHES;
        g.i = lanes_pick(g.active, g.i + steps, g.i);
        g.active &= g.i < g.end;
    }
    for (int l = 0; l < g.count; l++) {
        int r = g.ray[l];
        if (inside[l]) {
            t->from[r][found[l]] = from[l];
            t->to[r][found[l]] = g.end[l];
            found[l]++;
        }
        t->stretches[r] = found[l];
        t->begin[r] = g.i[l];
    }
}

/* Every sample of every active ray. */
INLINE void take_all(tile *t) {
    for (int a = 0; a < t->actives; a++) {
        int ray = t->active[a];
        t->from[ray][0] = t->begin[ray];
        t->to[ray][0] = t->begin[ray] = t->end[ray];
        t->stretches[ray] = 1;
    }
}

INLINE void keep_unfinished(tile *t) {
    int kept = 0;
    for (int a = 0; a < t->actives; a++)
        if (t->begin[t->active[a]] < t->end[t->active[a]]) t->active[kept++] = t->active[a];
    t->actives = kept;
}

static void put_pixel(const ang_cast *cast, const tile *t, int ray, size_t pixel) {
    float *rgba = cast->rgba + 4 * pixel;
    if (cast->counts) cast->counts[pixel] = t->taken[ray];
    if (!(t->count[ray] > 0)) {
        memset(rgba, 0, 4 * sizeof *rgba);
        return;
    }
    switch (cast->kind) {
    case ANG_CAST_LIGHT:
    case ANG_CAST_LIGHT_PHONG:
    case ANG_CAST_WHOLE:
    case ANG_CAST_WHOLE_PHONG:
        memcpy(rgba, t->light[ray], 3 * sizeof *rgba);
        rgba[3] = t->state[ray];
        return;
    case ANG_CAST_SURFACE:
        memcpy(rgba, t->light[ray], 4 * sizeof *rgba);
        return;
    case ANG_CAST_HIGHEST:
    case ANG_CAST_LOWEST:
    case ANG_CAST_MEAN:
    case ANG_CAST_MEAN_WEIGHTED:
        break;
    }
    float grey = fminf(fmaxf((t->state[ray] - cast->window_lower) * cast->window_scale, 0), 1);
    rgba[0] = rgba[1] = rgba[2] = grey;
    rgba[3] = 1;
}

/* What the rays of the tile at (x, y) have come to, and what that took. */
INLINE void put_tile(const ang_cast *cast, const tile *t, int x, int y, ang_cast_took *took) {
    for (int ray = 0; ray < RAYS; ray++) {
        int px = x + ray_x(ray), py = y + ray_y(ray);
        if (px >= cast->width || py >= cast->height) continue;
        put_pixel(cast, t, ray, (size_t)py * (size_t)cast->width + (size_t)px);
        took->samples += (uint64_t)t->taken[ray];
        took->rays += t->taken[ray] > 0;
    }
}

#endif
