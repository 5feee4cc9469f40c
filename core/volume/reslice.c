#include "core/volume/reslice.h"

#include "core/base/parallel.h"

#include <string.h>

/* Voxels by which a place may lie outside the box and still count as on its face: rounding of the affine. */
static const double slack = 1e-4;

static const char *const slab_names[] = {"mean", "mip", "minip"};
enum { slab_count = sizeof slab_names / sizeof *slab_names };

const char *ang_slab_name(ang_slab slab) { return (unsigned)slab < slab_count ? slab_names[slab] : NULL; }

int ang_slab_from_name(const char *name) {
    for (int i = 0; i < slab_count; i++)
        if (strcmp(slab_names[i], name) == 0) return i;
    return -1;
}

/* The plane in voxel index space. */
typedef struct job {
    const ang_volume *volume;
    const ang_reslice_plane *plane;
    float *hu;
    double origin[3], step_x[3], step_y[3], step_z[3]; /* step_z: from plane to plane of the slab */
    double lower[3], upper[3];
    int planes;
} job;

static void to_array(ang_vec3 v, double out[3]) {
    for (int axis = 0; axis < 3; axis++) out[axis] = ang_vec3_at(v, axis);
}

static ang_vec3 normal_of(const ang_reslice_plane *plane) {
    return ang_vec3_unit(ang_vec3_cross(plane->step_x, plane->step_y));
}

int ang_reslice_planes(const ang_volume *volume, const ang_reslice_plane *plane) {
    ang_mat4 to_index;
    if (!(plane->thickness_mm > 0) || !ang_mat4_inverse(&volume->affine, &to_index)) return 1;
    double across[3], most = 0;
    to_array(ang_mat4_direction(&to_index, normal_of(plane)), across);
    for (int axis = 0; axis < 3; axis++) most = fmax(most, fabs(across[axis]));
    double voxels = ceil(plane->thickness_mm * most - 1e-9);
    if (plane->slab == ANG_SLAB_MEAN) return (int)fmin(fmax(voxels, 1), ANG_RESLICE_MOST_PLANES);
    return (int)fmin(2 * fmax(voxels, 1) + 1, ANG_RESLICE_MOST_PLANES + 1);
}

/* The pixels [first, end) of a row from `start` on that lie in the box. */
static void clip_row(const job *job, const double start[3], int *first, int *end) {
    double low = 0, high = job->plane->width - 1;
    for (int axis = 0; axis < 3; axis++) {
        double step = job->step_x[axis];
        double to_lower = job->lower[axis] - slack - start[axis], to_upper = job->upper[axis] + slack - start[axis];
        if (step == 0) {
            if (to_lower > 0 || to_upper < 0) high = -1;
            continue;
        }
        low = fmax(low, fmin(to_lower / step, to_upper / step));
        high = fmin(high, fmax(to_lower / step, to_upper / step));
    }
    *first = *end = 0;
    if (!(low <= high)) return;
    *first = (int)ceil(low);
    *end = (int)floor(high) + 1;
}

/* The lower of the two voxels around a place along an axis, and how far beyond it the place lies. */
static inline size_t cell(double at, int dim, double *fraction) {
    double top = dim - 1;
    at = at < 0 ? 0 : at > top ? top : at;
    int i = (int)at;
    if (i > dim - 2) i = dim < 2 ? 0 : dim - 2;
    *fraction = at - i;
    return (size_t)i;
}

static inline double mix(double a, double b, double t) { return a + t * (b - a); }

/* A piece of a row while its planes are gone over. */
enum { PIECE = 256 };
typedef struct piece {
    double value[PIECE];
    int planes[PIECE]; /* that have the pixel inside the box */
} piece;

static inline double sample(const ang_volume *volume, const double at[3]) {
    const int *dims = volume->dims;
    double fx, fy, fz;
    size_t x = cell(at[0], dims[0], &fx), y = cell(at[1], dims[1], &fy), z = cell(at[2], dims[2], &fz);
    /* An axis of one voxel has no neighbour. */
    size_t dx = dims[0] > 1 ? 1 : 0, dy = dims[1] > 1 ? (size_t)dims[0] : 0;
    size_t dz = dims[2] > 1 ? (size_t)dims[0] * (size_t)dims[1] : 0;
    const uint16_t *v = volume->data + (z * (size_t)dims[1] + y) * (size_t)dims[0] + x;
    return mix(mix(mix(v[0], v[dx], fx), mix(v[dy], v[dy + dx], fx), fy),
               mix(mix(v[dz], v[dz + dx], fx), mix(v[dz + dy], v[dz + dy + dx], fx), fy), fz);
}

