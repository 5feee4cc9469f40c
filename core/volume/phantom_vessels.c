#include "core/volume/phantom_parts.h"

#include <stdio.h>
#include <string.h>

/* The tree is drawn for the patient's left; the right is its mirror image, with small branches of its own. */

static double uniform(uint64_t *state) {
    *state = ang_phantom_hash(*state);
    return (double)(*state >> 11) * 0x1p-53;
}
static double spread(uint64_t *state, double amount) { return amount * (2 * uniform(state) - 1); }

ang_vec3 ang_phantom_vessel_at(const ang_phantom_vessel *v, double u, double *radius) {
    int last = v->count - 1, i = u <= 0 ? 0 : u >= last ? last - 1 : (int)u;
    double t = u - i;
    ang_vec3 p1 = v->points[i], p2 = v->points[i + 1];
    ang_vec3 p0 = i > 0 ? v->points[i - 1] : ang_vec3_sub(ang_vec3_scale(p1, 2), p2);
    ang_vec3 p3 = i + 2 <= last ? v->points[i + 2] : ang_vec3_sub(ang_vec3_scale(p2, 2), p1);
    double w0 = ((-t + 2) * t - 1) * t / 2, w1 = ((3 * t - 5) * t * t + 2) / 2;
    double w2 = ((-3 * t + 4) * t + 1) * t / 2, w3 = (t - 1) * t * t / 2;
    if (radius) *radius = v->radii_mm[i] + t * (v->radii_mm[i + 1] - v->radii_mm[i]);
    return ang_vec3_add(ang_vec3_add(ang_vec3_scale(p0, w0), ang_vec3_scale(p1, w1)),
                        ang_vec3_add(ang_vec3_scale(p2, w2), ang_vec3_scale(p3, w3)));
}

static double length_of(const ang_phantom_vessel *v) {
    int steps = 64 * (v->count - 1);
    double length = 0;
    ang_vec3 before = v->points[0];
    for (int i = 1; i <= steps; i++) {
        ang_vec3 here = ang_phantom_vessel_at(v, i / 64.0, NULL);
        length += ang_vec3_length(ang_vec3_sub(here, before));
        before = here;
    }
    return length;
}

/* Adds a vessel whose radius goes from r0 to r1; side -1 mirrors it. NULL where there is no room. */
static ang_phantom_vessel *add(ang_phantom_truth *truth, const char *name, int side, const ang_vec3 *points, int count,
                               double r0, double r1) {
    if (truth->vessel_count >= ang_phantom_max_vessels || count > ang_phantom_max_points) return NULL;
    ang_phantom_vessel *v = &truth->vessels[truth->vessel_count++];
    *v = (ang_phantom_vessel){.arterial = true, .hu = truth->artery_hu, .count = count};
    snprintf(v->name, sizeof v->name, "%s%s", side > 0 ? "left " : side < 0 ? "right " : "", name);
    for (int i = 0; i < count; i++) {
        v->points[i] = points[i];
        if (side < 0) v->points[i].x = -points[i].x;
        v->radii_mm[i] = r0 + (r1 - r0) * i / (count - 1);
    }
    v->length_mm = length_of(v);
    return v;
}
#define ADD(name, side, r0, r1, ...)                                                                                   \
    add(truth, name, side, (const ang_vec3[]){__VA_ARGS__},                                                            \
        (int)(sizeof((ang_vec3[]){__VA_ARGS__}) / sizeof(ang_vec3)), r0, r1)

