/* The programs of raycast, put together from parts for each scene. */
#include "core/render/raycast_private.h"

#include "core/render/scene_parts.h"

#include <glad/gl.h>
#include <shaders.h>

enum { UNIT_ENTRY = ANG_UNIT_FREE, UNIT_DIRECTION, UNIT_WAKE, UNIT_FOUND, UNIT_BLOCKS };

typedef struct sources {
    ang_shader_source vertex, fragment;
} sources;

static ang_field_kind field_kind(const ang_raycast *r) {
    return r->options->manual_filter ? ANG_FIELD_MANUAL : ANG_FIELD_HARDWARE;
}

static void add_lookups(ang_shader_source *source, const ang_raycast *r) {
    if (r->scene->mode == ANG_MODE_ISO)
        ANG_SHADER_ADD(source, raycast_lookups_iso);
    else
        ANG_SHADER_ADD(source, raycast_lookups);
}

/* What a pass needs that goes along rays. */
static void add_path(ang_shader_source *source, const ang_raycast *r, bool fetches) {
    ang_shader_add(source, "pass_constants", r->constants);
    ANG_SHADER_ADD(source, lattice);
    ANG_SHADER_ADD(source, raycast_path);
    if (fetches && ang_plan_uses(&r->plan, ANG_PART_DIRECTIONS))
        ANG_SHADER_ADD(source, raycast_fetch);
    else if (fetches)
        ANG_SHADER_ADD(source, raycast_fetch_parallel);
    add_lookups(source, r);
}

static void add_blocks(ang_shader_source *source, const ang_renderer *renderer, const ang_raycast *r) {
    ANG_SHADER_ADD(source, raycast_blocks);
    if (ang_scene_whole_steps(r->scene, &renderer->pass.table))
        ANG_SHADER_ADD(source, raycast_next_step);
    else
        ANG_SHADER_ADD(source, raycast_next_lookup);
}

static void add_wake(ang_shader_source *source, const ang_renderer *renderer, const ang_raycast *r) {
    if (r->joined) {
        add_blocks(source, renderer, r);
        ANG_SHADER_ADD(source, raycast_wake);
    } else {
        ANG_SHADER_ADD(source, raycast_wake_none);
    }
}

static void add_counting(ang_shader_source *source, bool counting) {
    if (counting)
        ANG_SHADER_ADD(source, raycast_count);
    else
        ANG_SHADER_ADD(source, raycast_count_none);
}

static void add_value(ang_shader_source *source, const ang_renderer *renderer, const ang_raycast *r) {
    const ang_scene *scene = r->scene;
    const ang_volume *volume = renderer->pass.volume;
    ang_field_kind kind = field_kind(r);
    ang_parts_field(source, kind);
    switch (scene->mode) {
    case ANG_MODE_DVR:
        ang_parts_classification(source, scene, kind, &r->plan);
        ang_parts_medium(source, &renderer->pass.table, &r->plan);
        if (ang_plan_uses(&r->plan, ANG_PART_GRADIENTS)) {
            ANG_SHADER_ADD(source, raycast_along);
            ANG_SHADER_ADD(source, raycast_dvr_seek);
        } else {
            ANG_SHADER_ADD(source, raycast_dvr);
        }
        break;
    case ANG_MODE_MIP:
        ANG_SHADER_ADD(source, raycast_mip);
        break;
    case ANG_MODE_MINIP:
        ANG_SHADER_ADD(source, raycast_minip);
        break;
    case ANG_MODE_MEAN:
        ang_parts_weight(source, scene, volume, kind);
        ANG_SHADER_ADD(source, raycast_mean);
        break;
    case ANG_MODE_ISO:
        ANG_SHADER_ADD(source, stored_exact);
        ANG_SHADER_ADD(source, raycast_iso);
        break;
    }
}

