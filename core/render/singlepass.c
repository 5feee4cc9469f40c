#include "core/render/method.h"

#include "core/base/memory.h"
#include "core/render/scene_parts.h"
#include "core/render/target.h"

#include <glad/gl.h>
#include <shaders.h>
#include <stdlib.h>

enum {
    BAND_ROWS = 64, /* rows drawn at once: drivers stop draws that take seconds, and users want to */
};

/* llvmpipe leaves loops, without a word, after 65535 rounds of all loops of a shader together, and march_dvr takes up
 * to two rounds a sample (its loops are nested); so a ray takes at most this many samples. */
static const double most_samples = 32000;

struct ang_renderer {
    ang_gl *gl;
    const ang_volume *volume;
    ang_volume_texture field;
    ang_table_texture table;
    ang_programs programs;
    ang_target target;
    GLuint vertices; /* no attributes, but a draw needs one bound */
};

static void destroy(ang_renderer *renderer) {
    if (!renderer) return;
    if (renderer->vertices) glDeleteVertexArrays(1, &renderer->vertices);
    ang_target_destroy(&renderer->target);
    ang_programs_clear(&renderer->programs);
    ang_table_texture_destroy(&renderer->table);
    ang_volume_texture_destroy(&renderer->field);
    free(renderer);
}

static ang_renderer *create(ang_gl *gl, const ang_volume *volume, const ang_render_options *options, ang_error *err) {
    if (options->gpu_memory && ang_volume_count(volume) * sizeof *volume->data > options->gpu_memory) {
        ang_fail(err, ANG_LIMIT,
                 "--gpu-memory: the volume is larger, and --method singlepass cannot draw it in bricks; "
                 "choose --method slicing");
        return NULL;
    }
    if (!gl) {
        ang_fail(err, ANG_GL, "--method singlepass needs OpenGL: choose another --backend, or --method reference");
        return NULL;
    }
    ang_renderer *renderer = ang_alloc(1, sizeof *renderer, "the single-pass renderer", err);
    if (!renderer) return NULL;
    renderer->gl = gl;
    renderer->volume = volume;
    if (!ang_volume_texture_create(&renderer->field, gl, volume, err)) {
        destroy(renderer);
        return NULL;
    }
    glGenVertexArrays(1, &renderer->vertices);
    /* Until the volume has arrived, so that callers can time it. */
    glFinish();
    return renderer;
}

/* Millimetres between samples. */
static double step_used(const ang_volume *volume, const ang_render_options *options) {
    double wanted = options->step_voxels * ang_volume_smallest_spacing(volume);
    return fmax(wanted, 2 * ang_volume_half_diagonal(volume) / most_samples);
}

