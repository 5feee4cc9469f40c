/* A synthetic head CT angiogram with known truth: for tests, measurements and demonstrations. */
#ifndef ANG_VOLUME_PHANTOM_H
#define ANG_VOLUME_PHANTOM_H

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/volume/volume.h"

#include <stdint.h>

/* Axes of the head: LPS mm, the origin near the sella turcica, the circle of Willis around (0, 0, 8). The whole head
 * reaches about from -88 to 88 in x, -108 to 116 in y and -125 to 112 in z. */
typedef struct ang_phantom_params {
    int dims[3];          /* voxels, each >= 1; default 512, 512, 96 */
    double spacing_mm[3]; /* 0.01 to 1000; default 0 each: the field of view of 230.4 x 230.4 x 96 mm over dims (0.45,
                             0.45, 1) */
    ang_vec3 centre_mm;   /* the box's centre, LPS; default 0, 5, 8 */
    uint64_t seed;        /* of noise and small branches; default 1 */
    double noise_hu;      /* standard deviation, >= 0; default 8 */
    double artery_hu;     /* contrast in arteries; default 350 */
} ang_phantom_params;
extern const ang_phantom_params ang_phantom_params_default;

enum { ang_phantom_max_vessels = 128, ang_phantom_max_points = 14 };

/* One vessel: a tube of round cross-section whose centre line is the uniform Catmull-Rom curve through `points` (end
 * points doubled by reflection), its radius linear in the curve's parameter between those of the points. */
typedef struct ang_phantom_vessel {
    char name[48];
    bool arterial; /* false: a venous sinus */
    double hu;
    int count;                               /* of points, >= 2 */
    ang_vec3 points[ang_phantom_max_points]; /* LPS mm */
    double radii_mm[ang_phantom_max_points];
    double length_mm;
} ang_phantom_vessel;

/* What is in the head, known exactly. Plain value (about 80 kB: not for the stack of a small thread). */
typedef struct ang_phantom_truth {
    ang_phantom_params params; /* with the spacing that was used */
    /* brain: its mean, 30 to 40; bone: spongy and cortical of the skull (the face is softer, teeth have 1900 HU) */
    double artery_hu, vein_hu, brain_hu, soft_tissue_hu, bone_hu[2], air_hu;
    struct {
        ang_vec3 centre;    /* LPS mm */
        double diameter_mm; /* of the sphere */
        double neck_mm;     /* diameter of the opening into the parent artery */
        char parent[48];
    } aneurysm;
    struct {
        ang_vec3 centre;    /* LPS mm, narrowest place */
        ang_vec3 direction; /* unit, along the artery */
        double minimum_mm;  /* lumen diameter there */
        double normal_mm;   /* what it would be without */
        double length_mm;   /* full width; the radius narrows by a raised cosine over it */
        double percent;     /* 100 (1 - minimum / normal) */
        char parent[48];
    } stenosis;
    int vessel_count;
    ang_phantom_vessel vessels[ang_phantom_max_vessels];
} ang_phantom_truth;

/* Makes the volume (stored = HU + 1024, slope 1, intercept -1024, axes L, P, H) and, where `truth` is not NULL, what it
 * shows. Edges are ramps of 1.4 voxels across the surface (partial volume); half height lies exactly on the surface,
 * on thin vessels too. The result depends on `params` alone, not on `threads` (0: all): noise is a hash
 * of seed and voxel index. NULL with ANG_USAGE (dims, spacing or noise out of range), ANG_LIMIT, ANG_INTERRUPTED. Free
 * with ang_volume_free. Thread safe. */
ang_volume *ang_phantom_make(const ang_phantom_params *params, int threads, const ang_progress *progress,
                             ang_phantom_truth *truth, ang_error *err);

#endif
