/* Which GLSL parts of shaders/ a scene needs, and its uniforms: one place for all methods. Include only within
 * core/render/ and its tests. */
#ifndef ANG_RENDER_SCENE_PARTS_H
#define ANG_RENDER_SCENE_PARTS_H

#include "core/render/facts.h"
#include "core/render/program.h"
#include "core/render/table_texture.h"
#include "core/render/volume_texture.h"
#include "core/scene/clip_space.h"
#include "core/scene/scene.h"

/* The texture units that the parts read from; methods take further ones from ANG_UNIT_FREE on. */
enum {
    ANG_UNIT_TABLE,
    ANG_UNIT_EXTINCTION,
    ANG_UNIT_FIELD,
    ANG_UNIT_WEIGHT,
    ANG_UNIT_LIMIT,
    ANG_UNIT_PREFIX,
    ANG_UNIT_PLATEAUS,
    ANG_UNIT_FREE
};

/* Whether steps are classified by all values between their ends (ang_table_texture_classify). */
bool ang_scene_whole_steps(const ang_scene *scene, const ang_table_texture *table);
/* What that changes of the facts that ang_facts_make knows. */
void ang_table_texture_facts(const ang_table_texture *table, const ang_scene *scene, ang_plan_facts *facts);
/* How they are in mode dvr; auto in others. */
ang_classify ang_scene_classification(const ang_scene *scene, const ang_table_texture *table);
/* Lookups that a step takes beyond these where it is classified by the values between its ends: prefix integrals, and
 * where `both_ends` are looked up the value of the second. */
int ang_scene_step_lookups(const ang_scene *scene, const ang_table_texture *table, bool both_ends);

/* Adds how steps are classified in mode dvr. */
void ang_scene_explain_steps(ang_plan *plan, const ang_scene *scene, const ang_table_texture *table);

/* Where values and gradients come from. */
typedef enum ang_field_kind {
    ANG_FIELD_HARDWARE, /* the texture unit interpolates */
    ANG_FIELD_MANUAL,   /* the shader does: --manual-filter */
    ANG_FIELD_GRADIENTS /* from the texture that has gradients beside the values */
} ang_field_kind;

/* Parts: field_at; stored_from, transfer_at and shade, or window_grey; weight_at. */
void ang_parts_field(ang_shader_source *source, ang_field_kind kind);
void ang_parts_classification(ang_shader_source *source, const ang_scene *scene, ang_field_kind kind,
                              const ang_plan_decisions *decisions);
void ang_parts_weight(ang_shader_source *source, const ang_scene *scene, const ang_volume *volume, ang_field_kind kind);

/* step_whole, which parts that bound rays or skip need before them. */
void ang_parts_steps(ang_shader_source *source, const ang_scene *scene, const ang_table_texture *table);
/* Mode dvr: opacity_of, step_end and step_medium; no exponential where no sample is thick enough. */
void ang_parts_medium(ang_shader_source *source, const ang_table_texture *table, const ang_plan_decisions *decisions);

/* march, the loop along a ray, of the scene's mode, with the parts that it needs beside field and classification; the
 * parts that bound it and that skip (bounds_*.glsl, skip_*.glsl) must be there. `seeks`: whether march_dvr_seek.glsl
 * may take the samples where rays do not skip; `count_shown`: as in ang_render_options. */
void ang_parts_march(ang_shader_source *source, const ang_scene *scene, const ang_volume *volume, ang_field_kind kind,
                     const ang_table_texture *table, const ang_plan_decisions *decisions, bool seeks, bool count_shown);

/* half_space_cut, which ray.glsl needs before it: `cuts`: whether the clip plane cuts rays. */
void ang_parts_half_space(ang_shader_source *source, bool cuts);

/* clip_x, clip_y and clip_w of what projects places of index space. */
void ang_uniforms_clip_space(unsigned program, const ang_clip_space *space);
/* ray.glsl */
void ang_uniforms_ray(unsigned program, const ang_ray_frame *frame);
/* field*.glsl, trilinear.glsl and weight_*.glsl; binds the textures. */
void ang_uniforms_field(unsigned program, const ang_volume_texture *texture, const ang_volume *volume,
                        const ang_ray_frame *frame);
/* Everything else that ang_parts_classification and the modes' parts read: table, Phong, window, iso value, mean.
 * `table` may be NULL where ang_scene_needs_table says no. */
void ang_uniforms_scene(unsigned program, const ang_scene *scene, const ang_volume *volume, const ang_ray_frame *frame,
                        const ang_table_texture *table);

#endif
