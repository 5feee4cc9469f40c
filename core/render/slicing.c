/* Slicing with octree skipping: Rezk-Salama & Kolb 2005; the proxies of Benassarou et al. 2005. */
#include "core/render/slicing_private.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/render/scene_parts.h"

#include <glad/gl.h>
#include <stdio.h>
#include <stdlib.h>

enum { UNIT_ACCUMULATED = ANG_UNIT_FREE };

/* A look that finds less than this share of the picture was not worth it. */
static const double finish_share = 0.02;

static void destroy(ang_renderer *renderer) {
    if (!renderer) return;
    if (renderer->vertices) glDeleteVertexArrays(1, &renderer->vertices);
    if (renderer->query) glDeleteQueries(1, &renderer->query);
    if (renderer->invocations) glDeleteQueries(1, &renderer->invocations);
    ang_target_destroy(&renderer->accumulated);
    ang_target_destroy(&renderer->resolved);
    ang_programs_clear(&renderer->programs);
    ang_limit_texture_destroy(&renderer->limits);
    ang_table_texture_destroy(&renderer->table);
    ang_slice_geometry_destroy(&renderer->geometry);
    ang_slice_boxes_clear(&renderer->boxes);
    ang_brick_store_destroy(&renderer->store);
    ang_octree_free(renderer->octree);
    free(renderer);
}

static ang_renderer *create(ang_gl *gl, const ang_volume *volume, const ang_render_options *options, ang_error *err) {
    if (!gl) {
        ang_fail(err, ANG_GL, "--method slicing needs OpenGL: choose another --backend, or --method reference");
        return NULL;
    }
    ang_renderer *renderer = ang_alloc(1, sizeof *renderer, "the slicing renderer", err);
    if (!renderer) return NULL;
    renderer->gl = gl;
    renderer->volume = volume;
    if (!ang_brick_store_make(&renderer->store, gl, volume, options->gpu_memory, err)) {
        destroy(renderer);
        return NULL;
    }
    glGenVertexArrays(1, &renderer->vertices);
    glGenQueries(1, &renderer->query);
    glGenQueries(1, &renderer->invocations);
    /* Until the volume has arrived, so that callers can time it. */
    glFinish();
    return renderer;
}

/* Blending and depth test of the pass that accumulates. */
static void set_state(const ang_scene *scene, const ang_slicing *s, bool counting) {
    static const struct {
        GLenum equation, source, destination;
        float clear;
    } blends[] = {[ANG_MODE_DVR] = {GL_FUNC_ADD, GL_ONE_MINUS_DST_ALPHA, GL_ONE, 0},
                  [ANG_MODE_MIP] = {GL_MAX, GL_ONE, GL_ONE, 0},
                  [ANG_MODE_MINIP] = {GL_MIN, GL_ONE, GL_ONE, 65535},
                  [ANG_MODE_MEAN] = {GL_FUNC_ADD, GL_ONE, GL_ONE, 0},
                  [ANG_MODE_ISO] = {GL_FUNC_ADD, GL_ONE, GL_ZERO, 0}};
    GLenum source = blends[scene->mode].source, destination = blends[scene->mode].destination;
    if (s->order.back_to_front) {
        source = GL_ONE;
        destination = GL_ONE_MINUS_SRC_ALPHA;
    }
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    float clear = blends[scene->mode].clear;
    const float colour[4] = {clear, clear, clear, clear}, zero[4] = {0}, far = 1;
    glClearBufferfv(GL_COLOR, 0, colour);
    if (counting) glClearBufferfv(GL_COLOR, 1, zero);
    glDepthMask(GL_TRUE);
    glClearBufferfv(GL_DEPTH, 0, &far);
    glEnable(GL_BLEND);
    if (scene->mode == ANG_MODE_ISO) glDisablei(GL_BLEND, 0);
    glBlendEquationi(0, blends[scene->mode].equation);
    glBlendFunci(0, source, destination);
    glBlendEquationi(1, GL_FUNC_ADD);
    glBlendFunci(1, GL_ONE, GL_ONE);
    bool depth = s->finishes || scene->mode == ANG_MODE_ISO;
    if (depth)
        glEnable(GL_DEPTH_TEST);
    else
        glDisable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(scene->mode == ANG_MODE_ISO);
    glDisable(GL_CULL_FACE);
}

