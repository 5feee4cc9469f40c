#include "tests/core/fixtures.h"

#include "core/proxy/proxy.h"

#include <float.h>

enum { proxy_count = 4, most_points = 3 * ANG_PROXY_MOST_TRIANGLES };

typedef struct polygon {
    int count;
    ang_vec3 triangle[ANG_PROXY_MOST_TRIANGLES][3];
} polygon;

typedef struct flat_point {
    double u, v;
} flat_point;

/* A plane through a box, and what the tests know of it without asking the module. Polygons are looked at in the box's
 * unit cube along the axis in which depth rises most: an affine picture of the plane that multiplies every area by one
 * known factor, and in which no box is long and no plane is grazing. */
typedef struct cut {
    ang_vec3 lower, upper, gradient;
    double depth;
    ang_slicer slicer;
    double rise[3];                /* of depth along each axis of the box, signed */
    int along, u, v;               /* `along` rises most; the others in cyclic order */
    double below;                  /* depth of the plane below the box's least depth */
    double depth_error;            /* what rounding may do to a depth */
    double place_error;            /* what it may do to a coordinate in the unit cube */
    double area, area_error;       /* expected, of the section in the picture, at most 1 */
    polygon polygons[proxy_count]; /* what each proxy gives */
} cut;

static double at(ang_vec3 p, int axis) { return ang_vec3_at(p, axis); }

static double in_cube(const cut *c, ang_vec3 p, int axis) {
    return (at(p, axis) - at(c->lower, axis)) / (at(c->upper, axis) - at(c->lower, axis));
}

static flat_point flatten(const cut *c, ang_vec3 p) { return (flat_point){in_cube(c, p, c->u), in_cube(c, p, c->v)}; }

