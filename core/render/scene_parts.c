#include "core/render/scene_parts.h"

#include <glad/gl.h>
#include <shaders.h>

bool ang_scene_whole_steps(const ang_scene *scene, const ang_table_texture *table) {
    return scene->mode == ANG_MODE_DVR && table->classification.prefix;
}

void ang_table_texture_facts(const ang_table_texture *table, const ang_scene *scene, ang_plan_facts *facts) {
    facts->whole_steps = ang_scene_whole_steps(scene, table);
    if (ang_scene_needs_table(scene)) facts->extinction = ang_table_texture_greatest(table);
}

ang_classify ang_scene_classification(const ang_scene *scene, const ang_table_texture *table) {
    if (scene->mode != ANG_MODE_DVR) return ANG_CLASSIFY_AUTO;
    return table->classification.prefix ? ANG_CLASSIFY_PREFIX : ANG_CLASSIFY_MIDPOINT;
}

int ang_scene_step_lookups(const ang_scene *scene, const ang_table_texture *table, bool both_ends) {
    if (!ang_scene_whole_steps(scene, table)) return 0;
    /* The plateau's place, and its entries. */
    return 2 + (table->prefix.plateaus.texture ? 2 : 0) + (both_ends ? 2 : 0);
}

void ang_scene_explain_steps(ang_plan *plan, const ang_scene *scene, const ang_table_texture *table) {
    if (scene->mode == ANG_MODE_DVR)
        ang_classification_explain(&table->classification, table->prefix.plateaus.texture != 0, plan);
}

void ang_parts_field(ang_shader_source *source, ang_field_kind kind) {
    ANG_SHADER_ADD(source, field);
    if (kind == ANG_FIELD_GRADIENTS) {
        ANG_SHADER_ADD(source, field_gradient);
    } else if (kind == ANG_FIELD_MANUAL) {
        ANG_SHADER_ADD(source, trilinear);
        ANG_SHADER_ADD(source, field_manual);
    } else {
        ANG_SHADER_ADD(source, field_hardware);
    }
}

void ang_parts_classification(ang_shader_source *source, const ang_scene *scene, ang_field_kind kind,
                              const ang_plan_decisions *decisions) {
    if (!ang_scene_needs_table(scene)) {
        ANG_SHADER_ADD(source, window);
        return;
    }
    if (ang_plan_uses(decisions, ANG_PART_ROUNDING))
        ANG_SHADER_ADD(source, stored_exact);
    else
        ANG_SHADER_ADD(source, stored_near);
    if (ang_plan_uses(decisions, ANG_PART_COLOUR))
        ANG_SHADER_ADD(source, transfer_colours);
    else
        ANG_SHADER_ADD(source, transfer_one);
    ANG_SHADER_ADD(source, transfer);
    if (ang_plan_uses(decisions, ANG_PART_GRADIENTS)) {
        if (kind == ANG_FIELD_GRADIENTS)
            ANG_SHADER_ADD(source, gradient_texture);
        else
            ANG_SHADER_ADD(source, gradient);
        ANG_SHADER_ADD(source, shade_phong);
    } else {
        ANG_SHADER_ADD(source, shade_none);
    }
}

void ang_parts_steps(ang_shader_source *source, const ang_scene *scene, const ang_table_texture *table) {
    if (ang_scene_whole_steps(scene, table))
        ANG_SHADER_ADD(source, step_whole);
    else
        ANG_SHADER_ADD(source, step_middle);
}

void ang_parts_medium(ang_shader_source *source, const ang_table_texture *table, const ang_plan_decisions *decisions) {
    ANG_SHADER_ADD(source, opacity_series);
    if (ang_plan_uses(decisions, ANG_PART_EXPONENTIAL))
        ANG_SHADER_ADD(source, opacity_any);
    else
        ANG_SHADER_ADD(source, opacity_thin);
    if (!table->classification.prefix) {
        ANG_SHADER_ADD(source, classify_midpoint);
        return;
    }
    ANG_SHADER_ADD(source, classify_prefix);
    if (table->prefix.plateaus.texture)
        ANG_SHADER_ADD(source, prefix_plateaus);
    else
        ANG_SHADER_ADD(source, prefix_smooth);
}

