#include "core/volume/phantom.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/volume/phantom_parts.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

const ang_phantom_params ang_phantom_params_default = {
    .dims = {512, 512, 96}, .centre_mm = {0, 5, 8}, .seed = 1, .noise_hu = 8, .artery_hu = 350};

static const double field_of_view[3] = {230.4, 230.4, 96};
static const double channel_gap = 1.5; /* mm between an artery and the bone it passes */
static const double lowest_hu = -1024;
static const double least_spacing = 0.01; /* mm; below, a vessel alone would fill the volume and take for ever */
/* Width of an edge in voxels: about what a scanner's point spread gives, and smooth enough for gradients. */
static const double edge_voxels = 1.4;

/* A stretch of tube between two points; a == b is a sphere. */
typedef struct segment {
    ang_vec3 a, b;
    double ra, rb;
    bool arterial;
} segment;

typedef struct field {
    const ang_phantom_truth *truth;
    segment *segments;
    size_t count, room;
    ang_volume *volume;
    ang_vec3 spacing;
    double edge;
    float *layers; /* per worker: arteries, veins, channels, each of one slice */
    const ang_progress *progress;
    atomic_int done;
    atomic_bool stopped;
} field;

static void push(field *f, segment s) {
    if (f->count < f->room) f->segments[f->count] = s;
    f->count++;
}

/* 1 away from the stenosis, minimum / normal at its middle, a raised cosine between. */
static double narrowing(const ang_phantom_truth *truth, ang_vec3 p) {
    double s = ang_vec3_length(ang_vec3_sub(p, truth->stenosis.centre)), length = truth->stenosis.length_mm;
    if (s >= length / 2) return 1;
    double least = truth->stenosis.minimum_mm / truth->stenosis.normal_mm;
    return 1 - (1 - least) * 0.5 * (1 + cos(2 * M_PI * s / length));
}

static void cut_into_segments(field *f) {
    const ang_phantom_truth *truth = f->truth;
    f->count = 0;
    for (int i = 0; i < truth->vessel_count; i++) {
        const ang_phantom_vessel *v = &truth->vessels[i];
        bool narrowed = strcmp(v->name, truth->stenosis.parent) == 0;
        int steps = (int)ceil(v->length_mm / 0.4);
        segment s = {.arterial = v->arterial};
        for (int k = 0; k <= steps; k++) {
            s.b = ang_phantom_vessel_at(v, (double)k * (v->count - 1) / steps, &s.rb);
            if (narrowed) s.rb *= narrowing(truth, s.b);
            if (k > 0) push(f, s);
            s.a = s.b;
            s.ra = s.rb;
        }
    }
    ang_vec3 centre = truth->aneurysm.centre;
    double radius = truth->aneurysm.diameter_mm / 2, neck = truth->aneurysm.neck_mm / 2;
    push(f, (segment){centre, centre, radius, radius, true});
    for (int i = 0; i < truth->vessel_count; i++) {
        const ang_phantom_vessel *v = &truth->vessels[i];
        if (strcmp(v->name, truth->aneurysm.parent) == 0) {
            push(f, (segment){v->points[v->count - 1], centre, neck, neck, true});
        }
    }
}

static void keep_larger(float *to, double value) {
    if (value > (double)*to) *to = (float)value;
}

/* Far segments of a small volume have indices that no int holds. */
static int clamped(double index, int low, int high) { return (int)fmin(fmax(index, low), high); }