static void compose_rays(ang_shader_source *source, const ang_renderer *renderer, const ang_raycast *r) {
    ang_parts_ray(source, r->scene, &r->plan, true);
    add_path(source, r, false);
    if (ang_plan_uses(&r->plan, ANG_PART_DIRECTIONS))
        ANG_SHADER_ADD(source, raycast_keep);
    else
        ANG_SHADER_ADD(source, raycast_keep_parallel);
    add_wake(source, renderer, r);
    ANG_SHADER_ADD(source, raycast_rays);
}

static void compose_main(ang_shader_source *source, const ang_renderer *renderer, const ang_raycast *r, bool counting) {
    if (ang_raycast_tests(r)) ANG_SHADER_ADD(source, early);
    if (ang_plan_uses(&r->plan, ANG_PART_GRADIENTS) && r->scene->mode == ANG_MODE_DVR)
        ang_parts_ray(source, r->scene, &r->plan, false);
    add_path(source, r, true);
    add_wake(source, renderer, r);
    add_value(source, renderer, r);
    add_counting(source, counting);
    ANG_SHADER_ADD(source, raycast_main);
}

/* The opacity is in a texture that main passes blend into and cannot read: it is looked at here, joined or not. */
static void compose_finish(ang_shader_source *source, const ang_raycast *r) {
    if (r->terminates)
        ANG_SHADER_ADD(source, raycast_opaque);
    else
        ANG_SHADER_ADD(source, raycast_opaque_none);
    if (r->joined) {
        ANG_SHADER_ADD(source, raycast_left_joined);
    } else {
        add_path(source, r, true);
        ANG_SHADER_ADD(source, raycast_left);
    }
    ANG_SHADER_ADD(source, raycast_finish);
}

static void compose_empty(ang_shader_source *source, const ang_renderer *renderer, const ang_raycast *r) {
    if (r->joined) {
        ANG_SHADER_ADD(source, raycast_empty_joined);
        return;
    }
    add_path(source, r, true);
    add_blocks(source, renderer, r);
    ANG_SHADER_ADD(source, raycast_empty);
}

static void compose_resolve(ang_shader_source *source, const ang_raycast *r, bool counting) {
    const ang_scene *scene = r->scene;
    ang_parts_ray(source, scene, &r->plan, scene->mode != ANG_MODE_ISO);
    if (scene->mode == ANG_MODE_ISO) {
        add_path(source, r, true);
        ang_parts_field(source, field_kind(r));
        ang_parts_classification(source, scene, field_kind(r), &r->plan);
        ANG_SHADER_ADD(source, raycast_along);
        add_counting(source, counting);
        ANG_SHADER_ADD(source, raycast_shade);
        return;
    }
    ANG_SHADER_ADD(source, window);
    if (scene->mode == ANG_MODE_MEAN)
        ANG_SHADER_ADD(source, resolve_mean_parts);
    else
        ANG_SHADER_ADD(source, resolve_extreme);
    ANG_SHADER_ADD(source, resolve);
}

static sources compose(const ang_renderer *renderer, const ang_raycast *r, ang_raycast_pass pass, bool counting) {
    sources to = {.vertex = {.count = 0}};
    ANG_SHADER_ADD(&to.vertex, version);
    ANG_SHADER_ADD(&to.fragment, version);
    if (pass != ANG_RAYCAST_RESOLVE && r->covers)
        ANG_SHADER_ADD(&to.vertex, raycast_cover);
    else
        ANG_SHADER_ADD(&to.vertex, triangle);
    switch (pass) {
    case ANG_RAYCAST_RAYS:
        compose_rays(&to.fragment, renderer, r);
        break;
    case ANG_RAYCAST_MAIN:
        compose_main(&to.fragment, renderer, r, counting);
        break;
    case ANG_RAYCAST_FINISH:
        compose_finish(&to.fragment, r);
        break;
    case ANG_RAYCAST_EMPTY:
        compose_empty(&to.fragment, renderer, r);
        break;
    case ANG_RAYCAST_RESOLVE:
    case ANG_RAYCAST_PASSES:
        compose_resolve(&to.fragment, r, counting);
        break;
    }
    return to;
}