/* Twice the area of a triangle, positive where it turns counter-clockwise. */
static double turn(flat_point a, flat_point b, flat_point c) {
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

static double clamp(double x, double low, double high) { return fmin(fmax(x, low), high); }

/* The section of the unit cube at s, seen along the first axis, is the density of X + b Y + c Z at s for uniform X, Y,
 * Z in 0..1; 1 >= b >= c >= 0. That of X + b Y is a trapezium of the height 1; Z averages it over the width c. No
 * differences of powers: it keeps its digits for every b and c. */
static double trapezium(double s, double b) {
    if (b < DBL_EPSILON) return 1; /* wherever the box is cut at all */
    return clamp(fmin(s, 1 + b - s) / b, 0, 1);
}

static double section(double s, double b, double c) {
    if (c < 1e-10 * b || c < DBL_EPSILON) return trapezium(s, b);
    double kink[4] = {0, b, 1, 1 + b}, start = s - c, sum = 0, from = 0;
    for (int i = 0; i <= 4; i++) {
        double to = i < 4 ? clamp(kink[i] - start, 0, c) : c;
        sum += (to - from) * (trapezium(start + from, b) + trapezium(start + to, b)) / 2;
        from = to;
    }
    return sum / c;
}

static void expect(cut *c) {
    long double least = 0;
    double size_error = 0, scale = 0;
    c->along = 0;
    for (int axis = 0; axis < 3; axis++) {
        double g = at(c->gradient, axis), low = at(c->lower, axis), high = at(c->upper, axis);
        c->rise[axis] = g * (high - low);
        if (fabs(c->rise[axis]) > fabs(c->rise[c->along])) c->along = axis;
        least += fminl((long double)g * low, (long double)g * high);
        double largest = fmax(fabs(low), fabs(high));
        scale += fabs(g) * largest;
        size_error = fmax(size_error, largest / (high - low));
    }
    c->u = (c->along + 1) % 3;
    c->v = (c->along + 2) % 3;
    c->below = (double)((long double)c->depth - least);
    c->depth_error = 8 * DBL_EPSILON * scale;
    double most = fabs(c->rise[c->along]), b = fabs(c->rise[c->u]) / most, d = fabs(c->rise[c->v]) / most;
    c->place_error = 8 * DBL_EPSILON * size_error;
    c->area = section(c->below / most, fmax(b, d), fmin(b, d));
    c->area_error = 1e-10 + 32 * c->place_error;
    if (fmax(b, d) > 0) c->area_error += c->depth_error / most / fmax(b, d);
}

static double signed_unit(uint64_t *seed) { return 2 * random_unit(seed) - 1; }
static int choose(uint64_t *seed, int count) { return (int)(count * random_unit(seed)); }
static double power_of_ten(uint64_t *seed, double low, double high) {
    return pow(10, low + (high - low) * random_unit(seed));
}

static void random_box(uint64_t *seed, cut *c) {
    static const double others[4] = {8, 1, 1e3, 1e-3}; /* the last two: 1:1000:1000 and 1000:1:1 */
    int shape = choose(seed, 5), odd = choose(seed, 3);
    double low[3], high[3], scale = shape == 0 ? 1 : power_of_ten(seed, -6, 6);
    for (int axis = 0; axis < 3; axis++) {
        double size = shape == 4 ? 0.01 + random_unit(seed) : shape > 0 && axis == odd ? 1 : others[shape];
        low[axis] = scale * (shape == 3 ? -size / 2 : 4 * signed_unit(seed));
        if (shape == 0) low[axis] = 8 * choose(seed, 64) - 255.5; /* a brick of a volume about its centre */
        high[axis] = low[axis] + scale * size;
    }
    c->lower = (ang_vec3){low[0], low[1], low[2]};
    c->upper = (ang_vec3){high[0], high[1], high[2]};
}

static void random_gradient(uint64_t *seed, cut *c) {
    double g[3];
    int kind = choose(seed, 6), odd = choose(seed, 3);
    double scale = power_of_ten(seed, -6, 6);
    for (int axis = 0; axis < 3; axis++) {
        double size = at(c->upper, axis) - at(c->lower, axis), sign = choose(seed, 2) ? 1 : -1;
        g[axis] = signed_unit(seed);
        if (kind == 1 && axis != odd) g[axis] = choose(seed, 2) ? 0 : -0.0; /* along an axis */
        if (kind == 2 && axis == odd) g[axis] = 0;                          /* along a face */
        if (kind == 3 && axis != odd) g[axis] = sign * 0.7;                 /* equal components */
        if (kind == 4) g[axis] = sign / size;                               /* along the diagonal of the box */
        if (kind == 5) g[axis] = sign * power_of_ten(seed, -9, 0) / size;   /* grazing faces and edges */
        g[axis] *= scale;
    }
    c->gradient = (ang_vec3){g[0], g[1], g[2]};
}

/* False where it is not inside the box's range of depths. Half are at corners or as close to them as doubles come. */
static bool random_depth(uint64_t *seed, cut *c) {
    const double *depth = c->slicer.depth;
    double least = depth[c->slicer.front], greatest = depth[c->slicer.front ^ 7], corner = depth[choose(seed, 8)];
    int kind = choose(seed, 8);
    c->depth = kind < 4 ? corner : least + (greatest - least) * random_unit(seed);
    if (kind == 1) c->depth = nextafter(corner, INFINITY);
    if (kind == 2) c->depth = nextafter(corner, -INFINITY);
    if (kind == 3) c->depth += (greatest - least) * signed_unit(seed) * power_of_ten(seed, -14, -3);
    return least < c->depth && c->depth < greatest;
}

static void slice(cut *c, const ang_proxy_tables *tables) {
    for (int proxy = 0; proxy < proxy_count; proxy++)
        c->polygons[proxy].count =
            ang_proxy_slice(tables, (ang_proxy)proxy, &c->slicer, c->depth, c->polygons[proxy].triangle);
}

static void random_cut(uint64_t *seed, const ang_proxy_tables *tables, cut *c) {
    do {
        random_box(seed, c);
        random_gradient(seed, c);
        ang_slicer_make(&c->slicer, c->lower, c->upper, c->gradient);
    } while (!random_depth(seed, c));
    expect(c);
    slice(c, tables);
}

static void describe(const cut *c, int proxy) {
    print_message("%s: box %.17g %.17g %.17g to %.17g %.17g %.17g, gradient %.17g %.17g %.17g, depth %.17g\n",
                  ang_proxy_name((ang_proxy)proxy), c->lower.x, c->lower.y, c->lower.z, c->upper.x, c->upper.y,
                  c->upper.z, c->gradient.x, c->gradient.y, c->gradient.z, c->depth);
}

#define assert_of(c, proxy, condition)                                                                                 \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            describe((c), (proxy));                                                                                    \
            fail_msg("%s", #condition);                                                                                \
        }                                                                                                              \
    } while (0)