/* Depth 0 wherever the opacity has reached the threshold: nothing passes there any more. Returns how many pixels are
 * new among them. */
static unsigned finish_pixels(const ang_renderer *renderer, GLuint program) {
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->accumulated.depth_only);
    glUseProgram(program);
    glActiveTexture(GL_TEXTURE0 + UNIT_ACCUMULATED);
    glBindTexture(GL_TEXTURE_2D, renderer->accumulated.colour);
    glBindVertexArray(renderer->vertices);
    glDepthMask(GL_TRUE);
    glDepthRange(0, 0);
    glBeginQuery(GL_SAMPLES_PASSED, renderer->query);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEndQuery(GL_SAMPLES_PASSED);
    glDepthRange(0, 1);
    glDepthMask(GL_FALSE);
    glBindTexture(GL_TEXTURE_2D, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->accumulated.framebuffer);
    GLuint found = 0;
    glGetQueryObjectuiv(renderer->query, GL_QUERY_RESULT, &found);
    return found;
}

/* slice_planes.glsl and slice_sample.glsl */
static void set_planes(GLuint program, const ang_slicing *s) {
    const ang_ray_frame *frame = &s->frame;
    double reference = ang_vec3_dot(ang_vec3_sub(frame->origin_mm, frame->eye_mm), frame->axis_mm);
    ang_uniform_float(program, "slice_inverse_reference", frame->perspective ? 1 / reference : 1);
    ang_vec3 to_eye = ang_vec3_sub(frame->eye_mm, frame->origin_mm);
    double pixel2 = ang_vec3_dot(frame->step_x_mm, frame->step_x_mm);
    glProgramUniform2f(program, glGetUniformLocation(program, "slice_middle"),
                       (float)(ang_vec3_dot(to_eye, frame->step_x_mm) / pixel2),
                       (float)(ang_vec3_dot(to_eye, frame->step_y_mm) / pixel2));
    ang_uniform_float(program, "slice_tangent", frame->perspective ? sqrt(pixel2) / reference : 0);

    ang_uniform_float(program, "slice_first", s->planes.first);
    ang_uniform_float(program, "slice_distance", s->planes.distance);
    ang_uniform_int(program, "slice_count", s->planes.count);
}

/* The programs of one picture; 0 where it needs none. */
typedef struct programs {
    GLuint slices[2]; /* away from the faces, at the faces */
    GLuint finish, resolve, edges;
} programs;

static bool get_program(ang_renderer *renderer, bool wanted, ang_slice_pass pass, const ang_slice_recipe *recipe,
                        GLuint *program, ang_error *err) {
    *program = wanted ? ang_slice_program(&renderer->programs, pass, recipe, err) : 0;
    return !wanted || *program;
}

static bool get_programs(ang_renderer *renderer, const ang_slice_recipe *recipe, programs *out, ang_error *err) {
    bool resolves = ang_slice_needs_resolve(recipe->scene), edges = recipe->options->show_bricks;
    if (!get_program(renderer, true, ANG_SLICE_INNER, recipe, &out->slices[0], err) ||
        !get_program(renderer, true, ANG_SLICE_FACES, recipe, &out->slices[1], err) ||
        !get_program(renderer, ang_plan_uses(recipe->plan[0], ANG_PART_TERMINATION), ANG_SLICE_FINISH, recipe,
                     &out->finish, err) ||
        !get_program(renderer, resolves, ANG_SLICE_RESOLVE, recipe, &out->resolve, err) ||
        !get_program(renderer, edges, ANG_SLICE_EDGES, recipe, &out->edges, err))
        return false;
    if (!out->finish) return true;
    ang_uniform_int(out->finish, "slice_accumulated", UNIT_ACCUMULATED);
    ang_uniform_float(out->finish, "termination", recipe->options->termination);
    return true;
}