/* The sums of a ray are at most 2^23 of these units, which a float counts exactly. */
static void set_mean_unit(unsigned program, const ang_volume *volume) {
    double length = exp2(ceil(log2(2.01 * ang_volume_half_diagonal(volume))));
    glProgramUniform2f(program, glGetUniformLocation(program, "mean_unit"), (float)(length * exp2(16 - 22)),
                       (float)(length * exp2(-22)));
}

unsigned ang_raycast_program(ang_renderer *renderer, const ang_raycast *r, ang_raycast_pass pass, bool counting,
                             ang_error *err) {
    ang_ray_pass *on = &renderer->pass;
    sources made = compose(renderer, r, pass, counting);
    unsigned program = ang_programs_get(&on->programs, on->method, &made.vertex, &made.fragment, err);
    if (!program) return 0;
    ang_uniforms_ray(program, &r->frame);
    ang_uniforms_field(program, &on->field, on->volume, &r->frame);
    ang_uniforms_scene(program, r->scene, on->volume, &r->frame, &on->table);
    ang_limit_texture_bind(&on->limits, r->scene, program, ANG_UNIT_LIMIT);
    ang_uniforms_clip_space(program, &r->space);
    ang_uniform_vec3(program, "cover_lower", r->cover_lower);
    ang_uniform_vec3(program, "cover_upper", r->cover_upper);
    ang_uniform_float(program, "lattice_step", ang_ray_step(on->volume, r->options));
    ang_uniform_float(program, "termination", r->scene->mode == ANG_MODE_ISO ? 0.5 : r->options->termination);
    ang_uniform_int(program, "path_entry", UNIT_ENTRY);
    ang_uniform_int(program, "path_direction", UNIT_DIRECTION);
    ang_uniform_vec3(program, "path_along", r->frame.axis);
    ang_uniform_int(program, "path_wake", UNIT_WAKE);
    ang_uniform_int(program, "pass_found", UNIT_FOUND);
    ang_uniform_int(program, "slice_accumulated", UNIT_FOUND); /* resolve.glsl */
    if (r->scene->mode == ANG_MODE_MEAN) set_mean_unit(program, on->volume);
    if (r->skips) ang_block_ranges_bind(&renderer->blocks, program, UNIT_BLOCKS, r->frame.centre);
    return program;
}

void ang_raycast_bind(const ang_renderer *renderer, const ang_raycast *r) {
    const unsigned textures[] = {renderer->paths.entry, renderer->paths.direction, r->joined ? renderer->paths.wake : 0,
                                 renderer->pass.target.colour};
    for (int i = 0; i < 4; i++) {
        glActiveTexture(GL_TEXTURE0 + UNIT_ENTRY + (GLenum)i);
        glBindTexture(GL_TEXTURE_2D, textures[i]);
    }
}

void ang_raycast_explain_pass(const ang_renderer *renderer, const ang_raycast *r, ang_raycast_pass pass,
                              ang_plan *plan) {
    static const char *const names[ANG_RAYCAST_PASSES + 1] = {
        "entry and direction of rays",        "a stretch of every ray", "finished pixels",
        "pixels whose next stretch is empty", "values to grey",         ""};
    bool surface = r->scene->mode == ANG_MODE_ISO;
    sources made = compose(renderer, r, pass, false);
    int lookups = 0;
    if (pass == ANG_RAYCAST_MAIN)
        lookups = ang_scene_lookups(r->scene, renderer->pass.volume) +
                  ang_scene_step_lookups(r->scene, &renderer->pass.table, false);
    if (pass == ANG_RAYCAST_FINISH) lookups = r->joined || !r->terminates ? 1 : 2;
    if (pass == ANG_RAYCAST_EMPTY) lookups = r->joined ? 1 : 2;
    if (pass == ANG_RAYCAST_RESOLVE) lookups = surface ? 7 : 1;
    ang_shader_explain(plan, surface && pass == ANG_RAYCAST_RESOLVE ? "shading of the surface" : names[pass],
                       &made.vertex, &made.fragment, lookups);
}