static int make_tables(void **state) {
    static ang_proxy_tables tables;
    ang_proxy_tables_make(&tables);
    *state = &tables;
    return 0;
}

static void names_lead_there_and_back(void **state) {
    (void)state;
    for (int proxy = 0; proxy < proxy_count; proxy++)
        assert_int_equal(ang_proxy_from_name(ang_proxy_name((ang_proxy)proxy)), proxy);
    assert_int_equal(ang_proxy_from_name("convex-hull"), ANG_PROXY_CONVEX_HULL);
    assert_int_equal(ang_proxy_from_name("spheres"), -1);
    assert_null(ang_proxy_name((ang_proxy)proxy_count));
}

/* Edge and corner numbers from the coordinates that the paper's Algorithm 2 gives to each edge. */
static void edge_ends(int edge, int ends[2]) {
    int axis = edge / 4, first = edge >> 1 & 1, second = edge & 1;
    int other = axis == 0 ? 1 : 0, last = axis == 2 ? 1 : 2;
    ends[0] = first << other | second << last;
    ends[1] = ends[0] | 1 << axis;
}

static ang_vec3 cube_corner(int c) { return (ang_vec3){c & 1, c >> 1 & 1, c >> 2 & 1}; }

static bool share_a_face(const int a[2], const int b[2]) {
    int all = a[0] & a[1] & b[0] & b[1], any = a[0] | a[1] | b[0] | b[1];
    return all != 0 || any != 7;
}

static void table_has_the_rows_that_the_paper_prints(void **state) {
    const ang_proxy_tables *tables = *state;
    static const struct {
        int key;
        int8_t edges[8];
    } printed[] = {{0, {-1, -1, -1, -1, -1, -1, -1, -1}},  {1, {4, 8, 0, -1, -1, -1, -1, -1}},
                   {174, {1, 3, 9, 4, 0, -1, -1, -1}},     {175, {3, 9, 8, 1, -1, -1, -1, -1}},
                   {176, {3, 11, 10, 8, 5, -1, -1, -1}},   {254, {4, 0, 8, -1, -1, -1, -1, -1}},
                   {255, {-1, -1, -1, -1, -1, -1, -1, -1}}};
    for (size_t i = 0; i < sizeof printed / sizeof *printed; i++)
        assert_memory_equal(tables->edges[printed[i].key], printed[i].edges, 8);
}

static void every_row_is_one_loop_with_the_shallow_side_above(void **state) {
    const ang_proxy_tables *tables = *state;
    int loops = 0;
    for (int key = 0; key < 256; key++) {
        const int8_t *row = tables->edges[key];
        int count = 0, cut_edges = 0, seen = 0;
        while (row[count] >= 0) count++;
        for (int i = count; i < 8; i++) assert_int_equal(row[i], -1);
        if (count == 0) continue;
        loops++;
        ang_vec3 middle[8], up = {0, 0, 0}, area = {0, 0, 0};
        for (int edge = 0; edge < 12; edge++) {
            int ends[2];
            edge_ends(edge, ends);
            cut_edges += (key >> ends[0] & 1) != (key >> ends[1] & 1);
        }
        for (int i = 0; i < count; i++) {
            int ends[2], next[2];
            edge_ends(row[i], ends);
            edge_ends(row[(i + 1) % count], next);
            seen |= 1 << row[i];
            assert_true((key >> ends[0] & 1) != (key >> ends[1] & 1));
            assert_true(share_a_face(ends, next));
            int deep = key >> ends[0] & 1 ? ends[0] : ends[1], shallow = ends[0] + ends[1] - deep;
            ang_vec3 a = cube_corner(deep), b = cube_corner(shallow);
            middle[i] = ang_vec3_scale(ang_vec3_add(a, b), 0.5);
            up = ang_vec3_add(up, ang_vec3_sub(b, a));
        }
        for (int i = 0; i < count; i++) area = ang_vec3_add(area, ang_vec3_cross(middle[i], middle[(i + 1) % count]));
        assert_true(ang_vec3_dot(area, up) > 0);
        assert_int_equal(__builtin_popcount((unsigned)seen), count);
        assert_int_equal(cut_edges, count);
    }
    print_message("marching cubes: %d keys with one loop, %d without a polygon\n", loops, 256 - loops);
    assert_int_equal(loops, 126);
}