static void draw_segment(const field *f, const segment *s, int z, float *layer) {
    const ang_volume *v = f->volume;
    ang_vec3 origin = {v->affine.m[0][3], v->affine.m[1][3], v->affine.m[2][3]}, h = f->spacing;
    double pz = origin.z + z * h.z, gap = s->arterial ? channel_gap : 0;
    double reach = fmax(s->ra, s->rb) + gap + f->edge;
    if (pz < fmin(s->a.z, s->b.z) - reach || pz > fmax(s->a.z, s->b.z) + reach) return;
    int x0 = clamped(ceil((fmin(s->a.x, s->b.x) - reach - origin.x) / h.x), 0, v->dims[0]);
    int y0 = clamped(ceil((fmin(s->a.y, s->b.y) - reach - origin.y) / h.y), 0, v->dims[1]);
    int x1 = clamped(floor((fmax(s->a.x, s->b.x) + reach - origin.x) / h.x), -1, v->dims[0] - 1);
    int y1 = clamped(floor((fmax(s->a.y, s->b.y) + reach - origin.y) / h.y), -1, v->dims[1] - 1);
    size_t plane = (size_t)v->dims[0] * (size_t)v->dims[1];
    ang_vec3 along = ang_vec3_sub(s->b, s->a);
    double squared = ang_vec3_dot(along, along);
    for (int y = y0; y <= y1; y++) {
        for (int x = x0; x <= x1; x++) {
            ang_vec3 to = ang_vec3_sub((ang_vec3){origin.x + x * h.x, origin.y + y * h.y, pz}, s->a);
            double t = squared > 0 ? ang_vec3_dot(to, along) / squared : 0;
            t = t < 0 ? 0 : t > 1 ? 1 : t;
            ang_vec3 away = ang_vec3_along(to, along, -t);
            double length = ang_vec3_length(away), radius = s->ra + t * (s->rb - s->ra);
            if (length > radius + gap + f->edge) continue;
            /* How far a voxel reaches along the normal. */
            double edge = length > 1e-9
                              ? edge_voxels * (fabs(away.x) * h.x + fabs(away.y) * h.y + fabs(away.z) * h.z) / length
                              : f->edge;
            float *at = layer + (size_t)y * (size_t)v->dims[0] + (size_t)x;
            keep_larger(at + (s->arterial ? 0 : plane), ang_phantom_inside(length - radius, edge));
            if (s->arterial) keep_larger(at + 2 * plane, ang_phantom_inside(length - radius - gap, f->edge));
        }
    }
}

/* A sum of four uniform numbers: near enough to normal for noise, bounded, and the same on every machine. */
static double noise(uint64_t key) {
    uint64_t bits = ang_phantom_hash(key);
    double sum =
        (double)(bits & 0xFFFF) + (double)(bits >> 16 & 0xFFFF) + (double)(bits >> 32 & 0xFFFF) + (double)(bits >> 48);
    return (sum - 2 * 65535.0) / (65536.0 * 0.57735026918962576);
}

static void fill_slice(field *f, int z, float *layer) {
    ang_volume *v = f->volume;
    const ang_phantom_truth *truth = f->truth;
    size_t plane = (size_t)v->dims[0] * (size_t)v->dims[1];
    memset(layer, 0, 3 * plane * sizeof *layer);
    for (size_t i = 0; i < f->count; i++) draw_segment(f, &f->segments[i], z, layer);
    uint64_t seed = ang_phantom_hash(truth->params.seed);
    for (int y = 0; y < v->dims[1]; y++) {
        for (int x = 0; x < v->dims[0]; x++) {
            size_t at = (size_t)y * (size_t)v->dims[0] + (size_t)x, index = (size_t)z * plane + at;
            ang_vec3 p = ang_mat4_point(&v->affine, (ang_vec3){x, y, z});
            double artery = layer[at], vein = layer[at + plane];
            double hu = ang_phantom_head_hu(p, f->edge, layer[at + 2 * plane]);
            hu += vein * (truth->vein_hu - hu);
            hu += artery * (truth->artery_hu - hu);
            hu += truth->params.noise_hu * noise(seed + index);
            double stored = round(hu - lowest_hu);
            v->data[index] = stored <= 0 ? 0 : stored >= 65535 ? 65535 : (uint16_t)stored;
        }
    }
}

static void fill(void *context, size_t begin, size_t end, int worker) {
    field *f = context;
    size_t plane = (size_t)f->volume->dims[0] * (size_t)f->volume->dims[1];
    for (size_t z = begin; z < end; z++) {
        if (atomic_load(&f->stopped)) return;
        fill_slice(f, (int)z, f->layers + (size_t)worker * 3 * plane);
        int done = atomic_fetch_add(&f->done, 1) + 1;
        if (!ang_progress_update(f->progress, "making the phantom", (double)done / f->volume->dims[2])) {
            atomic_store(&f->stopped, true);
        }
    }
}

