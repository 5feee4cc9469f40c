#include "core/volume/volume.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <stdatomic.h>
#include <stdlib.h>

enum { voxels_per_piece = 1 << 18 };

ang_volume *ang_volume_create(const int dims[3], ang_error *err) {
    if (dims[0] < 1 || dims[1] < 1 || dims[2] < 1) {
        ang_fail(err, ANG_INPUT, "a volume of %d x %d x %d voxels does not exist", dims[0], dims[1], dims[2]);
        return NULL;
    }
    size_t count = ang_product3((size_t)dims[0], (size_t)dims[1], (size_t)dims[2]);
    if (count == 0 || count > SIZE_MAX / 4) {
        ang_fail(err, ANG_LIMIT, "a volume of %d x %d x %d voxels is too large", dims[0], dims[1], dims[2]);
        return NULL;
    }
    ang_volume *volume = ang_alloc(1, sizeof *volume, "volume", err);
    if (!volume) return NULL;
    volume->data = ang_alloc(count, sizeof *volume->data, "volume", err);
    if (!volume->data) {
        free(volume);
        return NULL;
    }
    for (int axis = 0; axis < 3; axis++) volume->dims[axis] = dims[axis];
    volume->slope = 1;
    volume->affine = ang_mat4_identity();
    return volume;
}

void ang_volume_free(ang_volume *volume) {
    if (!volume) return;
    free(volume->data);
    free(volume->padding);
    free(volume);
}

size_t ang_volume_count(const ang_volume *volume) {
    return (size_t)volume->dims[0] * (size_t)volume->dims[1] * (size_t)volume->dims[2];
}

double ang_volume_spacing(const ang_volume *volume, int axis) {
    return ang_vec3_length(ang_mat4_column(&volume->affine, axis));
}

double ang_volume_slice_distance(const ang_volume *volume) {
    ang_vec3 normal = ang_vec3_cross(ang_mat4_column(&volume->affine, 0), ang_mat4_column(&volume->affine, 1));
    return fabs(ang_vec3_dot(ang_vec3_unit(normal), ang_mat4_column(&volume->affine, 2)));
}

double ang_volume_smallest_spacing(const ang_volume *volume) {
    return fmin(ang_volume_spacing(volume, 0), fmin(ang_volume_spacing(volume, 1), ang_volume_spacing(volume, 2)));
}

void ang_volume_box(const ang_volume *volume, ang_vec3 *lower, ang_vec3 *upper) {
    double low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        bool flat = volume->dims[axis] == 1;
        low[axis] = flat ? -0.5 : 0;
        high[axis] = flat ? 0.5 : volume->dims[axis] - 1;
    }
    *lower = (ang_vec3){low[0], low[1], low[2]};
    *upper = (ang_vec3){high[0], high[1], high[2]};
}

double ang_volume_half_diagonal(const ang_volume *volume) {
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    ang_vec3 size = ang_vec3_sub(upper, lower);
    double longest = 0;
    for (int corner = 0; corner < 4; corner++) {
        ang_vec3 diagonal = {size.x, corner & 1 ? -size.y : size.y, corner & 2 ? -size.z : size.z};
        longest = fmax(longest, ang_vec3_length(ang_mat4_direction(&volume->affine, diagonal)));
    }
    return longest / 2;
}

ang_vec3 ang_volume_centre(const ang_volume *volume) {
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    return ang_mat4_point(&volume->affine, ang_vec3_scale(ang_vec3_add(lower, upper), 0.5));
}

uint16_t ang_volume_padding_value(const ang_volume *volume) {
    return (uint16_t)fmin(fmax(round(ang_volume_stored(volume, -1000)), 0), 65535);
}

typedef struct padding_job {
    ang_volume *volume;
    uint16_t from, to;
    atomic_size_t found;
} padding_job;

static void mark_words(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    padding_job *job = context;
    ang_volume *volume = job->volume;
    size_t count = ang_volume_count(volume), found = 0;
    for (size_t word = begin; word < end; word++) {
        uint64_t bits = 0;
        size_t base = word * 64, inside = count - base < 64 ? count - base : 64;
        for (size_t bit = 0; bit < inside; bit++)
            if (volume->data[base + bit] == job->from) {
                bits |= (uint64_t)1 << bit;
                volume->data[base + bit] = job->to;
            }
        volume->padding[word] |= bits;
        found += (size_t)__builtin_popcountll(bits);
    }
    atomic_fetch_add(&job->found, found);
}

bool ang_volume_mark_padding(ang_volume *volume, uint16_t padding_value, ang_error *err) {
    size_t words = (ang_volume_count(volume) + 63) / 64;
    if (!volume->padding) volume->padding = ang_alloc(words, sizeof *volume->padding, "padding mask", err);
    if (!volume->padding) return false;
    padding_job job = {volume, padding_value, ang_volume_padding_value(volume), 0};
    ang_parallel_for(words, voxels_per_piece / 64, 0, mark_words, &job);
    volume->padding_count += job.found;
    if (volume->padding_count == 0) {
        free(volume->padding);
        volume->padding = NULL;
    }
    return true;
}

