/* One pass over the picture in which each fragment follows its ray: what singlepass is, and envelope after it has found
 * where rays begin and end. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_RAY_PASS_H
#define ANG_RENDER_RAY_PASS_H

#include "core/render/limit_texture.h"
#include "core/render/method.h"
#include "core/render/program.h"
#include "core/render/table_texture.h"
#include "core/render/target.h"
#include "core/render/volume_texture.h"

/* Zero-initialise; owns its GL objects. */
typedef struct ang_ray_pass {
    const char *method; /* its name, for messages */
    ang_gl *gl;
    const ang_volume *volume;
    ang_volume_texture field; /* holds what ang_ray_pass_hold was asked for */
    ang_table_texture table;
    ang_limit_texture limits; /* opaque geometry */
    ang_programs programs;
    ang_target target;
    unsigned vertices; /* no attributes, but a draw needs one bound */
} ang_ray_pass;

/* What a method adds to the pass: the parts that bound rays and skip along them, and their uniforms. */
typedef struct ang_ray_limits {
    void (*parts)(const void *context, ang_shader_source *source);
    void (*uniforms)(const void *context, unsigned program, const ang_ray_frame *frame);
    const void *context;
    bool gradients; /* values and gradients from ang_gradient_texture, whose uniforms are set with the others */
    const ang_plan_decisions *decisions;
} ang_ray_limits;

/* Makes room for the volume, whose voxels ang_ray_pass_hold uploads. False with ANG_GL where `gl` is NULL, and with
 * ANG_LIMIT. */
bool ang_ray_pass_make(ang_ray_pass *pass, const char *method, ang_gl *gl, const ang_volume *volume,
                       const ang_render_options *options, ang_error *err);
void ang_ray_pass_destroy(ang_ray_pass *pass);

/* Checks scene and options, makes the frame, and brings tables and weights up to date: what comes before drawing and
 * explaining alike. False as ang_method's `render`. */
bool ang_ray_pass_prepare(ang_ray_pass *pass, const ang_scene *scene, const ang_render_options *options,
                          ang_ray_frame *frame, ang_error *err);
/* The facts of what has been prepared. */
ang_plan_facts ang_ray_pass_facts(const ang_ray_pass *pass, ang_drawing drawing, const ang_scene *scene,
                                  const ang_render_options *options, const ang_ray_frame *frame);
/* Uploads voxels [first, end) where they are not there yet; `first` NULL: all. Adds the ms that it took to `took`. */
bool ang_ray_pass_hold(ang_ray_pass *pass, const int *first, const int *end, double *took, ang_error *err);
/* Draws what has been prepared, band by band, and reads it; `stats` may be NULL, else its samples, fragments and step
 * are set. False with ANG_LIMIT, ANG_GL, ANG_INTERRUPTED. */
bool ang_ray_pass_draw(ang_ray_pass *pass, const ang_scene *scene, const ang_render_options *options,
                       const ang_ray_frame *frame, const ang_ray_limits *limits, ang_image *image,
                       ang_frame_stats *stats, const ang_progress *progress, ang_error *err);
/* Adds scene and pass to the plan. */
void ang_ray_pass_explain(const ang_ray_pass *pass, const ang_scene *scene, const ang_render_options *options,
                          const ang_ray_limits *limits, ang_plan *plan);

/* ang_frame_stats' note for this scene after ang_ray_pass_prepare, or NULL. */
const char *ang_ray_pass_note(const ang_ray_pass *pass, const ang_scene *scene);

/* Millimetres between samples. */
double ang_ray_step(const ang_volume *volume, const ang_render_options *options);

#endif
