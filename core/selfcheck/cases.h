/* The functions of the cases, by file; cases.c has the table. Only files of core/selfcheck/ include it. Each measures
 * on `bench`; false with the error of a method, ANG_LIMIT, or ANG_INTERRUPTED. */
#ifndef ANG_SELFCHECK_CASES_H
#define ANG_SELFCHECK_CASES_H

#include "core/selfcheck/bench.h"

typedef bool ang_case_run(ang_bench *bench, ang_error *err);

/* media.c: homogeneous media */
ang_case_run ang_case_any_step, ang_case_any_extinction, ang_case_thin_volumes, ang_case_extreme_steps;
/* classification.c: from values to colours */
ang_case_run ang_case_ramp, ang_case_step_transfer, ang_case_spike, ang_case_opaque, ang_case_all_values,
    ang_case_bad_points;
/* views.c: cameras and grids */
ang_case_run ang_case_spacing, ang_case_symmetry, ang_case_inside, ang_case_from_afar, ang_case_field_of_view,
    ang_case_far_origin;
/* skipping.c: what is left out must not show */
ang_case_run ang_case_transparent, ang_case_bricks, ang_case_bright_voxels, ang_case_termination;
/* surfaces.c: gradients, padding, a sphere */
ang_case_run ang_case_phong, ang_case_flat_and_padding, ang_case_sphere;
/* proxies.c: polygons */
ang_case_run ang_case_polygons;
/* cuts.c: the clip plane */
ang_case_run ang_case_clip_plane;
/* orders.c: refinement */
ang_case_run ang_case_grid_order, ang_case_pixel_order, ang_case_against_reference;

#endif