/* Draws all slices; the accumulated target is bound. */
static bool accumulate(ang_renderer *renderer, const ang_slicing *s, const programs *use, ang_frame_stats *stats,
                       const ang_progress *progress, ang_error *err) {
    ang_slice_geometry *geometry = &renderer->geometry;
    const ang_volume_texture *bound = NULL;
    double drawn = 0, since_look = 0, since_stop = 0, total = fmax(renderer->boxes.samples, 1);
    double interval = s->order.most_samples,
           worth = finish_share * renderer->accumulated.width * renderer->accumulated.height;
    int looks = 0;
    for (size_t i = 0; i < geometry->draws; i++) {
        const ang_slice_draw *draw = &geometry->draw[i];
        double start = ang_now_ms();
        uint64_t uploads = renderer->store.uploads;
        const ang_volume_texture *texture =
            ang_brick_store_get(&renderer->store, draw->block.level, draw->block.first, err);
        if (!texture) return false;
        if (texture != bound || uploads != renderer->store.uploads)
            for (int k = 0; k < 2; k++) ang_uniforms_field(use->slices[k], texture, renderer->volume, &s->frame);
        if (uploads != renderer->store.uploads) stats->upload_ms += ang_now_ms() - start;
        bound = texture;
        glUseProgram(use->slices[draw->faces]);
        if (!ang_slice_geometry_draw(geometry, renderer->gl, i, err)) return false;
        stats->polygons += draw->polygons;
        drawn += draw->samples;
        since_look += draw->samples;
        since_stop += draw->samples;
        if (since_look >= interval && use->finish && i + 1 < geometry->draws) {
            /* Where few pixels finish, looking less often is cheaper. */
            interval = finish_pixels(renderer, use->finish) < worth ? 2 * interval : s->order.most_samples;
            since_look = 0;
            looks++;
        }
        if (since_stop < s->order.most_samples) continue;
        since_stop = 0;
        if (!use->finish) glFinish();
        if (!ang_progress_update(progress, "rendering", drawn / total))
            return ang_fail(err, ANG_INTERRUPTED, "interrupted while rendering");
    }
    stats->passes = 1 + looks + (use->resolve != 0);
    return true;
}

static void resolve(ang_renderer *renderer, const ang_scene *scene, const ang_slicing *s, GLuint program) {
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->resolved.framebuffer);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glUseProgram(program);
    ang_uniforms_ray(program, &s->frame);
    ang_uniforms_scene(program, scene, renderer->volume, &s->frame, &renderer->table);
    ang_uniform_int(program, "slice_accumulated", UNIT_ACCUMULATED);
    glActiveTexture(GL_TEXTURE0 + UNIT_ACCUMULATED);
    glBindTexture(GL_TEXTURE_2D, renderer->accumulated.colour);
    glBindVertexArray(renderer->vertices);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindTexture(GL_TEXTURE_2D, 0);
}

/* The edges of the boxes over the finished picture, as in Rezk-Salama & Kolb's figure 6. */
static bool draw_edges(ang_renderer *renderer, const ang_scene *scene, const ang_slicing *s, GLuint program,
                       ang_error *err) {
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDrawBuffer(GL_COLOR_ATTACHMENT0); /* edges are no samples */
    glUseProgram(program);
    ang_uniforms_clip_space(program, &s->space);
    /* Many boxes lie one behind the other. */
    double opacity = fmin(0.4, 6 / sqrt((double)renderer->boxes.blocks + 1));
    ang_uniform_vec4(program, "edge_colour", ang_vec3_scale((ang_vec3){0.95, 0.8, 0.3}, opacity), opacity);
    bool ok = ang_slice_geometry_draw_edges(&renderer->boxes, renderer->octree, &s->frame, err);
    static const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    if (!ang_slice_needs_resolve(scene) && renderer->accumulated.counts) glDrawBuffers(2, attachments);
    return ok;
}

