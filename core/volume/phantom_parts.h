/* Parts of the phantom: private to core/volume/phantom*.c. */
#ifndef ANG_VOLUME_PHANTOM_PARTS_H
#define ANG_VOLUME_PHANTOM_PARTS_H

#include "core/volume/phantom.h"

/* The HU of the head without vessels at a point (LPS mm); `edge` is the width of partial-volume ramps in mm. `channel`
 * is how far (0..1) a channel for a vessel opens the bone here. Pure, thread safe. */
double ang_phantom_head_hu(ang_vec3 point, double edge, double channel);

/* Signed distance (mm, about) to the inner surface of the skull; negative in the cranial cavity. */
double ang_phantom_cavity(ang_vec3 point);

/* The point moved along the gradient until it lies `distance` mm from the cavity's surface. */
ang_vec3 ang_phantom_on_skull(ang_vec3 point, double distance);

/* Fills vessels, aneurysm and stenosis. */
void ang_phantom_tree(uint64_t seed, ang_phantom_truth *truth);

/* Centre and radius of a vessel at u in [0, count - 1]. */
ang_vec3 ang_phantom_vessel_at(const ang_phantom_vessel *vessel, double u, double *radius);

/* 64 random bits of a key (splitmix64 finaliser, Steele, Lea & Flood, OOPSLA 2014). */
static inline uint64_t ang_phantom_hash(uint64_t key) {
    key += 0x9E3779B97F4A7C15u;
    key = (key ^ key >> 30) * 0xBF58476D1CE4E5B9u;
    key = (key ^ key >> 27) * 0x94D049BB133111EBu;
    return key ^ key >> 31;
}

/* How much of a voxel lies inside a surface at signed distance `distance`, for a ramp of width `edge`. */
static inline double ang_phantom_inside(double distance, double edge) {
    double covered = 0.5 - distance / edge;
    return covered < 0 ? 0 : covered > 1 ? 1 : covered;
}

#endif