static inline double sample_nearest(const ang_volume *volume, const double at[3]) {
    size_t index[3];
    for (int axis = 0; axis < 3; axis++) {
        double whole = floor(at[axis] + 0.5), top = volume->dims[axis] - 1;
        index[axis] = (size_t)(whole < 0 ? 0 : whole > top ? top : whole);
    }
    return volume->data[(index[2] * (size_t)volume->dims[1] + index[1]) * (size_t)volume->dims[0] + index[0]];
}

/* Adds the pixels [first, end) of one plane to the piece that begins at pixel `begin`. */
static void add(const job *job, const double start[3], int first, int end, int begin, piece *piece) {
    ang_slab slab = job->plane->slab;
    for (int i = first; i < end; i++) {
        const double at[3] = {start[0] + i * job->step_x[0], start[1] + i * job->step_x[1],
                              start[2] + i * job->step_x[2]};
        double value = job->plane->nearest ? sample_nearest(job->volume, at) : sample(job->volume, at);
        double *to = &piece->value[i - begin];
        if (piece->planes[i - begin]++ == 0)
            *to = value;
        else
            *to = slab == ANG_SLAB_MIP ? fmax(*to, value) : slab == ANG_SLAB_MINIP ? fmin(*to, value) : *to + value;
    }
}

static void rows(void *context, size_t begin_row, size_t end_row, int worker) {
    (void)worker;
    const job *job = context;
    int width = job->plane->width;
    bool mean = job->plane->slab == ANG_SLAB_MEAN;
    piece piece;
    for (size_t j = begin_row; j < end_row; j++)
        for (int begin = 0; begin < width; begin += PIECE) {
            int end = begin + PIECE < width ? begin + PIECE : width;
            memset(&piece, 0, sizeof piece);
            for (int k = 0; k < job->planes; k++) {
                double start[3];
                for (int axis = 0; axis < 3; axis++)
                    start[axis] = job->origin[axis] + (double)j * job->step_y[axis] +
                                  (k - 0.5 * (job->planes - 1)) * job->step_z[axis];
                int first, last;
                clip_row(job, start, &first, &last);
                add(job, start, first > begin ? first : begin, last < end ? last : end, begin, &piece);
            }
            float *row = job->hu + j * (size_t)width;
            for (int i = begin; i < end; i++) {
                int planes = piece.planes[i - begin];
                double value = mean && planes > 1 ? piece.value[i - begin] / planes : piece.value[i - begin];
                row[i] = planes > 0 ? (float)ang_volume_hu(job->volume, value) : NAN;
            }
        }
}

bool ang_reslice(const ang_volume *volume, const ang_reslice_plane *plane, int threads, float *hu, ang_error *err) {
    ang_mat4 to_index;
    if (plane->width < 1 || plane->height < 1)
        return ang_fail(err, ANG_USAGE, "a slice of %d x %d pixels does not exist", plane->width, plane->height);
    ang_vec3 normal = normal_of(plane);
    if (!(ang_vec3_length(normal) > 0.5)) return ang_fail(err, ANG_USAGE, "the two directions of a slice are parallel");
    if (!ang_mat4_inverse(&volume->affine, &to_index))
        return ang_fail(err, ANG_GEOMETRY, "the volume's axes lie in one plane or its spacing is zero");
    job job = {.volume = volume, .plane = plane, .hu = hu, .planes = ang_reslice_planes(volume, plane)};
    to_array(ang_mat4_point(&to_index, plane->origin), job.origin);
    to_array(ang_mat4_direction(&to_index, plane->step_x), job.step_x);
    to_array(ang_mat4_direction(&to_index, plane->step_y), job.step_y);
    int steps = plane->slab == ANG_SLAB_MEAN || job.planes < 2 ? job.planes : job.planes - 1;
    to_array(ang_mat4_direction(&to_index, ang_vec3_scale(normal, plane->thickness_mm / steps)), job.step_z);
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    to_array(lower, job.lower);
    to_array(upper, job.upper);
    ang_parallel_for((size_t)plane->height, 8, threads, rows, &job);
    return true;
}