static bool read_counts(const ang_target *target, ang_frame_stats *stats, ang_error *err) {
    size_t room = (size_t)target->width * (size_t)target->height;
    float *own = stats->counts ? NULL : ang_alloc(room, sizeof *own, "counts", err);
    if (!stats->counts && !own) return false;
    uint64_t pixels = 0;
    ang_target_read_counts(target, 0, target->height, own ? own : stats->counts, &stats->samples, &pixels);
    free(own);
    return true;
}

/* What the user should know, in one sentence. */
static void make_note(ang_renderer *renderer, const ang_render_options *options, const ang_slicing *s,
                      uint64_t uploaded) {
    const ang_brick_store *store = &renderer->store;
    const int *made = renderer->octree->level[0].dims, *asked = options->bricks;
    char *note = renderer->note;
    size_t room = sizeof renderer->note;
    int used = 0;
    note[0] = '\0';
    const ang_classification *steps = &renderer->table.classification;
    if (s->visibility.mode == ANG_MODE_DVR && steps->may_miss) used = snprintf(note, room, "%s", steps->warning);
    double slant = s->length / (1.01 * s->planes.distance);
    if (slant > 2)
        used +=
            snprintf(note + used, room - (size_t)used,
                     "%splanes lie %.3g mm apart, but rays at the corners of so wide a field of view cross them every "
                     "%.3g mm: --method singlepass samples all rays alike",
                     used ? "; " : "", s->planes.distance, slant * s->planes.distance);
    bool other = asked[0] != made[0] || asked[1] != made[1] || asked[2] != made[2];
    if (store->whole && asked[0] > 0 && other)
        snprintf(note + used, room - (size_t)used,
                 "%s--bricks %dx%dx%d: bricks of equal size are %dx%dx%d, of %dx%dx%d cells each", used ? "; " : "",
                 asked[0], asked[1], asked[2], made[0], made[1], made[2], renderer->octree->leaf[0],
                 renderer->octree->leaf[1], renderer->octree->leaf[2]);
    if (store->whole) return;
    const ang_octree_level *nodes = &store->octree->level[store->level];
    snprintf(note + used, room - (size_t)used,
             "%sthe volume is drawn in bricks, since %s: %d x %d x %d of up to %d x %d x %d voxels, %zu held at once, "
             "%llu uploaded for this picture",
             used ? "; " : "", store->reason, nodes->dims[0], nodes->dims[1], nodes->dims[2], store->dims[0],
             store->dims[1], store->dims[2], store->slots, (unsigned long long)uploaded);
}

static void sum_up(ang_renderer *renderer, const ang_render_options *options, const ang_slicing *s,
                   uint64_t uploads_before, ang_frame_stats *stats) {
    stats->step_mm = s->planes.distance;
    stats->bricks_total = renderer->boxes.leaves_total;
    stats->bricks_drawn = renderer->boxes.leaves_drawn;
    stats->boxes = renderer->boxes.blocks;
    stats->bricks_uploaded = renderer->store.uploads - uploads_before;
    stats->octree_ms = s->octree_ms;
    make_note(renderer, options, s, stats->bricks_uploaded);
    stats->note = renderer->note[0] ? renderer->note : NULL;
}

