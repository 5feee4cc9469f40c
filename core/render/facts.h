/* What is known of a scene, a renderer and its OpenGL before anything is built: the facts from which ang_plan_decide
 * decides. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_FACTS_H
#define ANG_RENDER_FACTS_H

#include "core/render/context.h"
#include "core/render/method.h"
#include "core/render/table_texture.h"

/* `table` must be up to date where the scene needs one. `sample_mm`: what a sample stands for, at most. */
ang_plan_facts ang_facts_make(ang_drawing drawing, const ang_gl *gl, const ang_volume *volume, const ang_scene *scene,
                              const ang_render_options *options, const ang_ray_frame *frame,
                              const ang_table_texture *table, double sample_mm);

/* Index units along each axis in `length` mm of a ray, at most. */
ang_vec3 ang_facts_margin(const ang_ray_frame *frame, double length);

#endif
