#include "core/cpu/reference.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/cpu/integrate.h"
#include "core/math/polynomial.h"
#include "core/scene/objects.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

struct ang_reference {
    const ang_volume *volume;
    const ang_scene *scene;
    ang_ray_frame frame;
    ang_gauss gauss;
    double *knots; /* HU of the transfer function's points, ascending, each once */
    size_t knot_count;
};

/* A stretch of a ray inside one cell, parametrised over s in [0, 1]. Fields are cubics of s in HU. */
typedef struct stretch {
    const ang_reference *reference;
    const ang_ray *ray;
    int cell[3];              /* lower voxel of the cell; -1 stands for the half cell of an axis of one voxel */
    double start[3], step[3]; /* local coordinates 0..1 */
    double enter, length;     /* mm */
    ang_cubic hu;
    ang_cubic ahead[3], behind[3]; /* one voxel further and nearer along each index axis; only for Phong */
    bool gradient_ready;
} stretch;

ang_reference *ang_reference_create(const ang_volume *volume, const ang_scene *scene, ang_error *err) {
    if (!ang_scene_check(scene, err)) return NULL;
    ang_reference *reference = ang_alloc(1, sizeof *reference, "reference renderer", err);
    if (!reference) return NULL;
    reference->volume = volume;
    reference->scene = scene;
    reference->gauss = ang_gauss_make();
    size_t points = scene->transfer ? scene->transfer->count : 0;
    reference->knots = ang_alloc(points, sizeof *reference->knots, "reference renderer", err);
    if (!reference->knots || !ang_ray_frame_make(volume, scene, &reference->frame, err)) {
        ang_reference_free(reference);
        return NULL;
    }
    for (size_t i = 0; i < points; i++) {
        double hu = scene->transfer->points[i].hu;
        if (reference->knot_count == 0 || hu > reference->knots[reference->knot_count - 1])
            reference->knots[reference->knot_count++] = hu;
    }
    return reference;
}

void ang_reference_free(ang_reference *reference) {
    if (!reference) return;
    free(reference->knots);
    free(reference);
}

/* The corner values of the cell moved by `shift` voxels, in HU, clamped at the box: a point clamped at the box has the
 * values of the last plane of voxels, which is what clamped indices give. */
static void corner_values(const ang_volume *volume, const int cell[3], const int shift[3], double hu[8]) {
    size_t index[3][2];
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            int i = cell[axis] + shift[axis] + side, last = volume->dims[axis] - 1;
            index[axis][side] = (size_t)(i < 0 ? 0 : i > last ? last : i);
        }
    size_t row = (size_t)volume->dims[0], slice = row * (size_t)volume->dims[1];
    for (int c = 0; c < 8; c++) {
        size_t voxel = index[0][c & 1] + row * index[1][c >> 1 & 1] + slice * index[2][c >> 2];
        hu[c] = ang_volume_hu(volume, volume->data[voxel]);
    }
}

static ang_cubic field(const stretch *at, const int shift[3]) {
    double hu[8];
    corner_values(at->reference->volume, at->cell, shift, hu);
    return ang_cubic_in_cell(hu, at->start, at->step);
}

static void prepare_gradient(stretch *at) {
    for (int axis = 0; axis < 3; axis++) {
        int shift[3] = {0};
        shift[axis] = 1;
        at->ahead[axis] = field(at, shift);
        shift[axis] = -1;
        at->behind[axis] = field(at, shift);
    }
    at->gradient_ready = true;
}

/* Phong of a colour at place s, as ang_phong documents it. */
static void shade(const stretch *at, double s, double colour[3]) {
    const ang_phong *phong = &at->reference->scene->phong;
    ang_vec3 difference = {ang_cubic_at(&at->ahead[0], s) - ang_cubic_at(&at->behind[0], s),
                           ang_cubic_at(&at->ahead[1], s) - ang_cubic_at(&at->behind[1], s),
                           ang_cubic_at(&at->ahead[2], s) - ang_cubic_at(&at->behind[2], s)};
    ang_vec3 gradient = ang_mat4_transposed_direction(&at->reference->frame.to_index, ang_vec3_scale(difference, 0.5));
    double g2 = ang_vec3_dot(gradient, gradient);
    if (!(g2 > 0)) return;
    double facing = fabs(ang_vec3_dot(gradient, at->ray->direction_mm)) / sqrt(g2);
    double weight = g2 / (g2 + phong->g0 * phong->g0);
    double diffuse = phong->ambient + phong->diffuse * facing, specular = phong->specular * pow(facing, phong->power);
    for (int c = 0; c < 3; c++) colour[c] += weight * (colour[c] * diffuse + specular - colour[c]);
}