/* A small branch that wanders over a surface `depth` mm from the inside of the skull (negative: on the brain). */
static void wander(ang_phantom_truth *truth, uint64_t *state, const char *name, int side, ang_vec3 start,
                   ang_vec3 direction, int count, double step, double depth, double r0, double r1) {
    ang_vec3 points[ang_phantom_max_points] = {start};
    direction = ang_vec3_unit(direction);
    for (int i = 1; i < count; i++) {
        ang_vec3 jitter = {spread(state, 0.55), spread(state, 0.55), spread(state, 0.55)};
        ang_vec3 to = ang_vec3_along(points[i - 1], ang_vec3_unit(ang_vec3_add(direction, jitter)),
                                     step * (0.8 + 0.4 * uniform(state)));
        ang_vec3 on = ang_phantom_on_skull(to, depth + spread(state, 0.8));
        double pull = i >= 3 ? 1 : i / 3.0; /* from the parent's depth to the surface */
        points[i] = ang_vec3_along(to, ang_vec3_sub(on, to), pull);
        ang_vec3 went = ang_vec3_unit(ang_vec3_sub(points[i], points[i - 1]));
        direction = ang_vec3_unit(ang_vec3_along(ang_vec3_scale(direction, 0.6), went, 0.6));
    }
    add(truth, name, side, points, count, r0, r1);
}

/* `count` branches off a vessel between u0 and u1 in directions that turn from `from` to `to`. */
static void fan(ang_phantom_truth *truth, uint64_t *state, const char *name, int side, const ang_phantom_vessel *parent,
                double u0, double u1, ang_vec3 from, ang_vec3 to, int count, int points, double depth) {
    if (!parent) return;
    for (int i = 0; i < count; i++) {
        double t = count > 1 ? (double)i / (count - 1) : 0.5, radius;
        ang_vec3 start = ang_phantom_vessel_at(parent, u0 + t * (u1 - u0), &radius);
        if (side < 0) start.x = -start.x; /* wander works on the left, add mirrors back */
        ang_vec3 direction = ang_vec3_add(ang_vec3_scale(from, 1 - t), ang_vec3_scale(to, t));
        char numbered[32];
        snprintf(numbered, sizeof numbered, "%s %d", name, i + 1);
        wander(truth, state, numbered, side, start, direction, points, 9.5, depth, fmax(0.75 * radius, 0.55), 0.5);
    }
}

static void carotid(ang_phantom_truth *truth, uint64_t *state, int side) {
    ADD("common and internal carotid, neck", side, 3.0, 2.5, {24, 8, -150}, {25, 9, -120}, {27, 10, -95}, {29, 8, -72},
        {27, 10, -50}, {25, 6, -32});
    ADD("internal carotid, skull", side, 2.5, 1.9, {25, 6, -32}, {24, 5, -22}, {18, 1, -17}, {13, -3, -14},
        {11, -6, -7}, {12, -13, -3}, {12, -18, 0}, {12, -14, 5}, {12, -8, 8});
    ADD("ophthalmic artery", side, 0.7, 0.5, {12, -17, 2}, {13, -22, 3}, {20, -34, -2}, {27, -48, -4});
    ADD("external carotid", side, 2.2, 1.3, {26, 9, -104}, {32, 4, -88}, {44, 2, -66}, {58, 2, -46}, {70, 2, -24});
    const ang_vec3 end = {70, 2, -24};
    wander(truth, state, "superficial temporal, frontal branch", side, end, (ang_vec3){0.1, -0.5, 1}, 11, 10, 10, 1.2,
           0.6);
    wander(truth, state, "superficial temporal, parietal branch", side, end, (ang_vec3){0.1, 0.45, 1}, 11, 10, 10, 1.1,
           0.6);
    ADD("facial artery", side, 1.2, 0.7, {30, 6, -92}, {42, -14, -98}, {46, -36, -92}, {36, -64, -74}, {22, -82, -56},
        {14, -86, -34});
}