static bool closed_away_from(int key, int front) {
    for (int c = 0; c < 8; c++)
        for (int bit = 1; bit < 8; bit <<= 1)
            if (!((c ^ front) & bit) && (key >> c & 1) && !(key >> (c ^ bit) & 1)) return false;
    return true;
}

static void every_key_that_a_plane_can_make_has_a_row(void **state) {
    const ang_proxy_tables *tables = *state;
    int distinct = 0, all = 0;
    for (int key = 0; key < 256; key++) {
        int fronts = 0;
        for (int front = 0; front < 8; front++) fronts += closed_away_from(key, front);
        all += fronts;
        distinct += fronts > 0;
        if (fronts > 0 && key != 0 && key != 255) assert_true(tables->edges[key][2] >= 0);
    }
    print_message("keys of planes: %d over the eight front corners, %d distinct, two of them empty\n", all, distinct);
    assert_int_equal(all, 160); /* 8 times Dedekind's number for three */
    assert_int_equal(distinct, 104);
}

static void paths_of_the_vertex_program_are_right_handed(void **state) {
    const ang_proxy_tables *tables = *state;
    for (int front = 0; front < 8; front++) {
        const int *sequence = tables->sequence[front];
        int seen = 0;
        for (int i = 0; i < 8; i++) seen |= 1 << sequence[i];
        assert_int_equal(seen, 255);
        assert_int_equal(sequence[0], front);
        assert_int_equal(sequence[7], front ^ 7);
        for (int i = 0; i < 24; i++) {
            int step = sequence[tables->v1[i]] ^ sequence[tables->v2[i]];
            assert_true(step == 1 || step == 2 || step == 4);
            assert_false((sequence[tables->v1[i]] ^ front) & step);
        }
        for (int point = 0; point < 6; point += 2) {
            ang_vec3 edge[3];
            for (int e = 0; e < 3; e++) {
                int a = sequence[tables->v1[4 * point + e]], b = sequence[tables->v2[4 * point + e]];
                edge[e] = ang_vec3_sub(cube_corner(b), cube_corner(a));
            }
            assert_close(ang_vec3_dot(ang_vec3_cross(edge[0], edge[1]), edge[2]), 1, 0);
        }
    }
}

static double picture_area(const cut *c, const polygon *p, double *smallest) {
    /* Seen from the shallow side: against the axis where depth rises with it. */
    double sign = c->rise[c->along] > 0 ? -0.5 : 0.5, sum = 0;
    *smallest = INFINITY;
    for (int t = 0; t < p->count; t++) {
        double area =
            sign * turn(flatten(c, p->triangle[t][0]), flatten(c, p->triangle[t][1]), flatten(c, p->triangle[t][2]));
        *smallest = fmin(*smallest, area);
        sum += area;
    }
    return sum;
}

static bool lies_in_box_and_plane(const cut *c, ang_vec3 p) {
    double below = 0, slack = c->depth_error;
    for (int axis = 0; axis < 3; axis++) {
        double x = in_cube(c, p, axis);
        if (!(x >= -c->place_error && x <= 1 + c->place_error)) return false;
        below += fabs(c->rise[axis]) * (c->rise[axis] < 0 ? 1 - x : x);
        slack += fabs(c->rise[axis]) * c->place_error;
    }
    return fabs(below - c->below) <= slack;
}

static bool depths_never_fall(const ang_slicer *slicer) {
    for (int step = 0; step < 8; step++)
        for (int bit = 1; bit < 8; bit <<= 1)
            if (!(step & bit) && !(slicer->depth[slicer->front ^ step] <= slicer->depth[slicer->front ^ step ^ bit]))
                return false;
    return true;
}

