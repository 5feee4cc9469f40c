/* Small volumes and transfer functions with known answers, shared by the tests. */
#ifndef ANG_TESTS_CORE_FIXTURES_H
#define ANG_TESTS_CORE_FIXTURES_H

/* cmocka.h needs these first. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after them */
#include <cmocka.h>

#include "core/scene/scene.h"
#include "core/transfer/transfer.h"
#include "core/volume/volume.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Checks that two numbers agree to `tolerance`, and prints both where they do not. */
#define assert_close(actual, expected, tolerance)                                                                      \
    do {                                                                                                               \
        double actual_ = (actual), expected_ = (expected), tolerance_ = (tolerance);                                   \
        if (!(fabs(actual_ - expected_) <= tolerance_))                                                                \
            fail_msg("%s is %.17g, not %.17g within %g", #actual, actual_, expected_, tolerance_);                     \
    } while (0)

/* A volume of the given size and spacing (mm) whose voxels are `value(x, y, z)`, HU = stored - 1024. */
static inline ang_volume *make_volume(int nx, int ny, int nz, const double spacing[3], double (*value)(int, int, int)) {
    int dims[3] = {nx, ny, nz};
    ang_volume *volume = ang_volume_create(dims, NULL);
    assert_non_null(volume);
    volume->intercept = -1024;
    for (int axis = 0; axis < 3; axis++) volume->affine.m[axis][axis] = spacing[axis];
    for (int z = 0, i = 0; z < nz; z++)
        for (int y = 0; y < ny; y++)
            for (int x = 0; x < nx; x++) volume->data[i++] = (uint16_t)lround(value(x, y, z) + 1024);
    ang_volume_update_range(volume, 1);
    return volume;
}

/* The same extinction per mm and colour at every HU. */
static inline ang_transfer *constant_transfer(double extinction, double r, double g, double b) {
    ang_transfer_point point = {.hu = 0, .colour = {r, g, b}, .opacity = extinction};
    ang_transfer *transfer = ang_transfer_create(&point, 1, 1, true, NULL, NULL);
    assert_non_null(transfer);
    return transfer;
}

/* Millimetres of a pixel's ray in the box. */
static inline double ray_length(const ang_volume *volume, const ang_scene *scene, int pixel) {
    ang_ray_frame frame;
    assert_true(ang_ray_frame_make(volume, scene, &frame, NULL));
    ang_ray ray = ang_ray_through(&frame, pixel % scene->width + 0.5, pixel / scene->width + 0.5);
    return fmax(ray.leave - ray.enter, 0);
}

/* Deterministic numbers in [0, 1) (xorshift). */
static inline double random_unit(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (double)(*state >> 11) / 9007199254740992.0;
}

#endif
