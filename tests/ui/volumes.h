/* Volumes of which only the geometry matters, shared by the tests. */
#ifndef ANG_TESTS_UI_VOLUMES_H
#define ANG_TESTS_UI_VOLUMES_H

#include "tests/core/fixtures.h"

static inline double zero(int x, int y, int z) {
    (void)x, (void)y, (void)z;
    return 0;
}

/* 40 x 40 x 40 mm in 40 x 20 x 8 steps, with its first voxel at (-20, -20, -20). */
static inline ang_volume *cube(void) {
    ang_volume *volume = make_volume(41, 21, 9, (double[]){1, 2, 5}, zero);
    for (int i = 0; i < 3; i++) volume->affine.m[i][3] = -20;
    return volume;
}

#endif