void ang_parts_weight(ang_shader_source *source, const ang_scene *scene, const ang_volume *volume,
                      ang_field_kind kind) {
    if (!ang_scene_needs_weight(scene, volume))
        ANG_SHADER_ADD(source, weight_one);
    else if (kind == ANG_FIELD_MANUAL)
        ANG_SHADER_ADD(source, weight_manual);
    else
        ANG_SHADER_ADD(source, weight_hardware);
}

static void add_march_dvr(ang_shader_source *source, bool count_shown) {
    if (count_shown)
        ANG_SHADER_ADD(source, count_shown);
    else
        ANG_SHADER_ADD(source, count_all);
    ANG_SHADER_ADD(source, march_dvr);
}

void ang_parts_march(ang_shader_source *source, const ang_scene *scene, const ang_volume *volume, ang_field_kind kind,
                     const ang_table_texture *table, const ang_plan_decisions *decisions, bool seeks,
                     bool count_shown) {
    ANG_SHADER_ADD(source, march);
    if (kind == ANG_FIELD_GRADIENTS)
        ANG_SHADER_ADD(source, march_single);
    else
        ANG_SHADER_ADD(source, march_pairs);
    switch (scene->mode) {
    case ANG_MODE_DVR:
        ang_parts_medium(source, table, decisions);
        if (ang_scene_needs_phong(scene) && seeks && !ang_plan_uses(decisions, ANG_PART_SKIPPING))
            ANG_SHADER_ADD(source, march_dvr_seek);
        else
            add_march_dvr(source, count_shown);
        break;
    case ANG_MODE_MIP:
        ANG_SHADER_ADD(source, extreme_mip);
        ANG_SHADER_ADD(source, march_extreme);
        break;
    case ANG_MODE_MINIP:
        ANG_SHADER_ADD(source, extreme_minip);
        ANG_SHADER_ADD(source, march_extreme);
        break;
    case ANG_MODE_MEAN:
        ang_parts_weight(source, scene, volume, kind);
        ANG_SHADER_ADD(source, march_mean);
        break;
    case ANG_MODE_ISO:
        ANG_SHADER_ADD(source, march_iso);
        break;
    }
}

void ang_parts_half_space(ang_shader_source *source, bool cuts) {
    if (cuts)
        ANG_SHADER_ADD(source, half_space);
    else
        ANG_SHADER_ADD(source, half_space_none);
}

void ang_uniforms_clip_space(unsigned program, const ang_clip_space *space) {
    ang_uniform_vec4(program, "clip_x", space->x.gradient, space->x.constant);
    ang_uniform_vec4(program, "clip_y", space->y.gradient, space->y.constant);
    ang_uniform_vec4(program, "clip_w", space->w.gradient, space->w.constant);
}

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
    ang_uniform_vec4(program, "half_space_beyond", frame->beyond.gradient, frame->beyond.constant);
}