/* Only what the scene needs is in the program. */
static ang_shader_source compose(const ang_renderer *renderer, const ang_scene *scene,
                                 const ang_render_options *options, bool counting) {
    const ang_volume *volume = renderer->volume;
    bool manual = options->manual_filter;
    ang_shader_source source = {.count = 0};
    ANG_SHADER_ADD(&source, version);
    ANG_SHADER_ADD(&source, ray);
    ANG_SHADER_ADD(&source, lattice);
    ang_parts_field(&source, manual);
    ang_parts_classification(&source, scene);
    ANG_SHADER_ADD(&source, bounds_box);
    ANG_SHADER_ADD(&source, skip_none);
    ang_parts_march(&source, scene, volume, manual, &renderer->table, 1.01 * step_used(volume, options));
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

/* Textures and target for this scene; 0 with an error, or the program. */
static GLuint prepare(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, bool counting,
                      ang_error *err) {
    const ang_volume *volume = renderer->volume;
    if (ang_scene_needs_table(scene) &&
        !ang_table_texture_update(&renderer->table, renderer->gl, scene->transfer, volume, err))
        return 0;
    if (ang_scene_needs_weight(scene, volume) &&
        !ang_volume_texture_add_weight(&renderer->field, renderer->gl, volume, err))
        return 0;
    if (!ang_target_resize(&renderer->target, renderer->gl, scene->width, scene->height,
                           counting ? ANG_TARGET_COUNTS : 0, err))
        return 0;
    ang_shader_source vertex = compose_vertex();
    ang_shader_source fragment = compose(renderer, scene, options, counting);
    return ang_programs_get(&renderer->programs, "singlepass", &vertex, &fragment, err);
}

static void set_uniforms(const ang_renderer *renderer, GLuint program, const ang_scene *scene,
                         const ang_render_options *options, const ang_ray_frame *frame) {
    const ang_volume *volume = renderer->volume;
    ang_uniforms_ray(program, frame);
    ang_uniforms_field(program, &renderer->field, volume, frame);
    ang_uniforms_scene(program, scene, volume, frame, &renderer->table);
    ang_uniform_float(program, "lattice_step", step_used(volume, options));
    if (scene->mode == ANG_MODE_DVR) ang_uniform_float(program, "termination", options->termination);
}

/* Draws and reads the picture band by band. */
static bool draw_bands(ang_renderer *renderer, ang_image *image, ang_frame_stats *stats, const ang_progress *progress,
                       ang_error *err) {
    const ang_target *target = &renderer->target;
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
        if (stats) ang_target_read_counts(target, first, rows, counts, &stats->samples, &stats->fragments);
        going = ang_progress_update(progress, "rendering", (double)(first + rows) / target->height);
    }
    free(counts);
    return going || ang_fail(err, ANG_INTERRUPTED, "interrupted while rendering");
}

static bool render(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_image *image,
                   ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    if (!(options->step_voxels > 0))
        return ang_fail(err, ANG_USAGE, "--step %g: give a positive multiple of the smallest spacing",
                        options->step_voxels);
    ang_ray_frame frame;
    if (!ang_scene_check(scene, err) || !ang_ray_frame_make(renderer->volume, scene, &frame, err)) return false;
    GLuint program = prepare(renderer, scene, options, stats != NULL, err);
    if (!program) return false;
    if (stats)
        *stats = (ang_frame_stats){
            .step_mm = step_used(renderer->volume, options), .bricks_drawn = 1, .bricks_total = 1, .passes = 1};

    glBindFramebuffer(GL_FRAMEBUFFER, renderer->target.framebuffer);
    glViewport(0, 0, renderer->target.width, renderer->target.height);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_SCISSOR_TEST);
    glBindVertexArray(renderer->vertices);
    glUseProgram(program);
    set_uniforms(renderer, program, scene, options, &frame);
    bool ok = draw_bands(renderer, image, stats, progress, err);
    glUseProgram(0);
    glBindVertexArray(0);
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return ok && ang_gl_check(renderer->gl, err);
}

static bool explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_plan *plan,
                    ang_error *err) {
    const ang_volume *volume = renderer->volume;
    if (!ang_scene_check(scene, err)) return false;
    if (ang_scene_needs_table(scene) &&
        !ang_table_texture_update(&renderer->table, renderer->gl, scene->transfer, volume, err))
        return false;
    ang_plan_use(plan, "one 3D texture of 16 bits for the whole volume");
    ang_scene_explain(plan, scene, volume);
    ang_plan_leave_out(plan, "skipping of invisible blocks", "this method is the baseline and skips nothing");
    if (scene->mode == ANG_MODE_DVR && !(options->termination < 1))
        ang_plan_leave_out(plan, "early termination", "--no-termination");
    ang_shader_source vertex = compose_vertex();
    ang_shader_source fragment = compose(renderer, scene, options, false);
    ang_shader_explain(plan, "rays", &vertex, &fragment, ang_scene_lookups(scene, volume));
    return true;
}

const ang_method ang_method_singlepass = {
    .name = "singlepass",
    .title = "one fragment-shader loop over the box, no skipping: the baseline that others are compared with",
    .source = "DESIGN.md, Rendering methods; numerics.md",
    .needs_gl = true,
    .takes = ANG_TAKES_TERMINATION | ANG_TAKES_MANUAL_FILTER,
    .create = create,
    .render = render,
    .explain = explain,
    .destroy = destroy,
};
