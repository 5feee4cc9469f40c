#include "core/volume/phantom_parts.h"

/* Everything is in LPS mm about the sella; sizes after an adult head of 152 x 190 mm. */
static const double air = -1000, fat = -90, skin = 50, muscle = 55, grey = 40, white = 30, fluid = 8;
static const double cortical = 1200, spongy = 600, enamel = 1900, vitreous = 15;

static double square(double x) { return x * x; }

static double smooth_step(double low, double high, double x) {
    double t = (x - low) / (high - low);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}

/* Smaller of two distances, rounded over a radius k (Quilez's polynomial smooth minimum). */
static double smooth_min(double a, double b, double k) {
    double h = fmax(k - fabs(a - b), 0) / k;
    return fmin(a, b) - h * h * k / 4;
}
static double smooth_max(double a, double b, double k) { return -smooth_min(-a, -b, k); }

/* Distance to an ellipsoid to first order, good near its surface. */
static double ellipsoid(ang_vec3 p, double cx, double cy, double cz, double rx, double ry, double rz) {
    double x = (p.x - cx) / rx, y = (p.y - cy) / ry, z = (p.z - cz) / rz;
    double k0 = sqrt(x * x + y * y + z * z), k1 = sqrt(square(x / rx) + square(y / ry) + square(z / rz));
    return k1 > 0 ? k0 * (k0 - 1) / k1 : -fmin(rx, fmin(ry, rz));
}

/* Distance to a rod from a to b with radii ra, rb. */
static double rod(ang_vec3 p, ang_vec3 a, ang_vec3 b, double ra, double rb) {
    ang_vec3 along = ang_vec3_sub(b, a), to = ang_vec3_sub(p, a);
    double t = ang_vec3_dot(to, along) / ang_vec3_dot(along, along);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return ang_vec3_length(ang_vec3_along(to, along, -t)) - ra - t * (rb - ra);
}

static ang_vec3 mirrored(ang_vec3 p) { return (ang_vec3){fabs(p.x), p.y, p.z}; }

/* The floor of the cavity: fossae anterior (high), middle, posterior (deep). */
static double skull_base(ang_vec3 p) {
    double side = smooth_step(10, 26, fabs(p.x));
    double anterior = 10 - 4 * smooth_step(14, 0, fabs(p.x));
    double middle = -4 - 12 * side;
    double posterior = -34 - 6 * smooth_step(8, 30, p.y);
    double front = smooth_step(-30 + 8 * side, -18 + 8 * side, p.y);
    double back = smooth_step(2 + 8 * side, 22 + 10 * side, p.y);
    double floor = anterior + (middle - anterior) * front;
    return floor + (posterior - floor) * back;
}

double ang_phantom_cavity(ang_vec3 p) {
    /* The forehead is narrower than the back of the head. */
    ang_vec3 q = {p.x * (1 - 0.0016 * (p.y - 18)), p.y, p.z};
    double vault = ellipsoid(q, 0, 18, 32, 66, 85, 66);
    if (p.z > 45) return vault;
    double above = 0.75 * (skull_base(p) - p.z); /* the floor's slope makes heights longer than distances */
    return smooth_max(vault, above, 8);
}

ang_vec3 ang_phantom_on_skull(ang_vec3 p, double distance) {
    const double h = 0.05;
    for (int i = 0; i < 6; i++) {
        double here = ang_phantom_cavity(p);
        ang_vec3 g = {ang_phantom_cavity((ang_vec3){p.x + h, p.y, p.z}) - here,
                      ang_phantom_cavity((ang_vec3){p.x, p.y + h, p.z}) - here,
                      ang_phantom_cavity((ang_vec3){p.x, p.y, p.z + h}) - here};
        double slope = ang_vec3_length(g) / h;
        if (!(slope > 1e-6)) break;
        p = ang_vec3_along(p, ang_vec3_unit(g), (distance - here) / fmax(slope, 0.3));
    }
    return p;
}

static double eye_socket(ang_vec3 m) { return ellipsoid(m, 29, -54, -10, 15, 24, 14); }