static void a_million_planes_have_the_area_of_the_formula(void **state) {
    const ang_proxy_tables *tables = *state;
    uint64_t seed = 20050914;
    double worst = 0;
    int resolved = 0, through_corners = 0;
    enum { planes = 1000000 };
    for (int i = 0; i < planes; i++) {
        cut c;
        random_cut(&seed, tables, &c);
        assert_of(&c, 0, depths_never_fall(&c.slicer));
        bool clear = c.area_error < 1e-5;
        resolved += clear;
        bool through = false;
        for (int k = 0; k < 8; k++) through |= c.slicer.depth[k] == c.depth;
        through_corners += through;
        for (int proxy = 0; proxy < proxy_count; proxy++) {
            const polygon *p = &c.polygons[proxy];
            assert_of(&c, proxy, p->count >= 1 && p->count <= ANG_PROXY_MOST_TRIANGLES);
            double smallest, area = picture_area(&c, p, &smallest), error = fabs(area - c.area);
            assert_of(&c, proxy, error <= c.area_error);
            assert_of(&c, proxy, smallest >= -4 * c.place_error);
            for (int t = 0; t < p->count; t++)
                for (int k = 0; k < 3; k++) assert_of(&c, proxy, lies_in_box_and_plane(&c, p->triangle[t][k]));
            if (clear) worst = fmax(worst, error);
        }
    }
    print_message(
        "%d planes, %d exactly through corners; %d where doubles resolve the area to 1e-5: worst error %.2g of "
        "the largest section\n",
        planes, through_corners, resolved, worst);
    assert_true(resolved > planes * 9 / 10);
}

static int by_place(const void *a, const void *b) {
    const flat_point *p = a, *q = b;
    if (p->u != q->u) return p->u < q->u ? -1 : 1;
    return (p->v > q->v) - (p->v < q->v);
}

/* Andrew's monotone chain; counter-clockwise, `hull` with room for one point more than there are. */
static int convex_hull(flat_point *points, int count, flat_point *hull) {
    qsort(points, (size_t)count, sizeof *points, by_place);
    int size = 0;
    for (int pass = 0, floor = 1; pass < 2; pass++, floor = size) {
        for (int i = pass; i < count; i++) {
            flat_point p = points[pass ? count - 1 - i : i];
            while (size > floor && turn(hull[size - 2], hull[size - 1], p) <= 0) size--;
            hull[size++] = p;
        }
    }
    return size - 1;
}

static double hull_area(const flat_point *hull, int count) {
    double sum = 0;
    for (int i = 1; i + 1 < count; i++) sum += turn(hull[0], hull[i], hull[i + 1]) / 2;
    return sum;
}

static double farthest_outside(const flat_point *hull, int count, flat_point p) {
    double farthest = 0;
    for (int i = 0; i < count; i++) {
        flat_point a = hull[i], b = hull[(i + 1) % count];
        double length = hypot(b.u - a.u, b.v - a.v);
        if (length > 1e-6) farthest = fmax(farthest, -turn(a, b, p) / length);
    }
    return farthest;
}

