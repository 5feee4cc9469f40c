/* What is known of a scene, a renderer and its OpenGL before anything is built: the facts from which ang_plan_decide
 * decides, and what of a scene any method says of itself. For methods, with and without OpenGL. */
#ifndef ANG_RENDER_FACTS_H
#define ANG_RENDER_FACTS_H

#include "core/render/method.h"
#include "core/transfer/table_cache.h"

/* What of a scene costs lookups. */
bool ang_scene_needs_table(const ang_scene *scene);                            /* dvr, iso */
bool ang_scene_needs_phong(const ang_scene *scene);                            /* iso, dvr with Phong */
bool ang_scene_needs_weight(const ang_scene *scene, const ang_volume *volume); /* mean, where there is padding */
/* Texture lookups of one sample: the field, the table, six for a gradient, the weight. */
int ang_scene_lookups(const ang_scene *scene, const ang_volume *volume);

/* Adds to the plan what the scene itself takes, whatever the method, and everything that was decided. */
void ang_scene_explain(ang_plan *plan, const ang_scene *scene, const ang_volume *volume,
                       const ang_plan_decisions *decisions);

/* `table` must be up to date where the scene needs one. `sample_mm`: what a sample stands for, at most. */
ang_plan_facts ang_facts_make(ang_drawing drawing, const ang_gl *gl, const ang_volume *volume, const ang_scene *scene,
                              const ang_render_options *options, const ang_ray_frame *frame,
                              const ang_table_cache *table, double sample_mm);

/* Index units along each axis in `length` mm of a ray, at most. */
ang_vec3 ang_facts_margin(const ang_ray_frame *frame, double length);

#endif