static void medium(const void *context, double s, double *extinction, double colour[3]) {
    const stretch *at = context;
    const ang_transfer *transfer = at->reference->scene->transfer;
    double hu = ang_cubic_at(&at->hu, s);
    *extinction = ang_transfer_extinction(transfer, hu);
    ang_transfer_colour(transfer, hu, colour);
    if (at->gradient_ready) shade(at, s, colour);
}

/* Light from [low, high] of the stretch, on which the transfer function is smooth. */
static void add_smooth(stretch *at, double low, double high, ang_light *light, uint64_t *samples) {
    const ang_transfer *transfer = at->reference->scene->transfer;
    double f0 = ang_cubic_at(&at->hu, low), fm = ang_cubic_at(&at->hu, 0.5 * (low + high));
    double f1 = ang_cubic_at(&at->hu, high);
    if (!ang_transfer_visible(transfer, fmin(fm, fmin(f0, f1)), fmax(fm, fmax(f0, f1)))) return;
    bool phong = at->reference->scene->shading == ANG_SHADING_PHONG;
    if (phong && !at->gradient_ready) prepare_gradient(at);
    double extinction, colour[3];
    medium(at, 0.5 * (low + high), &extinction, colour);
    if (isinf(extinction)) {
        /* A surface: the colour is that of the place where the ray meets it, seen from inside the plateau. */
        medium(at, low + 1e-9 * (high - low), &extinction, colour);
        for (int c = 0; c < 3; c++) light->colour[c] += light->transmittance * colour[c];
        light->transmittance = 0;
        return;
    }
    bool constant = !phong && f0 == f1 && f0 == fm;
    if (constant) {
        double opacity = -expm1(-extinction * (high - low) * at->length);
        for (int c = 0; c < 3; c++) light->colour[c] += light->transmittance * opacity * colour[c];
        light->transmittance *= 1 - opacity;
        return;
    }
    ang_integrate(&at->reference->gauss, medium, at, low, high, at->length, phong ? 1e-7 : 1e-11, light, samples);
}

/* Cuts the stretch at the knots of the transfer function between `low` and `high` HU, the range of its cell: on each
 * monotone part of the field the ray meets them in order. */
static void add_light(stretch *at, double low, double high, ang_light *light, uint64_t *samples) {
    const double *knots = at->reference->knots;
    size_t first = 0, last = at->reference->knot_count;
    while (first < last && knots[first] <= low) first++;
    while (last > first && knots[last - 1] >= high) last--;
    double ends[4];
    int parts = ang_cubic_monotone(&at->hu, ends) - 1;
    for (int part = 0; part < parts; part++) {
        double from = ang_cubic_at(&at->hu, ends[part]), to = ang_cubic_at(&at->hu, ends[part + 1]);
        bool rising = to > from;
        double place = ends[part];
        for (size_t i = first; i < last; i++) {
            double knot = knots[rising ? i : last - 1 - (i - first)];
            if (knot <= fmin(from, to) || knot >= fmax(from, to)) continue;
            double cut = ang_cubic_solve(&at->hu, knot, place, ends[part + 1]);
            if (cut > place) add_smooth(at, place, cut, light, samples);
            place = fmax(cut, place);
            if (light->transmittance < 1e-14) return;
        }
        if (ends[part + 1] > place) add_smooth(at, place, ends[part + 1], light, samples);
        if (light->transmittance < 1e-14) return;
    }
}

/* What the modes other than dvr gather along a ray. */
typedef struct gathered {
    ang_light light;
    double extreme;          /* HU; mip, minip */
    double integral, weight; /* HU mm and mm; mean */
    double hit[3];           /* iso */
    bool any, done;
} gathered;

static void add_extreme(const stretch *at, bool maximum, gathered *sum) {
    double ends[4];
    int count = ang_cubic_monotone(&at->hu, ends);
    for (int i = 0; i < count; i++) {
        double hu = ang_cubic_at(&at->hu, ends[i]);
        if (!sum->any || (maximum ? hu > sum->extreme : hu < sum->extreme)) sum->extreme = hu;
        sum->any = true;
    }
}