static bool draw(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                 const ang_slicing *s, ang_image *image, bool counting, ang_frame_stats *stats,
                 const ang_progress *progress, ang_error *err) {
    programs use;
    unsigned parts = (counting ? ANG_TARGET_COUNTS : 0u) |
                     (s->finishes || scene->mode == ANG_MODE_ISO ? (unsigned)ANG_TARGET_DEPTH : 0u);
    ang_target *shown = ang_slice_needs_resolve(scene) ? &renderer->resolved : &renderer->accumulated;
    ang_slice_recipe recipe = ang_slicing_recipe(renderer, scene, options, s, counting);
    if (!get_programs(renderer, &recipe, &use, err) ||
        !ang_target_resize(&renderer->accumulated, renderer->gl, scene->width, scene->height, parts, err) ||
        (use.resolve && !ang_target_resize(&renderer->resolved, renderer->gl, scene->width, scene->height, 0, err)) ||
        !ang_slice_geometry_make(&renderer->geometry, &renderer->boxes, &s->planes, &s->frame, &s->order, err))
        return false;
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->accumulated.framebuffer);
    glViewport(0, 0, scene->width, scene->height);
    set_state(scene, s, counting);
    for (int k = 0; k < 2; k++) {
        ang_uniforms_ray(use.slices[k], &s->frame);
        ang_uniforms_scene(use.slices[k], scene, renderer->volume, &s->frame, &renderer->table);
        ang_limit_texture_bind(&renderer->limits, scene, use.slices[k], ANG_UNIT_LIMIT);
        ang_slice_geometry_uniforms(&renderer->geometry, use.slices[k], &s->planes, &s->frame, &s->space, &s->order);
        set_planes(use.slices[k], s);
    }
    bool invocations = counting && GLAD_GL_ARB_pipeline_statistics_query;
    if (invocations) glBeginQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB, renderer->invocations);
    bool ok = accumulate(renderer, s, &use, stats, progress, err);
    if (invocations) {
        glEndQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB);
        GLuint64 count = 0;
        glGetQueryObjectui64v(renderer->invocations, GL_QUERY_RESULT, &count);
        stats->fragments = count;
    }
    if (ok && use.resolve) resolve(renderer, scene, s, use.resolve);
    if (ok && use.edges) ok = draw_edges(renderer, scene, s, use.edges, err);
    if (ok) ang_target_read(shown, 0, scene->height, image);
    if (ok) ang_limit_texture_join(&renderer->limits, scene, image);
    return ok && (!counting || read_counts(&renderer->accumulated, stats, err));
}

static bool render(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_image *image,
                   ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    ang_slicing s;
    ang_frame_stats done = {.counts = stats ? stats->counts : NULL};
    uint64_t uploads = renderer->store.uploads;
    bool ok = ang_slicing_decide(renderer, scene, options, &s, err) &&
              draw(renderer, scene, options, &s, image, stats != NULL, &done, progress, err);
    glUseProgram(0);
    glBindVertexArray(0);
    glDisable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (!ok) return false;
    done.classification = ang_scene_classification(scene, &renderer->table);
    sum_up(renderer, options, &s, uploads, &done);
    if (stats) *stats = done;
    return ang_gl_check(renderer->gl, err);
}

const ang_method ang_method_slicing = {
    .name = "slicing",
    .title = "view-aligned slices of octree boxes",
    .source =
        "Rezk-Salama & Kolb, A Vertex Program for Efficient Box-Plane Intersection, VMV 2005; Benassarou, Bittar, "
        "John & Lucas, MC Slicing for Volume Rendering Applications, ICCS 2005",
    .needs_gl = true,
    .takes = ANG_TAKES_TERMINATION | ANG_TAKES_MANUAL_FILTER | ANG_TAKES_NO_SKIP | ANG_TAKES_PROXY | ANG_TAKES_BRICKS |
             ANG_TAKES_PASS_STEPS | ANG_TAKES_SHOW_BRICKS | ANG_TAKES_GPU_MEMORY | ANG_TAKES_CLASSIFICATION,
    .create = create,
    .render = render,
    .explain = ang_slicing_explain,
    .destroy = destroy,
};
