#include "core/render/scene_uniforms.h"

#include "core/render/program.h"

#include <glad/gl.h>

void ang_uniforms_ray(unsigned program, const ang_ray_frame *frame) {
    bool perspective = frame->perspective;
    ang_uniform_vec3(program, "ray_origin", frame->origin);
    ang_uniform_vec3(program, "ray_step_x", frame->step_x);
    ang_uniform_vec3(program, "ray_step_y", frame->step_y);
    ang_uniform_vec3(program, "ray_from_eye", perspective ? ang_vec3_sub(frame->origin, frame->eye) : frame->axis);
    ang_uniform_vec3(program, "ray_from_eye_mm",
                     perspective ? ang_vec3_sub(frame->origin_mm, frame->eye_mm) : frame->axis_mm);
    ang_uniform_vec3(program, "ray_step_x_mm", frame->step_x_mm);
    ang_uniform_vec3(program, "ray_step_y_mm", frame->step_y_mm);
    ang_uniform_vec3(program, "ray_axis_mm", frame->axis_mm);
    ang_uniform_float(program, "ray_spread", perspective ? 1 : 0);
    ang_uniform_float(program, "ray_near_depth", frame->near_depth);
    ang_uniform_vec3(program, "box_lower", frame->lower);
    ang_uniform_vec3(program, "box_upper", frame->upper);
}

void ang_uniforms_field(unsigned program, const ang_volume_texture *texture, const ang_volume *volume,
                        const ang_ray_frame *frame, int unit) {
    const double dims[3] = {volume->dims[0], volume->dims[1], volume->dims[2]};
    ang_vec3 scale = {1 / dims[0], 1 / dims[1], 1 / dims[2]};
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_3D, texture->values);
    ang_uniform_int(program, "field_values", unit);
    ang_uniform_vec3(program, "field_dims", (ang_vec3){dims[0], dims[1], dims[2]});
    ang_uniform_vec3(program, "field_scale", scale);
    ang_uniform_vec3(program, "field_offset",
                     (ang_vec3){(frame->centre.x + 0.5) * scale.x, (frame->centre.y + 0.5) * scale.y,
                                (frame->centre.z + 0.5) * scale.z});
    if (!texture->weight) return;
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit + 1);
    glBindTexture(GL_TEXTURE_3D, texture->weight);
    ang_uniform_int(program, "weight_values", unit + 1);
}

void ang_uniforms_phong(unsigned program, const ang_volume *volume, const ang_scene *scene,
                        const ang_ray_frame *frame) {
    ang_uniform_transposed(program, "gradient_to_mm", &frame->to_index, 0.5 * volume->slope);
    ang_uniform_float(program, "phong_ambient", scene->phong.ambient);
    ang_uniform_float(program, "phong_diffuse", scene->phong.diffuse);
    ang_uniform_float(program, "phong_specular", scene->phong.specular);
    ang_uniform_float(program, "phong_power", scene->phong.power);
    ang_uniform_float(program, "phong_g0", scene->phong.g0);
}

void ang_uniforms_window(unsigned program, const ang_volume *volume, const ang_scene *scene) {
    /* A window of no width is a threshold; its scale must stay finite. */
    double width = fmax(scene->window_width, 1e-9);
    ang_uniform_float(program, "window_lower", ang_volume_stored(volume, scene->window_centre - width / 2));
    ang_uniform_float(program, "window_scale", volume->slope / width);
}
