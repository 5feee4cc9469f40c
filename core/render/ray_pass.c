#include "core/render/ray_pass.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/render/facts.h"
#include "core/render/scene_parts.h"

#include <glad/gl.h>
#include <shaders.h>
#include <stdlib.h>

enum {
    BAND_ROWS = 64, /* rows drawn at once: drivers stop draws that take seconds, and users want to */
};

/* llvmpipe leaves loops, without a word, after 65535 rounds of all loops of a shader together; so a ray takes at most
 * this many samples. In march_dvr_seek the pixels of a vector, up to 16, wait for each other in the inner loop, each
 * round of which counts: there it is at most that many. */
static const double most_samples = 32000, most_samples_seek = 3500;

void ang_ray_pass_destroy(ang_ray_pass *pass) {
    if (pass->vertices) glDeleteVertexArrays(1, &pass->vertices);
    ang_target_destroy(&pass->target);
    ang_programs_clear(&pass->programs);
    ang_limit_texture_destroy(&pass->limits);
    ang_table_texture_destroy(&pass->table);
    ang_volume_texture_destroy(&pass->field);
    *pass = (ang_ray_pass){0};
}

bool ang_ray_pass_make(ang_ray_pass *pass, const char *method, ang_gl *gl, const ang_volume *volume,
                       const ang_render_options *options, ang_error *err) {
    *pass = (ang_ray_pass){.method = method, .gl = gl, .volume = volume};
    if (options->gpu_memory && ang_volume_count(volume) * sizeof *volume->data > options->gpu_memory)
        return ang_fail(err, ANG_LIMIT,
                        "--gpu-memory: the volume is larger, and --method %s cannot draw it in bricks; choose --method "
                        "slicing",
                        method);
    if (!gl)
        return ang_fail(err, ANG_GL, "--method %s needs OpenGL: choose another --backend, or --method reference",
                        method);
    if (!ang_volume_texture_reserve(&pass->field, gl, volume, err)) return false;
    glGenVertexArrays(1, &pass->vertices);
    return true;
}

bool ang_ray_pass_hold(ang_ray_pass *pass, const int *first, const int *end, double *took, ang_error *err) {
    static const int origin[3] = {0, 0, 0};
    double start = ang_now_ms();
    bool ok = ang_volume_texture_hold(&pass->field, pass->gl, pass->volume, first ? first : origin,
                                      first ? end : pass->volume->dims, err);
    *took += ang_now_ms() - start;
    return ok;
}

/* Millimetres between samples. */
double ang_ray_step(const ang_volume *volume, const ang_render_options *options) {
    double wanted = options->step_voxels * ang_volume_smallest_spacing(volume);
    return fmax(wanted, 2 * ang_volume_half_diagonal(volume) / most_samples);
}

static bool may_seek(const ang_volume *volume, const ang_render_options *options) {
    return 2 * ang_volume_half_diagonal(volume) / ang_ray_step(volume, options) < most_samples_seek;
}

/* Only what the scene needs is in the program. */
static ang_shader_source compose(const ang_ray_pass *pass, const ang_scene *scene, const ang_render_options *options,
                                 const ang_ray_limits *limits, bool counting) {
    const ang_volume *volume = pass->volume;
    ang_field_kind kind = limits->gradients        ? ANG_FIELD_GRADIENTS
                          : options->manual_filter ? ANG_FIELD_MANUAL
                                                   : ANG_FIELD_HARDWARE;
    ang_shader_source source = {.count = 0};
    ANG_SHADER_ADD(&source, version);
    ang_parts_ray(&source, scene, limits->decisions, true);
    ANG_SHADER_ADD(&source, lattice);
    ang_parts_field(&source, kind);
    ang_parts_classification(&source, scene, kind, limits->decisions);
    ang_parts_steps(&source, scene, &pass->table);
    limits->parts(limits->context, &source);
    ang_parts_march(&source, scene, volume, kind, &pass->table, limits->decisions, may_seek(volume, options),
                    options->count_shown);
    if (counting)
        ANG_SHADER_ADD(&source, picture_counted);
    else
        ANG_SHADER_ADD(&source, picture);
    return source;
}

static ang_shader_source compose_vertex(void) {
    ang_shader_source vertex = {.count = 0};
    ANG_SHADER_ADD(&vertex, version);
    ANG_SHADER_ADD(&vertex, triangle);
    return vertex;
}

bool ang_ray_pass_prepare(ang_ray_pass *pass, const ang_scene *scene, const ang_render_options *options,
                          ang_ray_frame *frame, ang_error *err) {
    if (!(options->step_voxels > 0))
        return ang_fail(err, ANG_USAGE, "--step %g: give a positive multiple of the smallest spacing",
                        options->step_voxels);
    if (!ang_scene_check(scene, err) || !ang_ray_frame_make(pass->volume, scene, frame, err)) return false;
    if (ang_scene_needs_table(scene) &&
        !ang_table_texture_update(&pass->table, pass->gl, scene->transfer, pass->volume, err))
        return false;
    if (scene->mode == ANG_MODE_DVR &&
        !ang_table_texture_classify(&pass->table, pass->gl, scene->transfer, pass->volume, options->classification,
                                    ang_ray_step(pass->volume, options), err))
        return false;
    if (!ang_limit_texture_update(&pass->limits, pass->gl, pass->volume, scene, frame, options->threads, err))
        return false;
    if (ang_scene_needs_weight(scene, pass->volume) && options->gpu_memory &&
        2 * ang_volume_count(pass->volume) * sizeof *pass->volume->data > options->gpu_memory)
        return ang_fail(
            err, ANG_LIMIT,
            "--gpu-memory: values and padding are larger, and --method %s cannot draw them in bricks; choose "
            "--method slicing",
            pass->method);
    return !ang_scene_needs_weight(scene, pass->volume) ||
           ang_volume_texture_add_weight(&pass->field, pass->gl, pass->volume, err);
}