static bool check_params(const ang_phantom_params *p, ang_error *err) {
    for (int i = 0; i < 3; i++) {
        if (p->dims[i] < 1 || p->dims[i] > 65535) {
            return ang_fail(err, ANG_USAGE, "phantom: %d voxels along an axis; give 1 to 65535", p->dims[i]);
        }
        double spacing = p->spacing_mm[i];
        if (spacing != 0 && !(spacing >= least_spacing && spacing <= 1000)) {
            return ang_fail(err, ANG_USAGE, "phantom: a spacing of %g mm; give %g to 1000", spacing, least_spacing);
        }
    }
    if (!(p->noise_hu >= 0 && p->noise_hu <= 1000)) {
        return ang_fail(err, ANG_USAGE, "phantom: noise of %g HU; give 0 to 1000", p->noise_hu);
    }
    if (!(p->artery_hu >= -1000 && p->artery_hu <= 30000)) {
        return ang_fail(err, ANG_USAGE, "phantom: arteries of %g HU; give -1000 to 30000", p->artery_hu);
    }
    return true;
}

static void describe(const ang_phantom_params *params, ang_phantom_truth *truth) {
    memset(truth, 0, sizeof *truth);
    truth->params = *params;
    for (int i = 0; i < 3; i++) {
        if (params->spacing_mm[i] <= 0) truth->params.spacing_mm[i] = field_of_view[i] / params->dims[i];
    }
    truth->artery_hu = params->artery_hu;
    truth->vein_hu = 120;
    truth->brain_hu = 35;
    truth->soft_tissue_hu = 55;
    truth->bone_hu[0] = 600;
    truth->bone_hu[1] = 1200;
    truth->air_hu = -1000;
    ang_phantom_tree(params->seed, truth);
}

static ang_volume *make(const ang_phantom_truth *truth, int threads, const ang_progress *progress, ang_error *err) {
    const ang_phantom_params *p = &truth->params;
    ang_volume *volume = ang_volume_create(p->dims, err);
    if (!volume) return NULL;
    volume->intercept = lowest_hu;
    field f = {.truth = truth, .volume = volume, .progress = progress};
    f.spacing = (ang_vec3){p->spacing_mm[0], p->spacing_mm[1], p->spacing_mm[2]};
    f.edge = edge_voxels * fmax(f.spacing.x, fmax(f.spacing.y, f.spacing.z));
    for (int i = 0; i < 3; i++) {
        volume->affine.m[i][i] = p->spacing_mm[i];
        volume->affine.m[i][3] = ang_vec3_at(p->centre_mm, i) - p->spacing_mm[i] * (p->dims[i] - 1) / 2;
    }
    cut_into_segments(&f);
    f.room = f.count;
    f.segments = ang_alloc(f.room, sizeof *f.segments, "phantom", err);
    size_t layers = ang_product3((size_t)p->dims[0], (size_t)p->dims[1], 3 * (size_t)ang_thread_count(threads));
    f.layers = f.segments ? ang_alloc(layers, sizeof *f.layers, "phantom", err) : NULL;
    bool good = f.layers != NULL;
    if (good) {
        cut_into_segments(&f);
        ang_parallel_for((size_t)p->dims[2], 1, threads, fill, &f);
        good = !atomic_load(&f.stopped) || ang_fail(err, ANG_INTERRUPTED, "phantom: interrupted");
    }
    free(f.segments);
    free(f.layers);
    if (!good) {
        ang_volume_free(volume);
        return NULL;
    }
    ang_volume_update_range(volume, threads);
    return volume;
}

ang_volume *ang_phantom_make(const ang_phantom_params *params, int threads, const ang_progress *progress,
                             ang_phantom_truth *truth, ang_error *err) {
    if (!check_params(params, err)) return NULL;
    ang_phantom_truth *full = ang_alloc(1, sizeof *full, "phantom", err);
    if (!full) return NULL;
    describe(params, full);
    ang_volume *volume = make(full, threads, progress, err);
    if (volume && truth) *truth = *full;
    free(full);
    return volume;
}
