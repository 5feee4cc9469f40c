/* A scene as uniforms of the GLSL parts in shaders/. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_SCENE_UNIFORMS_H
#define ANG_RENDER_SCENE_UNIFORMS_H

#include "core/render/volume_texture.h"
#include "core/scene/scene.h"

/* ray.glsl */
void ang_uniforms_ray(unsigned program, const ang_ray_frame *frame);
/* field.glsl and weight_*.glsl; binds the values to texture unit `unit` and the weight, where there is one, to the
 * next.
 */
void ang_uniforms_field(unsigned program, const ang_volume_texture *texture, const ang_volume *volume,
                        const ang_ray_frame *frame, int unit);
/* gradient.glsl and shade_phong.glsl */
void ang_uniforms_phong(unsigned program, const ang_volume *volume, const ang_scene *scene, const ang_ray_frame *frame);
/* window.glsl */
void ang_uniforms_window(unsigned program, const ang_volume *volume, const ang_scene *scene);

#endif