static void middle_cerebral(ang_phantom_truth *truth, uint64_t *state, int side) {
    ADD("middle cerebral M1", side, 1.45, 1.25, {12, -8, 8}, {19, -10, 9}, {27, -9, 9}, {36, -6, 8});
    ang_phantom_vessel *above = ADD("middle cerebral M2, superior", side, 1.15, 0.8, {36, -6, 8}, {40, -3, 15},
                                    {42, 1, 23}, {46, 2, 28}, {53, 0, 30});
    ang_phantom_vessel *below = ADD("middle cerebral M2, inferior", side, 1.15, 0.8, {36, -6, 8}, {41, 0, 9},
                                    {43, 9, 14}, {46, 18, 20}, {54, 26, 24});
    fan(truth, state, "middle cerebral M4, frontal", side, above, 3, 4, (ang_vec3){0.2, -1, 0.2},
        (ang_vec3){0.2, -0.1, 1}, 4, 9, -3);
    fan(truth, state, "middle cerebral M4, parietal", side, below, 3, 4, (ang_vec3){0.2, 0.1, 1},
        (ang_vec3){0.2, 1, 0.2}, 4, 9, -3);
    fan(truth, state, "middle cerebral M4, temporal", side, below, 1.5, 4, (ang_vec3){1, -0.3, -0.6},
        (ang_vec3){0.3, 0.6, -1}, 3, 7, -3);
}

static void anterior_cerebral(ang_phantom_truth *truth, uint64_t *state, int side) {
    ADD("anterior cerebral A1", side, 1.15, 1.05, {12, -8, 8}, {8, -13, 10}, {3, -17, 12});
    ang_phantom_vessel *arch =
        ADD("anterior cerebral A2 and pericallosal", side, 1.05, 0.6, {3, -17, 12}, {2.4, -25, 15}, {2.2, -36, 24},
            {2.2, -38, 36}, {2.2, -26, 47}, {2.2, -6, 53}, {2.2, 16, 53}, {2.4, 34, 47});
    fan(truth, state, "anterior cerebral, frontal", side, arch, 1.6, 4.2, (ang_vec3){0.1, -1, 0.1},
        (ang_vec3){0.15, -0.4, 1}, 4, 7, -3);
    fan(truth, state, "anterior cerebral, parietal", side, arch, 5, 6.6, (ang_vec3){0.15, 0.1, 1},
        (ang_vec3){0.15, 0.8, 0.8}, 2, 7, -3);
}

static void posterior(ang_phantom_truth *truth, uint64_t *state, int side) {
    ADD("vertebral artery", side, 1.9, 1.6, {20, 14, -150}, {19, 20, -120}, {20, 22, -90}, {20, 24, -68}, {27, 28, -60},
        {23, 38, -51}, {13, 38, -46}, {9, 30, -38}, {5, 22, -29}, {0, 17, -21});
    ang_phantom_vessel *cerebral = ADD("posterior cerebral", side, 1.2, 0.75, {0, 8, 4}, {7, 8, 5}, {15, 13, 7},
                                       {20, 24, 9}, {20, 38, 12}, {15, 54, 16}, {10, 72, 20});
    ADD("posterior communicating", side, 0.75, 0.7, {12, -9, 7}, {11, -3, 6}, {10, 3, 5}, {8, 8, 5});
    ADD("superior cerebellar", side, 0.8, 0.5, {0, 8.6, 0.5}, {7, 10, 0}, {15, 16, 0}, {21, 27, 2}, {22, 42, 4},
        {18, 56, 4});
    ADD("anterior inferior cerebellar", side, 0.65, 0.5, {0, 12, -11}, {9, 13, -13}, {19, 18, -14}, {30, 26, -14},
        {40, 38, -14});
    ADD("posterior inferior cerebellar", side, 0.8, 0.5, {7, 26, -34}, {10, 34, -36}, {12, 42, -30}, {9, 48, -22},
        {12, 58, -22}, {20, 70, -20});
    fan(truth, state, "posterior cerebral, occipital", side, cerebral, 4.2, 6, (ang_vec3){0.8, 0.8, -0.4},
        (ang_vec3){0.1, 0.5, 1}, 3, 6, -3);
    fan(truth, state, "posterior cerebral, temporal", side, cerebral, 2.2, 3.6, (ang_vec3){1, -0.2, -0.2},
        (ang_vec3){1, 0.6, -0.2}, 2, 5, -3);
}

