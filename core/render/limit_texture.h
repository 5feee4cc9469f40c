/* Where opaque geometry ends the rays of a picture, on the GL side. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_LIMIT_TEXTURE_H
#define ANG_RENDER_LIMIT_TEXTURE_H

#include "core/plan/decide.h"
#include "core/render/context.h"
#include "core/render/program.h"
#include "core/scene/object_layer.h"

/* R32F, one texel a pixel: ang_object_layer's limit_mm. Zero-initialise; owns all. */
typedef struct ang_limit_texture {
    ang_object_layer layer;
    unsigned texture;
    int width, height; /* of the texture */
} ang_limit_texture;

/* Makes the layer of the scene's objects, and the texture where they end rays; nothing for a scene without objects.
 * False with ANG_LIMIT or ANG_GL. */
bool ang_limit_texture_update(ang_limit_texture *limits, ang_gl *gl, const ang_volume *volume, const ang_scene *scene,
                              const ang_ray_frame *frame, int threads, ang_error *err);
/* Deletes everything. The context must be current. */
void ang_limit_texture_destroy(ang_limit_texture *limits);

/* ray.glsl with the parts that end rays; `follows`: whether the program follows rays, which are to end at the scene's
 * objects, if it has any, and at the clip plane, if that is used. */
void ang_parts_ray(ang_shader_source *source, const ang_scene *scene, const ang_plan_decisions *decisions,
                   bool follows);
/* Binds the texture for the programs that end rays at it; nothing where the scene ends none. */
void ang_limit_texture_bind(const ang_limit_texture *limits, const ang_scene *scene, unsigned program, int unit);
/* Joins the objects with the picture that has been read; nothing for a scene without. */
void ang_limit_texture_join(const ang_limit_texture *limits, const ang_scene *scene, ang_image *image);

#endif