void ang_uniforms_field(unsigned program, const ang_volume_texture *texture, const ang_volume *volume,
                        const ang_ray_frame *frame) {
    const int *dims = texture->dims, *first = texture->first;
    ang_vec3 scale = {1.0 / dims[0], 1.0 / dims[1], 1.0 / dims[2]}, centre = frame->centre;
    glActiveTexture(GL_TEXTURE0 + ANG_UNIT_FIELD);
    glBindTexture(GL_TEXTURE_3D, texture->values);
    ang_uniform_int(program, "field_values", ANG_UNIT_FIELD);
    ang_uniform_vec3(program, "field_scale", scale);
    ang_uniform_vec3(program, "field_offset",
                     (ang_vec3){(centre.x - first[0] + 0.5) * scale.x, (centre.y - first[1] + 0.5) * scale.y,
                                (centre.z - first[2] + 0.5) * scale.z});
    ang_uniform_vec3(program, "trilinear_centre", centre);
    ang_uniform_vec3(program, "trilinear_last",
                     (ang_vec3){volume->dims[0] - 1.0, volume->dims[1] - 1.0, volume->dims[2] - 1.0});
    ang_uniform_vec3(program, "trilinear_first", (ang_vec3){first[0], first[1], first[2]});
    if (!texture->weight) return;
    glActiveTexture(GL_TEXTURE0 + ANG_UNIT_WEIGHT);
    glBindTexture(GL_TEXTURE_3D, texture->weight);
    ang_uniform_int(program, "weight_values", ANG_UNIT_WEIGHT);
}

/* Where shading is forced into a scene without any it leaves colours as they are. */
static void set_phong(unsigned program, const ang_volume *volume, const ang_scene *scene, const ang_ray_frame *frame) {
    static const ang_phong unchanged = {.ambient = 1, .power = 1, .g0 = 1};
    const ang_phong *phong = ang_scene_needs_phong(scene) ? &scene->phong : &unchanged;
    ang_uniform_transposed(program, "gradient_to_mm", &frame->to_index, 0.5 * volume->slope);
    ang_uniform_float(program, "phong_ambient", phong->ambient);
    ang_uniform_float(program, "phong_diffuse", phong->diffuse);
    ang_uniform_float(program, "phong_specular", phong->specular);
    ang_uniform_float(program, "phong_power", phong->power);
    ang_uniform_float(program, "phong_g0", phong->g0);
}

static void set_window(unsigned program, const ang_volume *volume, const ang_scene *scene) {
    /* A window of no width is a threshold; its scale must stay finite. */
    double width = fmax(scene->window_width, 1e-9);
    ang_uniform_float(program, "window_lower", ang_volume_stored(volume, scene->window_centre - width / 2));
    ang_uniform_float(program, "window_scale", volume->slope / width);
}

static void set_mean(unsigned program, const ang_volume *volume, const ang_scene *scene) {
    /* Without padding any base will do: one near the values keeps the sums small. */
    double base = volume->padding ? ang_volume_padding_value(volume) : 0.5 * (volume->minimum + volume->maximum);
    double typical = ang_volume_stored(volume, scene->window_centre);
    ang_uniform_float(program, "mean_base", base);
    ang_uniform_float(program, "mean_typical", fmin(fmax(typical, volume->minimum), volume->maximum));
    ang_uniform_float(program, "mean_empty", ang_volume_stored(volume, -1000));
}

static void set_iso(unsigned program, const ang_volume *volume, const ang_scene *scene) {
    double colour[3];
    ang_transfer_colour(scene->transfer, scene->iso_hu, colour);
    ang_uniform_float(program, "iso_stored", ang_volume_stored(volume, scene->iso_hu));
    ang_uniform_vec3(program, "iso_colour", (ang_vec3){colour[0], colour[1], colour[2]});
}

void ang_uniforms_scene(unsigned program, const ang_scene *scene, const ang_volume *volume, const ang_ray_frame *frame,
                        const ang_table_texture *table) {
    if (ang_scene_needs_table(scene))
        ang_table_texture_bind(table, program, ANG_UNIT_TABLE, ANG_UNIT_EXTINCTION);
    else
        set_window(program, volume, scene);
    if (scene->mode == ANG_MODE_DVR && table->classification.prefix)
        ang_prefix_texture_bind(&table->prefix, program, ANG_UNIT_PREFIX);
    if (ang_scene_needs_table(scene)) set_phong(program, volume, scene, frame);
    if (scene->mode == ANG_MODE_MEAN) set_mean(program, volume, scene);
    if (scene->mode == ANG_MODE_ISO) set_iso(program, volume, scene);
}