/* Air spaces lined by bone: frontal, sphenoid, ethmoid and maxillary sinuses, mastoid cells; nose and throat. */
static double sinuses(ang_vec3 p, ang_vec3 m) {
    double d = ellipsoid(m, 9, -65.6, 15, 8, 1.8, 7);
    d = fmin(d, ellipsoid(m, 7, -17, -11, 6, 10, 6));
    d = fmin(d, ellipsoid(m, 7, -46, -14, 5, 17, 9));
    d = fmin(d, ellipsoid(m, 27, -54, -45, 13, 16, 15));
    double cells = ellipsoid(m, 54, 24, -34, 7, 9, 13);
    double wall = 0.6 * (sin(p.x * 1.3) + sin(p.y * 1.3) + sin(p.z * 1.3)); /* honeycomb */
    d = fmin(d, fmax(cells, wall));
    double nose = smooth_max(ellipsoid(m, 6, -62, -45, 6, 30, 16), 1.5 - m.x, 1);
    double throat = rod(p, (ang_vec3){0, -28, -45}, (ang_vec3){0, -12, -125}, 8, 8);
    return fmin(d, fmin(nose, throat));
}

/* Bones of the face, of the base and of the neck. */
static double face_bones(ang_vec3 p, ang_vec3 m) {
    /* Upper jaw with the arch of the teeth, cheek bone and its arch. */
    double d = ellipsoid(m, 17, -50, -44, 24, 23, 23);
    double arch = smooth_max(ellipsoid(p, 0, -50, -63, 28, 27, 10), -ellipsoid(p, 0, -46, -68, 20, 19, 12), 3);
    d = smooth_min(d, arch, 5);
    d = smooth_min(d, rod(m, (ang_vec3){40, -54, -30}, (ang_vec3){55, -20, -26}, 6, 3), 8);
    d = smooth_min(d, rod(m, (ang_vec3){55, -20, -26}, (ang_vec3){57, 6, -22}, 3, 4), 4);
    /* Around the socket: brow, side, nose, and the wall behind. */
    d = smooth_min(d, rod(m, (ang_vec3){6, -67, 6}, (ang_vec3){40, -58, 7}, 5, 4.5), 6);
    d = smooth_min(d, rod(m, (ang_vec3){42, -57, 7}, (ang_vec3){47, -49, -26}, 4, 4.5), 6);
    d = smooth_min(d, rod(m, (ang_vec3){5, -68, 2}, (ang_vec3){14, -68, -30}, 4, 4), 6);
    d = smooth_min(d, rod(m, (ang_vec3){45, -42, -8}, (ang_vec3){30, -20, -2}, 5, 5), 6);
    d = smooth_min(d, rod(p, (ang_vec3){0, -68, 2}, (ang_vec3){0, -84, -20}, 5, 2.5), 5);
    d = fmax(d, -eye_socket(m));
    /* Petrous ridge, clivus, back of the saddle, mastoid. */
    d = smooth_min(d, rod(m, (ang_vec3){60, 18, -16}, (ang_vec3){18, -2, -14}, 11, 6), 6);
    d = smooth_min(d, rod(p, (ang_vec3){0, 0, -8}, (ang_vec3){0, 15, -38}, 8, 6), 6);
    d = smooth_min(d, rod(p, (ang_vec3){-6, 1, 0}, (ang_vec3){6, 1, 0}, 2, 2), 3);
    d = smooth_min(d, ellipsoid(m, 54, 24, -34, 10, 12, 17), 5);
    return d;
}

static double jaw_and_spine(ang_vec3 p, ang_vec3 m) {
    double d = rod(m, (ang_vec3){0, -72, -102}, (ang_vec3){24, -62, -98}, 8, 8);
    d = smooth_min(d, rod(m, (ang_vec3){24, -62, -98}, (ang_vec3){41, -16, -82}, 8, 6), 5);
    d = smooth_min(d, rod(m, (ang_vec3){41, -16, -82}, (ang_vec3){49, -3, -30}, 6, 5), 5);
    /* Atlas as a ring, the vertebrae below as bodies with arches. */
    double circle = sqrt(square(p.x * 0.72) + square(p.y - 30)) - 17;
    double ring = sqrt(square(circle) + square(p.z + 54)) - 5.5;
    d = fmin(d, ring);
    double step = 17, level = fmin(fmax(round(-(p.z + 74) / step), 0), 3);
    ang_vec3 q = {p.x, p.y - 2 * level, p.z + 74 + step * level};
    double body = ellipsoid(q, 0, 18, 0, 12, 9, 8.2);
    body = fmin(body, rod((ang_vec3){fabs(q.x), q.y, q.z}, (ang_vec3){14, 24, 0}, (ang_vec3){0, 50, -5}, 5, 4));
    return fmin(d, body);
}

