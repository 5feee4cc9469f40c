/* Regions to measure, shared by the tests. */
#ifndef ANG_TESTS_CORE_REGIONS_H
#define ANG_TESTS_CORE_REGIONS_H

#include "core/volume/measures.h"

static inline ang_measurement region(ang_measure_kind kind, ang_vec3 from, ang_vec3 to, ang_vec3 right, ang_vec3 down) {
    return (ang_measurement){.kind = kind, .point = {from, to}, .right = right, .down = down};
}

static inline ang_measurement axial_region(ang_measure_kind kind, double x0, double y0, double x1, double y1,
                                           double z) {
    return region(kind, (ang_vec3){x0, y0, z}, (ang_vec3){x1, y1, z}, (ang_vec3){1, 0, 0}, (ang_vec3){0, 1, 0});
}

#endif
