#include "core/render/limit_texture.h"

#include "core/render/scene_parts.h"
#include "core/render/target.h"

#include <glad/gl.h>
#include <shaders.h>

static bool has_objects(const ang_scene *scene) { return scene->objects && scene->objects->count > 0; }

static void make_texture(ang_limit_texture *limits, int width, int height) {
    if (limits->texture) glDeleteTextures(1, &limits->texture);
    glGenTextures(1, &limits->texture);
    glBindTexture(GL_TEXTURE_2D, limits->texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_R32F, width, height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    limits->width = width;
    limits->height = height;
}

bool ang_limit_texture_update(ang_limit_texture *limits, ang_gl *gl, const ang_volume *volume, const ang_scene *scene,
                              const ang_ray_frame *frame, int threads, ang_error *err) {
    if (!has_objects(scene)) return true;
    if (!ang_target_fits(gl, scene->width, scene->height, err)) return false;
    if (!ang_object_layer_make(&limits->layer, volume, scene, frame, threads, err)) return false;
    if (!ang_scene_limits_rays(scene)) return true;
    if (!limits->texture || limits->width != scene->width || limits->height != scene->height)
        make_texture(limits, scene->width, scene->height);
    glBindTexture(GL_TEXTURE_2D, limits->texture);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, scene->width, scene->height, GL_RED, GL_FLOAT, limits->layer.limit_mm);
    glBindTexture(GL_TEXTURE_2D, 0);
    return ang_gl_check(gl, err);
}

void ang_limit_texture_destroy(ang_limit_texture *limits) {
    if (limits->texture) glDeleteTextures(1, &limits->texture);
    ang_object_layer_clear(&limits->layer);
    *limits = (ang_limit_texture){.texture = 0};
}

void ang_parts_ray(ang_shader_source *source, const ang_scene *scene, const ang_plan_decisions *decisions,
                   bool follows) {
    if (follows && ang_scene_limits_rays(scene))
        ANG_SHADER_ADD(source, limit_objects);
    else
        ANG_SHADER_ADD(source, limit_none);
    ang_parts_half_space(source, follows && ang_plan_uses(decisions, ANG_PART_CLIP_PLANE));
    ANG_SHADER_ADD(source, ray);
}

void ang_limit_texture_bind(const ang_limit_texture *limits, const ang_scene *scene, unsigned program, int unit) {
    if (!ang_scene_limits_rays(scene)) return;
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_2D, limits->texture);
    ang_uniform_int(program, "ray_limits", unit);
}

void ang_limit_texture_join(const ang_limit_texture *limits, const ang_scene *scene, ang_image *image) {
    if (has_objects(scene)) ang_object_layer_join(&limits->layer, scene, image);
}