/* Where bone is opened: foramen magnum, canal of the spine, optic canals. */
static double openings(ang_vec3 p, ang_vec3 m) {
    double canal = rod(p, (ang_vec3){0, 32, -20}, (ang_vec3){0, 34, -130}, 13, 9);
    return fmin(canal, rod(m, (ang_vec3){8, -10, 4}, (ang_vec3){26, -42, -8}, 3, 3));
}

static double teeth(ang_vec3 m) {
    double d = 1e9;
    for (int i = 0; i < 7; i++) {
        double angle = (i + 0.5) * 0.2;
        double x = 26 * sin(angle), y = -58 - 22 * cos(angle) + 4;
        d = fmin(d, ellipsoid(m, x, y, -72, 3.4, 3.4, 7));
        d = fmin(d, ellipsoid(m, x * 0.96, y + 2, -87, 3.2, 3.2, 7));
    }
    return d;
}

/* Skin surface: scalp, face, nose, ears, neck. */
static double outside(ang_vec3 p, ang_vec3 m, double cavity) {
    ang_vec3 q = {p.x * (1 - 0.0016 * (p.y - 18)), p.y, p.z};
    double d = p.z > 45 ? cavity - 12 : fmin(cavity - 12, ellipsoid(q, 0, 18, 32, 78, 97, 78));
    if (p.z > 60) return d;
    d = smooth_min(d, ellipsoid(p, 0, -26, -46, 66, 62, 62), 18);
    d = smooth_min(d, ellipsoid(p, 0, -58, -96, 26, 26, 20), 18);
    d = smooth_min(d, rod(p, (ang_vec3){0, -78, -6}, (ang_vec3){0, -98, -42}, 6, 10), 10);
    d = smooth_min(d, ellipsoid(p, 0, -80, -78, 26, 14, 16), 10);
    d = smooth_min(d, rod(p, (ang_vec3){0, 26, -34}, (ang_vec3){0, 22, -140}, 65, 56), 20);
    double ear = ellipsoid(m, 79, 20, -16, 7, 17, 27);
    ear = smooth_max(ear, -ellipsoid(m, 84, 13, -16, 5, 9, 16), 3);
    d = smooth_min(d, ear, 5);
    d = smooth_max(d, -rod(m, (ang_vec3){60, 12, -20}, (ang_vec3){90, 12, -20}, 3, 3), 1); /* ear canals */
    return smooth_max(d, -rod(m, (ang_vec3){6, -92, -46}, (ang_vec3){6, -92, -60}, 4, 4), 1);
}

static double mix(double below, double above, double share) { return below + share * (above - below); }