typedef struct range_job {
    const ang_volume *volume;
    atomic_uint minimum, maximum;
} range_job;

static void find_range(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    range_job *job = context;
    const ang_volume *volume = job->volume;
    uint16_t low = UINT16_MAX, high = 0;
    if (!volume->padding) {
        for (size_t i = begin; i < end; i++) {
            uint16_t value = volume->data[i];
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
    } else {
        for (size_t i = begin; i < end; i++) {
            if (ang_volume_is_padding(volume, i)) continue;
            uint16_t value = volume->data[i];
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
    }
    unsigned seen = atomic_load(&job->minimum);
    while (low < seen && !atomic_compare_exchange_weak(&job->minimum, &seen, low)) {
    }
    seen = atomic_load(&job->maximum);
    while (high > seen && !atomic_compare_exchange_weak(&job->maximum, &seen, high)) {
    }
}

void ang_volume_update_range(ang_volume *volume, int threads) {
    range_job job = {volume, UINT16_MAX, 0};
    ang_parallel_for(ang_volume_count(volume), voxels_per_piece, threads, find_range, &job);
    bool all_padding = job.minimum > job.maximum;
    volume->minimum = all_padding ? volume->data[0] : (uint16_t)job.minimum;
    volume->maximum = all_padding ? volume->data[0] : (uint16_t)job.maximum;
}

bool ang_volume_find_padding(const ang_volume *volume, uint16_t *padding_value) {
    size_t nx = (size_t)volume->dims[0], ny = (size_t)volume->dims[1], nz = (size_t)volume->dims[2];
    uint16_t candidate = volume->data[0];
    for (size_t i = 0; i < 4 && i < nz; i++) {
        /* The first corner may be a stray pixel; take the lowest corner of a few slices. */
        const uint16_t *slice = volume->data + nx * ny * (i * (nz - 1) / 3);
        uint16_t corners[4] = {slice[0], slice[nx - 1], slice[nx * (ny - 1)], slice[nx * ny - 1]};
        for (int c = 0; c < 4; c++) candidate = corners[c] < candidate ? corners[c] : candidate;
    }
    if (!(ang_volume_hu(volume, candidate) < -1024)) return false;
    size_t slices = 0;
    for (size_t z = 0; z < nz; z++) {
        const uint16_t *slice = volume->data + nx * ny * z;
        uint16_t corners[4] = {slice[0], slice[nx - 1], slice[nx * (ny - 1)], slice[nx * ny - 1]};
        int filled = 0;
        for (int c = 0; c < 4; c++) filled += corners[c] == candidate;
        slices += filled >= 3;
    }
    if (slices * 4 < nz * 3) return false;
    *padding_value = candidate;
    return true;
}

/* The eight voxels around a point clamped to the box, and the fractions between them. */
typedef struct cell {
    size_t corner[8];
    double x, y, z;
} cell;

static cell cell_around(const ang_volume *volume, ang_vec3 index) {
    double position[3] = {index.x, index.y, index.z}, fraction[3];
    size_t low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        int last = volume->dims[axis] - 1;
        double p = fmin(fmax(position[axis], 0), last);
        int i = (int)p;
        if (i > last - 1) i = last > 0 ? last - 1 : 0;
        fraction[axis] = p - i;
        low[axis] = (size_t)i;
        high[axis] = (size_t)(i < last ? i + 1 : i);
    }
    cell found = {.x = fraction[0], .y = fraction[1], .z = fraction[2]};
    size_t row = (size_t)volume->dims[0], slice = row * (size_t)volume->dims[1];
    for (int c = 0; c < 8; c++)
        found.corner[c] = (c & 1 ? high : low)[0] + row * (c & 2 ? high : low)[1] + slice * (c & 4 ? high : low)[2];
    return found;
}

static double blend(const cell *at, const double value[8]) {
    double x[4], y[2];
    for (int i = 0; i < 4; i++) x[i] = value[2 * i] + at->x * (value[2 * i + 1] - value[2 * i]);
    for (int i = 0; i < 2; i++) y[i] = x[2 * i] + at->y * (x[2 * i + 1] - x[2 * i]);
    return y[0] + at->z * (y[1] - y[0]);
}

double ang_volume_sample(const ang_volume *volume, ang_vec3 index) {
    cell at = cell_around(volume, index);
    double value[8];
    for (int c = 0; c < 8; c++) value[c] = volume->data[at.corner[c]];
    return blend(&at, value);
}

ang_vec3 ang_volume_gradient(const ang_volume *volume, const ang_mat4 *to_index, ang_vec3 index) {
    ang_vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    ang_vec3 difference = {
        ang_volume_sample(volume, ang_vec3_add(index, x)) - ang_volume_sample(volume, ang_vec3_sub(index, x)),
        ang_volume_sample(volume, ang_vec3_add(index, y)) - ang_volume_sample(volume, ang_vec3_sub(index, y)),
        ang_volume_sample(volume, ang_vec3_add(index, z)) - ang_volume_sample(volume, ang_vec3_sub(index, z))};
    return ang_mat4_transposed_direction(to_index, ang_vec3_scale(difference, volume->slope / 2));
}