static void sinuses(ang_phantom_truth *truth) {
    ang_vec3 points[ang_phantom_max_points];
    const int count = 13;
    for (int i = 0; i < count; i++) { /* along the midline from the forehead to the back */
        double angle = (-75 + 190.0 * i / (count - 1)) * M_PI / 180;
        points[i] = ang_phantom_on_skull((ang_vec3){0, 18 + 80 * sin(angle), 32 + 62 * cos(angle)}, -2.5);
        points[i].x = 0;
    }
    add(truth, "superior sagittal sinus", 0, points, count, 1.5, 4);
    ang_vec3 corner = points[count - 1];
    for (int side = 1; side >= -1; side -= 2) {
        static const ang_vec3 way[] = {{18, 98, 3}, {38, 84, 1}, {54, 60, -3}, {58, 36, -8}};
        points[0] = corner;
        for (int i = 0; i < 4; i++) points[i + 1] = ang_phantom_on_skull(way[i], -3);
        static const ang_vec3 down[] = {{48, 32, -24}, {36, 26, -34}, {32, 18, -46}, {33, 14, -80}, {32, 14, -150}};
        for (int i = 0; i < 5; i++) points[i + 5] = down[i];
        add(truth, "transverse sinus to jugular vein", side, points, 10, 3.5, 4.5);
    }
    for (int i = 0; i < 3; i++) {
        ang_phantom_vessel *v = &truth->vessels[truth->vessel_count - 1 - i];
        v->arterial = false;
        v->hu = truth->vein_hu;
    }
}

static void lesions(ang_phantom_truth *truth) {
    const ang_vec3 fork = {36, -6, 8};
    ang_vec3 outward = ang_vec3_unit((ang_vec3){0.85, -0.45, -0.45});
    truth->aneurysm.diameter_mm = 7;
    truth->aneurysm.neck_mm = 3.4;
    truth->aneurysm.centre = ang_vec3_along(fork, outward, 5);
    snprintf(truth->aneurysm.parent, sizeof truth->aneurysm.parent, "left middle cerebral M1");

    snprintf(truth->stenosis.parent, sizeof truth->stenosis.parent, "right middle cerebral M1");
    for (int i = 0; i < truth->vessel_count; i++) {
        const ang_phantom_vessel *v = &truth->vessels[i];
        if (strcmp(v->name, truth->stenosis.parent) != 0) continue;
        const double u = 1.5;
        double radius;
        truth->stenosis.centre = ang_phantom_vessel_at(v, u, &radius);
        truth->stenosis.direction = ang_vec3_unit(
            ang_vec3_sub(ang_phantom_vessel_at(v, u + 1e-4, NULL), ang_phantom_vessel_at(v, u - 1e-4, NULL)));
        truth->stenosis.normal_mm = 2 * radius;
        truth->stenosis.minimum_mm = 1.2;
        truth->stenosis.length_mm = 8;
        truth->stenosis.percent = 100 * (1 - truth->stenosis.minimum_mm / truth->stenosis.normal_mm);
    }
}

void ang_phantom_tree(uint64_t seed, ang_phantom_truth *truth) {
    uint64_t state = ang_phantom_hash(seed ^ 0x5EEDu);
    truth->vessel_count = 0;
    for (int side = 1; side >= -1; side -= 2) {
        carotid(truth, &state, side);
        middle_cerebral(truth, &state, side);
        anterior_cerebral(truth, &state, side);
        posterior(truth, &state, side);
    }
    ADD("anterior communicating", 0, 0.8, 0.8, {3, -17, 12}, {0, -17.6, 12}, {-3, -17, 12});
    ADD("basilar artery", 0, 1.8, 1.5, {0, 17, -21}, {0, 13, -13}, {0, 10, -5}, {0, 8, 4});
    sinuses(truth);
    lesions(truth);
}