static bool same(ang_vec3 a, ang_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/* Each directed edge of the triangles is met by its opposite, to the bit, unless it lies in a face of the box (to
 * rounding: where corners coincide, the convex hull may take them in another order). */
static bool edges_meet(const cut *c, const polygon *p) {
    for (int t = 0; t < p->count; t++)
        for (int k = 0; k < 3; k++) {
            ang_vec3 a = p->triangle[t][k], b = p->triangle[t][(k + 1) % 3];
            if (same(a, b)) continue;
            int along = 0, against = 0;
            for (int i = 0; i < p->count; i++)
                for (int j = 0; j < 3; j++) {
                    ang_vec3 d = p->triangle[i][j], e = p->triangle[i][(j + 1) % 3];
                    along += same(a, d) && same(b, e);
                    against += same(a, e) && same(b, d);
                }
            bool in_face = false;
            for (int axis = 0; axis < 3; axis++) {
                double x = in_cube(c, a, axis), y = in_cube(c, b, axis);
                in_face |= fmax(fabs(x), fabs(y)) <= c->place_error || fmax(fabs(1 - x), fabs(1 - y)) <= c->place_error;
            }
            if (along != against && !in_face) return false;
        }
    return true;
}

static bool has_points_of(const polygon *p, const polygon *q) {
    for (int i = 0; i < 3 * q->count; i++) {
        bool found = false;
        for (int k = 0; k < 3 * p->count && !found; k++)
            found = same(p->triangle[k / 3][k % 3], q->triangle[i / 3][i % 3]);
        if (!found) return false;
    }
    return true;
}

static void all_proxies_have_one_outline(void **state) {
    const ang_proxy_tables *tables = *state;
    uint64_t seed = 2005;
    double worst_area = 0, worst_place = 0;
    enum { planes = 100000 };
    for (int i = 0; i < planes; i++) {
        cut c;
        random_cut(&seed, tables, &c);
        flat_point points[proxy_count][most_points], hull[proxy_count][most_points + 1];
        int count[proxy_count];
        double area[proxy_count];
        for (int proxy = 0; proxy < proxy_count; proxy++) {
            const polygon *p = &c.polygons[proxy];
            for (int k = 0; k < 3 * p->count; k++) points[proxy][k] = flatten(&c, p->triangle[k / 3][k % 3]);
            count[proxy] = convex_hull(points[proxy], 3 * p->count, hull[proxy]);
            area[proxy] = hull_area(hull[proxy], count[proxy]);
            double smallest, covered = picture_area(&c, p, &smallest);
            assert_of(&c, proxy, fabs(area[proxy] - covered) <= c.area_error);
            assert_of(&c, proxy, edges_meet(&c, p));
        }
        const polygon *cubes = &c.polygons[ANG_PROXY_MARCHING_CUBES];
        for (int proxy = 0; proxy < proxy_count; proxy++) {
            double far = 0;
            for (int k = 0; k < 3 * c.polygons[proxy].count; k++)
                far = fmax(far, farthest_outside(hull[0], count[0], points[proxy][k]));
            for (int k = 0; k < 3 * c.polygons[0].count; k++)
                far = fmax(far, farthest_outside(hull[proxy], count[proxy], points[0][k]));
            double difference = fabs(area[proxy] - area[0]);
            assert_of(&c, proxy, difference <= c.area_error && far <= c.area_error);
            worst_area = fmax(worst_area, difference);
            worst_place = fmax(worst_place, far);
            /* Tetrahedra have the outline's corners and more. */
            assert_of(&c, proxy, has_points_of(&c.polygons[proxy], cubes));
            if (proxy != ANG_PROXY_MARCHING_TETRAHEDRA) assert_of(&c, proxy, has_points_of(cubes, &c.polygons[proxy]));
        }
    }
    print_message("%d planes: outlines differ by %.2g in area, %.2g in place (unit cube); corners are the same bits\n",
                  planes, worst_area, worst_place);
}

/* 1 in the triangle, 0 outside, -1 too close to an edge to tell. */
static int contains(const flat_point t[3], flat_point p) {
    int positive = 0, negative = 0;
    for (int k = 0; k < 3; k++) {
        flat_point a = t[k], b = t[(k + 1) % 3];
        double side = turn(a, b, p), length = hypot(b.u - a.u, b.v - a.v);
        if (length < 1e-9) return 0; /* without area */
        if (fabs(side) < 1e-9 * length && p.u > fmin(a.u, b.u) - 1e-9 && p.u < fmax(a.u, b.u) + 1e-9 &&
            p.v > fmin(a.v, b.v) - 1e-9 && p.v < fmax(a.v, b.v) + 1e-9)
            return -1;
        positive += side > 0;
        negative += side < 0;
    }
    return positive == 3 || negative == 3;
}

static void every_point_is_covered_once(void **state) {
    const ang_proxy_tables *tables = *state;
    uint64_t seed = 96;
    int64_t inside = 0, outside = 0;
    enum { planes = 5000, places = 40 };
    for (int i = 0; i < planes; i++) {
        cut c;
        random_cut(&seed, tables, &c);
        double sign[3], share[3];
        for (int axis = 0; axis < 3; axis++) {
            sign[axis] = c.rise[axis] < 0;
            share[axis] = fabs(c.rise[axis] / c.rise[c.along]);
        }
        for (int k = 0; k < places; k++) {
            flat_point place = {random_unit(&seed), random_unit(&seed)};
            /* The plane's third coordinate there, from the front. */
            double third = c.below / fabs(c.rise[c.along]) - share[c.u] * fabs(place.u - sign[c.u]) -
                           share[c.v] * fabs(place.v - sign[c.v]);
            if (fabs(third) < 1e-8 || fabs(third - 1) < 1e-8) continue;
            bool expected = third > 0 && third < 1;
            for (int proxy = 0; proxy < proxy_count; proxy++) {
                const polygon *p = &c.polygons[proxy];
                int covers = 0;
                for (int t = 0; t < p->count && covers >= 0; t++) {
                    flat_point triangle[3];
                    for (int j = 0; j < 3; j++) triangle[j] = flatten(&c, p->triangle[t][j]);
                    int here = contains(triangle, place);
                    covers = here < 0 ? -1 : covers + here;
                }
                if (covers < 0) continue;
                assert_of(&c, proxy, covers == expected);
                inside += expected;
                outside += !expected;
            }
        }
    }
    print_message("%lld places in one triangle each, %lld beside the box in none\n", (long long)inside,
                  (long long)outside);
}

static void a_face_in_the_plane_belongs_to_the_box_behind_it(void **state) {
    const ang_proxy_tables *tables = *state;
    for (int axis = 0; axis < 3; axis++)
        for (int sign = -1; sign <= 1; sign += 2) {
            cut c = {.lower = {-3.5, 0.5, 2}, .upper = {4.5, 3.5, 7}};
            *(axis == 0 ? &c.gradient.x : axis == 1 ? &c.gradient.y : &c.gradient.z) = 0.3 * sign;
            ang_slicer_make(&c.slicer, c.lower, c.upper, c.gradient);
            double least = c.slicer.depth[c.slicer.front], greatest = c.slicer.depth[c.slicer.front ^ 7];
            const double missing[] = {greatest, nextafter(least, -INFINITY), greatest + 1, -INFINITY, INFINITY, NAN};
            for (int proxy = 0; proxy < proxy_count; proxy++) {
                c.depth = least;
                expect(&c);
                slice(&c, tables);
                double smallest;
                assert_close(picture_area(&c, &c.polygons[proxy], &smallest), 1, 1e-12);
                for (size_t i = 0; i < sizeof missing / sizeof *missing; i++) {
                    c.depth = missing[i];
                    slice(&c, tables);
                    assert_int_equal(c.polygons[proxy].count, 0);
                }
            }
        }
}

static void boxes_without_extent_are_harmless(void **state) {
    const ang_proxy_tables *tables = *state;
    cut c = {.lower = {0, 0, 5}, .upper = {8, 8, 5}, .gradient = {1, 0.5, 2}};
    ang_slicer_make(&c.slicer, c.lower, c.upper, c.gradient);
    c.depth = 14;
    slice(&c, tables);
    for (int proxy = 0; proxy < proxy_count; proxy++) {
        assert_true(c.polygons[proxy].count > 0);
        for (int k = 0; k < 3 * c.polygons[proxy].count; k++) {
            ang_vec3 p = c.polygons[proxy].triangle[k / 3][k % 3];
            assert_close(ang_vec3_dot(c.gradient, p), 14, 1e-14);
            assert_close(p.z, 5, 0);
        }
    }
    ang_slicer_make(&c.slicer, c.lower, c.upper, (ang_vec3){0, 0, 1}); /* seen flat on: no depth at all */
    c.depth = 5;
    slice(&c, tables);
    for (int proxy = 0; proxy < proxy_count; proxy++) assert_int_equal(c.polygons[proxy].count, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_lead_there_and_back),
        cmocka_unit_test(table_has_the_rows_that_the_paper_prints),
        cmocka_unit_test(every_row_is_one_loop_with_the_shallow_side_above),
        cmocka_unit_test(every_key_that_a_plane_can_make_has_a_row),
        cmocka_unit_test(paths_of_the_vertex_program_are_right_handed),
        cmocka_unit_test(a_million_planes_have_the_area_of_the_formula),
        cmocka_unit_test(all_proxies_have_one_outline),
        cmocka_unit_test(every_point_is_covered_once),
        cmocka_unit_test(a_face_in_the_plane_belongs_to_the_box_behind_it),
        cmocka_unit_test(boxes_without_extent_are_harmless),
    };
    return cmocka_run_group_tests(tests, make_tables, NULL);
}