static void add_mean(const stretch *at, gathered *sum) {
    const ang_volume *volume = at->reference->volume;
    double weight = 1;
    if (volume->padding) {
        double corner[8];
        size_t row = (size_t)volume->dims[0], slice = row * (size_t)volume->dims[1];
        for (int c = 0; c < 8; c++) {
            int i[3];
            for (int axis = 0; axis < 3; axis++) {
                i[axis] = at->cell[axis] + (c >> axis & 1);
                if (i[axis] < 0) i[axis] = 0;
                if (i[axis] > volume->dims[axis] - 1) i[axis] = volume->dims[axis] - 1;
            }
            size_t voxel = (size_t)i[0] + row * (size_t)i[1] + slice * (size_t)i[2];
            corner[c] = ang_volume_is_padding(volume, voxel) ? 0 : 1;
        }
        ang_cubic tissue = ang_cubic_in_cell(corner, at->start, at->step);
        weight = ang_cubic_integral(&tissue);
    }
    /* Padding holds the value of air: subtracting its share leaves the tissue's. */
    double air = ang_volume_hu(volume, ang_volume_padding_value(volume));
    sum->integral += at->length * (ang_cubic_integral(&at->hu) - air * (1 - weight));
    sum->weight += at->length * weight;
    sum->any = true;
}

/* The first place where the field is at or above the iso value. A ray that starts inside meets a cut face, which takes
 * the colour of its own value. */
static void find_surface(stretch *at, gathered *sum) {
    const ang_scene *scene = at->reference->scene;
    double start = ang_cubic_at(&at->hu, 0), place = -1, hu = scene->iso_hu;
    bool first = !sum->any;
    sum->any = true;
    if (start >= scene->iso_hu) {
        place = 0;
        if (first) hu = start;
    } else {
        double places[3];
        if (ang_cubic_crossings(&at->hu, scene->iso_hu, places) > 0) place = places[0];
    }
    if (place < 0) return;
    ang_transfer_colour(scene->transfer, hu, sum->hit);
    prepare_gradient(at);
    shade(at, place, sum->hit);
    sum->done = true;
}

static void add_stretch(stretch *at, gathered *sum, uint64_t *samples) {
    const ang_scene *scene = at->reference->scene;
    static const int here[3] = {0};
    double corner[8];
    corner_values(at->reference->volume, at->cell, here, corner);
    double low = corner[0], high = corner[0];
    for (int c = 1; c < 8; c++) {
        low = fmin(low, corner[c]);
        high = fmax(high, corner[c]);
    }
    bool needed = true;
    switch (scene->mode) {
    case ANG_MODE_DVR:
        needed = ang_transfer_visible(scene->transfer, low, high);
        break;
    case ANG_MODE_MIP:
        needed = !sum->any || high > sum->extreme;
        break;
    case ANG_MODE_MINIP:
        needed = !sum->any || low < sum->extreme;
        break;
    case ANG_MODE_MEAN:
        break;
    case ANG_MODE_ISO:
        needed = high >= scene->iso_hu;
        break;
    }
    if (!needed) {
        sum->any = true;
        return;
    }
    *samples += 1;
    at->hu = ang_cubic_in_cell(corner, at->start, at->step);
    switch (scene->mode) {
    case ANG_MODE_DVR:
        add_light(at, low, high, &sum->light, samples);
        sum->done = sum->light.transmittance < 1e-14;
        break;
    case ANG_MODE_MIP:
        add_extreme(at, true, sum);
        break;
    case ANG_MODE_MINIP:
        add_extreme(at, false, sum);
        break;
    case ANG_MODE_MEAN:
        add_mean(at, sum);
        break;
    case ANG_MODE_ISO:
        find_surface(at, sum);
        break;
    }
}

/* Goes through the cells that the ray meets, front to back. Each crossing is computed from its plane's number, so that
 * nothing accumulates. */