ang_plan_facts ang_ray_pass_facts(const ang_ray_pass *pass, ang_drawing drawing, const ang_scene *scene,
                                  const ang_render_options *options, const ang_ray_frame *frame) {
    ang_plan_facts facts = ang_facts_make(drawing, pass->gl, pass->volume, scene, options, frame, &pass->table.cache,
                                          1.01 * ang_ray_step(pass->volume, options));
    ang_table_texture_facts(&pass->table, scene, &facts);
    return facts;
}

/* Draws and reads the picture band by band. */
static bool draw_bands(const ang_ray_pass *pass, ang_image *image, ang_frame_stats *stats, const ang_progress *progress,
                       ang_error *err) {
    const ang_target *target = &pass->target;
    float *counts = NULL;
    if (stats) {
        counts = ang_alloc((size_t)target->width * BAND_ROWS, sizeof *counts, "a band of counts", err);
        if (!counts) return false;
    }
    bool going = true;
    for (int first = 0; first < target->height && going; first += BAND_ROWS) {
        int rows = target->height - first < BAND_ROWS ? target->height - first : BAND_ROWS;
        glScissor(0, first, target->width, rows);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        ang_target_read(target, first, rows, image);
        float *into = stats && stats->counts ? stats->counts + (size_t)first * (size_t)target->width : counts;
        if (stats) ang_target_read_counts(target, first, rows, into, &stats->samples, &stats->fragments);
        going = ang_progress_update(progress, "rendering", (double)(first + rows) / target->height);
    }
    free(counts);
    return going || ang_fail(err, ANG_INTERRUPTED, "interrupted while rendering");
}

static void set_uniforms(const ang_ray_pass *pass, GLuint program, const ang_scene *scene,
                         const ang_render_options *options, const ang_ray_frame *frame, const ang_ray_limits *limits) {
    ang_uniforms_ray(program, frame);
    ang_uniforms_field(program, &pass->field, pass->volume, frame);
    ang_uniforms_scene(program, scene, pass->volume, frame, &pass->table);
    ang_limit_texture_bind(&pass->limits, scene, program, ANG_UNIT_LIMIT);
    ang_uniform_float(program, "lattice_step", ang_ray_step(pass->volume, options));
    if (scene->mode == ANG_MODE_DVR) ang_uniform_float(program, "termination", options->termination);
    limits->uniforms(limits->context, program, frame);
}

bool ang_ray_pass_draw(ang_ray_pass *pass, const ang_scene *scene, const ang_render_options *options,
                       const ang_ray_frame *frame, const ang_ray_limits *limits, ang_image *image,
                       ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    ang_shader_source vertex = compose_vertex();
    ang_shader_source fragment = compose(pass, scene, options, limits, stats != NULL);
    GLuint program = ang_programs_get(&pass->programs, pass->method, &vertex, &fragment, err);
    if (!program ||
        !ang_target_resize(&pass->target, pass->gl, scene->width, scene->height, stats ? ANG_TARGET_COUNTS : 0, err))
        return false;
    if (stats) stats->step_mm = ang_ray_step(pass->volume, options);
    const char *note = ang_ray_pass_note(pass, scene);
    if (stats && note) stats->note = note;
    if (stats) stats->classification = ang_scene_classification(scene, &pass->table);
    glBindFramebuffer(GL_FRAMEBUFFER, pass->target.framebuffer);
    glViewport(0, 0, pass->target.width, pass->target.height);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_SCISSOR_TEST);
    glBindVertexArray(pass->vertices);
    glUseProgram(program);
    set_uniforms(pass, program, scene, options, frame, limits);
    bool ok = draw_bands(pass, image, stats, progress, err);
    if (ok) ang_limit_texture_join(&pass->limits, scene, image);
    glUseProgram(0);
    glBindVertexArray(0);
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return ok && ang_gl_check(pass->gl, err);
}

const char *ang_ray_pass_note(const ang_ray_pass *pass, const ang_scene *scene) {
    return scene->mode == ANG_MODE_DVR && pass->table.classification.may_miss ? pass->table.classification.warning
                                                                              : NULL;
}

void ang_ray_pass_explain(const ang_ray_pass *pass, const ang_scene *scene, const ang_render_options *options,
                          const ang_ray_limits *limits, ang_plan *plan) {
    ang_plan_use(plan, "one 3D texture of 16 bits for the whole volume");
    ang_scene_explain(plan, scene, pass->volume, limits->decisions);
    ang_scene_explain_steps(plan, scene, &pass->table);
    ang_shader_source vertex = compose_vertex();
    ang_shader_source fragment = compose(pass, scene, options, limits, false);
    ang_shader_explain(plan, "rays", &vertex, &fragment,
                       (limits->gradients ? 2 : ang_scene_lookups(scene, pass->volume)) +
                           ang_scene_step_lookups(scene, &pass->table, false));
}