static double brain_hu(ang_vec3 p, ang_vec3 m, double depth, double edge) {
    /* Cortex folds as waves in a shell; no attempt at anatomy. */
    double fold = sin(0.33 * p.x + 0.9 * sin(0.11 * p.y)) * sin(0.31 * p.y + 0.8 * sin(0.13 * p.z)) +
                  sin(0.29 * p.z + 0.7 * sin(0.12 * p.x));
    double ribbon = depth - 5 - 3 * fold;
    double hu = mix(grey, white, ang_phantom_inside(-ribbon, 3));
    hu = mix(hu, grey, ang_phantom_inside(ellipsoid(m, 16, 4, 24, 11, 18, 11), 3)); /* deep grey matter */
    double sulcus = fmax(depth - 9, 1.3 - fabs(fold) * 4);
    hu = mix(hu, 0.5 * (fluid + hu), ang_phantom_inside(sulcus, 2) * 0.3);
    hu = mix(hu, fluid, ang_phantom_inside(depth - 1.5, edge));
    /* Lateral ventricles, third ventricle, cisterns around the circle. */
    double ventricle = smooth_min(rod(m, (ang_vec3){6, -22, 30}, (ang_vec3){16, 34, 36}, 5, 5),
                                  rod(m, (ang_vec3){16, 34, 36}, (ang_vec3){28, 30, 8}, 5, 3), 4);
    ventricle = fmin(ventricle, ellipsoid(p, 0, 8, 22, 2, 12, 9));
    ventricle = smooth_min(ventricle, ellipsoid(p, 0, -4, 7, 16, 14, 6), 4);
    ventricle = smooth_min(ventricle, ellipsoid(p, 0, 10, -10, 8, 6, 16), 4);
    hu = mix(hu, fluid, ang_phantom_inside(ventricle, edge));
    double falx = fmax(fabs(p.x) - 0.6, fmax(30 - p.z + 0.15 * p.y, depth - 30));
    return mix(hu, 60, ang_phantom_inside(falx, edge));
}

static double bone_hu(double depth, double thickness) {
    /* Two cortical tables around spongy bone. */
    double table = fmin(depth, thickness - depth);
    return mix(spongy, cortical, 1 - smooth_step(0.8, 2.2, table));
}

double ang_phantom_head_hu(ang_vec3 p, double edge, double channel) {
    double far = ellipsoid(p, 0, 4, -10, 96, 122, 136);
    if (far > 12) return air;
    double cavity = ang_phantom_cavity(p);
    ang_vec3 m = mirrored(p);
    if (cavity < -edge) return brain_hu(p, m, -cavity, edge);

    double skin_distance = outside(p, m, cavity);
    if (skin_distance > edge) return air;
    double thickness = 6 - 2.5 * smooth_step(40, 66, fabs(p.x)) + 1.5 * smooth_step(70, 105, p.y);
    double hu = mix(muscle, fat, smooth_step(-2.2, -3.2, skin_distance) * smooth_step(-9, -7, skin_distance));
    hu = mix(hu, skin, ang_phantom_inside(-2 - skin_distance, edge));

    bool face = p.z < 30;
    if (face) {
        double socket = eye_socket(m);
        hu = mix(hu, fat, ang_phantom_inside(socket + 2, edge));
        double muscles = fabs(ellipsoid(m, 29, -48, -10, 9, 24, 9)) - 1.5;
        hu = mix(hu, muscle, ang_phantom_inside(fmax(muscles, socket + 1), edge));
        hu = mix(hu, vitreous, ang_phantom_inside(ellipsoid(m, 30, -62, -10, 11.5, 11.5, 11.5), edge));
        hu = mix(hu, 70, ang_phantom_inside(ellipsoid(m, 30, -70, -10, 5, 2.5, 5), edge));
        hu = mix(hu, muscle, ang_phantom_inside(rod(m, (ang_vec3){27, -51, -10}, (ang_vec3){9, -12, 3}, 2, 2), edge));
    }

    double shell = fmax(-cavity, cavity - thickness);
    double bone_depth = -shell, bone = ang_phantom_inside(shell, edge);
    double local = bone_hu(cavity, thickness);
    if (face) {
        double other = fmin(face_bones(p, m), jaw_and_spine(p, m));
        if (other < -bone_depth || bone <= 0) {
            local = mix(spongy * 0.75, cortical * 0.85, 1 - smooth_step(0.8, 2.6, -other));
        }
        bone = fmax(bone, ang_phantom_inside(other, edge));
        bone *= 1 - ang_phantom_inside(openings(p, m), edge);
    }
    bone *= ang_phantom_inside(skin_distance + 2, edge) * (1 - channel);
    hu = mix(hu, local, bone);
    if (face) {
        hu = mix(hu, enamel, ang_phantom_inside(teeth(m), edge));
        hu = mix(hu, air, ang_phantom_inside(sinuses(p, m), edge));
    }
    if (cavity < edge) hu = mix(hu, fluid, ang_phantom_inside(cavity, edge));
    return mix(air, hu, ang_phantom_inside(skin_distance, edge));
}