static void walk(const ang_reference *reference, const ang_ray *ray, gathered *sum, uint64_t *samples) {
    const ang_volume *volume = reference->volume;
    const double centre[3] = {reference->frame.centre.x, reference->frame.centre.y, reference->frame.centre.z};
    const double origin[3] = {ray->origin.x + centre[0], ray->origin.y + centre[1], ray->origin.z + centre[2]};
    const double direction[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    stretch at = {.reference = reference, .ray = ray};
    double t = ray->enter;
    for (int axis = 0; axis < 3; axis++) {
        int last = volume->dims[axis] - 2;
        double position = origin[axis] + t * direction[axis];
        double cell = direction[axis] < 0 ? ceil(position) - 1 : floor(position);
        at.cell[axis] = last < 0 ? -1 : (int)fmin(fmax(cell, 0), last);
    }
    while (t < ray->leave && !sum->done) {
        double next = ray->leave;
        int through = -1;
        for (int axis = 0; axis < 3; axis++) {
            if (direction[axis] == 0 || volume->dims[axis] < 2) continue;
            int plane = at.cell[axis] + (direction[axis] > 0);
            double crossing = (plane - origin[axis]) / direction[axis];
            if (crossing < next) {
                next = crossing;
                through = axis;
            }
        }
        if (next > t) {
            at.enter = t;
            at.length = next - t;
            at.gradient_ready = false;
            for (int axis = 0; axis < 3; axis++) {
                double a = origin[axis] + t * direction[axis] - at.cell[axis];
                double b = origin[axis] + next * direction[axis] - at.cell[axis];
                a = fmin(fmax(a, 0), 1);
                b = fmin(fmax(b, 0), 1);
                at.start[axis] = a;
                at.step[axis] = b - a;
            }
            add_stretch(&at, sum, samples);
            t = next;
        }
        if (through < 0) break;
        at.cell[through] += direction[through] > 0 ? 1 : -1;
        if (at.cell[through] < 0 || at.cell[through] > volume->dims[through] - 2) break;
    }
}

/* What the volume shows up to `limit` mm along the ray. */
static void volume_pixel(const ang_reference *reference, double x, double y, double limit, double rgba[4],
                         uint64_t *samples) {
    const ang_scene *scene = reference->scene;
    memset(rgba, 0, 4 * sizeof *rgba);
    ang_ray ray = ang_ray_through(&reference->frame, x, y);
    ray.leave = fmin(ray.leave, limit);
    if (!(ray.enter < ray.leave)) return;
    uint64_t evaluated = 0;
    gathered sum = {.light.transmittance = 1};
    walk(reference, &ray, &sum, &evaluated);
    if (samples) *samples += evaluated;
    double hu = sum.extreme;
    switch (scene->mode) {
    case ANG_MODE_DVR:
        memcpy(rgba, sum.light.colour, sizeof sum.light.colour);
        rgba[3] = 1 - sum.light.transmittance;
        return;
    case ANG_MODE_ISO:
        if (!sum.done) return;
        memcpy(rgba, sum.hit, sizeof sum.hit);
        rgba[3] = 1;
        return;
    case ANG_MODE_MEAN:
        hu = sum.weight > 0 ? sum.integral / sum.weight : -1000;
        break;
    case ANG_MODE_MIP:
    case ANG_MODE_MINIP:
        break;
    }
    rgba[0] = rgba[1] = rgba[2] = ang_scene_grey(scene, hu);
    rgba[3] = 1;
}

void ang_reference_pixel(const ang_reference *reference, double x, double y, double rgba[4], uint64_t *samples) {
    const ang_scene *scene = reference->scene;
    const ang_volume *volume = reference->volume;
    double t, colour[3];
    bool hit = scene->objects && ang_objects_hit(scene->objects, volume, scene, &reference->frame, x, y, &t, colour);
    bool limits = hit && ang_scene_limits_rays(scene);
    volume_pixel(reference, x, y, limits ? t : INFINITY, rgba, samples);
    if (!hit) return;
    double through = limits ? 1 - rgba[3] : 1;
    for (int c = 0; c < 3; c++) rgba[c] = (limits ? rgba[c] : 0) + through * colour[c];
    rgba[3] = 1;
}

typedef struct fill_job {
    const ang_reference *reference;
    ang_image *image;
    const ang_progress *progress;
    atomic_size_t rows_done;
    atomic_uint_fast64_t samples;
    atomic_bool cancelled;
} fill_job;

static void fill_rows(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    fill_job *job = context;
    uint64_t samples = 0;
    for (size_t y = begin; y < end; y++) {
        if (atomic_load(&job->cancelled)) return;
        for (int x = 0; x < job->image->width; x++) {
            float *out = job->image->rgba + 4 * (y * (size_t)job->image->width + (size_t)x);
            if (!isnan(out[3])) continue;
            double rgba[4];
            ang_reference_pixel(job->reference, x + 0.5, (double)y + 0.5, rgba, &samples);
            for (int c = 0; c < 4; c++) out[c] = (float)rgba[c];
        }
        double done = (double)(atomic_fetch_add(&job->rows_done, 1) + 1) / job->image->height;
        if (!ang_progress_update(job->progress, "rendering the reference", done)) atomic_store(&job->cancelled, true);
    }
    atomic_fetch_add(&job->samples, samples);
}

bool ang_reference_fill(const ang_reference *reference, ang_image *image, int threads, const ang_progress *progress,
                        uint64_t *samples, ang_error *err) {
    fill_job job = {.reference = reference, .image = image, .progress = progress};
    ang_parallel_for((size_t)image->height, 1, threads, fill_rows, &job);
    if (samples) *samples += job.samples;
    return !job.cancelled || ang_fail(err, ANG_INTERRUPTED, "interrupted while rendering the reference");
}

void ang_reference_blank(ang_image *image) {
    for (size_t i = 3; i < 4 * (size_t)image->width * (size_t)image->height; i += 4) image->rgba[i] = NAN;
}
