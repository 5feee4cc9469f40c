/* Ray casting in passes: Krueger & Westermann 2003. */
#include "core/render/raycast_private.h"

#include "core/base/memory.h"
#include "core/render/scene_parts.h"

#include <glad/gl.h>
#include <stdlib.h>

/* Work is handed to OpenGL in pieces of about this many samples, so that it can be interrupted. */
static const double piece_samples = 16e6;

static void destroy_paths(ang_raycast_paths *paths) {
    const unsigned textures[] = {paths->entry, paths->direction, paths->wake};
    if (paths->framebuffer) glDeleteFramebuffers(1, &paths->framebuffer);
    glDeleteTextures(3, textures);
    *paths = (ang_raycast_paths){0};
}

static void destroy(ang_renderer *renderer) {
    if (!renderer) return;
    if (renderer->entered) {
        glDeleteQueries(1, &renderer->entered);
        glDeleteQueries(ANG_RAYCAST_LOOK, renderer->finished);
        destroy_paths(&renderer->paths);
    }
    ang_target_destroy(&renderer->resolved);
    ang_block_ranges_destroy(&renderer->blocks);
    ang_ray_pass_destroy(&renderer->pass);
    free(renderer);
}

static ang_renderer *create(ang_gl *gl, const ang_volume *volume, const ang_render_options *options, ang_error *err) {
    ang_renderer *renderer = ang_alloc(1, sizeof *renderer, "the ray caster", err);
    if (!renderer) return NULL;
    if (!ang_ray_pass_make(&renderer->pass, "raycast", gl, volume, options, err)) {
        destroy(renderer);
        return NULL;
    }
    glGenQueries(1, &renderer->entered);
    glGenQueries(ANG_RAYCAST_LOOK, renderer->finished);
    return renderer;
}

static unsigned make_texture(GLenum format, int width, int height) {
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindTexture(GL_TEXTURE_2D, 0);
    return name;
}

/* The textures of the rays, as large as the accumulated target. */
static bool resize_paths(ang_raycast_paths *paths, const ang_target *target, bool directions, bool joined) {
    if (paths->width != target->width || paths->height != target->height) destroy_paths(paths);
    paths->width = target->width;
    paths->height = target->height;
    if (!paths->framebuffer) {
        glGenFramebuffers(1, &paths->framebuffer);
        paths->entry = make_texture(GL_RGBA32F, paths->width, paths->height);
    }
    if (directions && !paths->direction) paths->direction = make_texture(GL_RGBA32F, paths->width, paths->height);
    if (joined && !paths->wake) paths->wake = make_texture(GL_R32F, paths->width, paths->height);
    glBindFramebuffer(GL_FRAMEBUFFER, paths->framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, paths->entry, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, directions ? paths->direction : 0, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT2, GL_TEXTURE_2D, joined ? paths->wake : 0, 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, target->depth);
    const GLenum outputs[] = {GL_COLOR_ATTACHMENT0, directions ? GL_COLOR_ATTACHMENT1 : GL_NONE,
                              joined ? GL_COLOR_ATTACHMENT2 : GL_NONE};
    glDrawBuffers(3, outputs);
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

/* Main passes write what they find, count, and say when a ray is to go on. */
static void set_outputs(const ang_renderer *renderer, bool counting, bool joined) {
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->pass.target.framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT2, GL_TEXTURE_2D, joined ? renderer->paths.wake : 0, 0);
    const GLenum outputs[] = {GL_COLOR_ATTACHMENT0, counting ? GL_COLOR_ATTACHMENT1 : GL_NONE,
                              joined ? GL_COLOR_ATTACHMENT2 : GL_NONE};
    glDrawBuffers(3, outputs);
}

static bool resize(ang_renderer *renderer, const ang_raycast *r, bool counting, ang_error *err) {
    unsigned counts = counting ? (unsigned)ANG_TARGET_COUNTS : 0u;
    unsigned depth = ang_raycast_tests(r) ? (unsigned)ANG_TARGET_DEPTH : 0u;
    bool surface = r->scene->mode == ANG_MODE_ISO;
    ang_gl *gl = renderer->pass.gl;
    int width = r->scene->width, height = r->scene->height;
    if (!ang_target_resize(&renderer->pass.target, gl, width, height, counts | depth, err) ||
        (ang_raycast_has(r, ANG_RAYCAST_RESOLVE) &&
         !ang_target_resize(&renderer->resolved, gl, width, height, surface ? counts : 0, err)))
        return false;
    bool complete =
        resize_paths(&renderer->paths, &renderer->pass.target, ang_plan_uses(&r->plan, ANG_PART_DIRECTIONS), r->joined);
    if (!ang_gl_check(gl, err)) return false;
    return complete || ang_fail(err, ANG_LIMIT,
                                "rays of %dx%d pixels in floats: this OpenGL (%s) refuses them; give a smaller --size",
                                width, height, ang_gl_renderer(gl));
}

/* Every pass has one depth. That of finished pixels is 0; that of main passes falls from one to the next, so that
 * pixels whose depth lies between those of two main passes are left out by the first of them and all before it. */
static double depth_of(const ang_raycast *r, double main_pass) { return 1 - (main_pass + 2) / (r->passes + 4.0); }

static void draw(const ang_raycast *r, GLuint program, double depth) {
    glUseProgram(program);
    glDepthRange(depth, depth);
    glDrawArrays(GL_TRIANGLES, 0, r->covers ? 36 : 3);
}

static void set_blending(const ang_scene *scene) {
    static const struct {
        GLenum equation, source, destination;
        float clear;
    } blends[] = {[ANG_MODE_DVR] = {GL_FUNC_ADD, GL_ONE_MINUS_DST_ALPHA, GL_ONE, 0},
                  [ANG_MODE_MIP] = {GL_MAX, GL_ONE, GL_ONE, 0},
                  [ANG_MODE_MINIP] = {GL_MIN, GL_ONE, GL_ONE, 65535},
                  [ANG_MODE_MEAN] = {GL_FUNC_ADD, GL_ONE, GL_ONE, 0},
                  [ANG_MODE_ISO] = {GL_FUNC_ADD, GL_ONE_MINUS_DST_ALPHA, GL_ONE, 0}};
    float clear = blends[scene->mode].clear;
    const float colour[4] = {clear, clear, clear, clear}, zero[4] = {0};
    glClearBufferfv(GL_COLOR, 0, colour);
    glClearBufferfv(GL_COLOR, 1, zero);
    glEnable(GL_BLEND);
    glDisablei(GL_BLEND, 2);
    glBlendEquationi(0, blends[scene->mode].equation);
    glBlendFunci(0, blends[scene->mode].source, blends[scene->mode].destination);
    glBlendEquationi(1, GL_FUNC_ADD);
    glBlendFunci(1, GL_ONE, GL_ONE);
}

/* Entry and direction of all rays. Those that meet the box open their pixels, which begin as finished. */
static unsigned draw_rays(const ang_renderer *renderer, const ang_raycast *r, GLuint program) {
    const float zero[4] = {0};
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->paths.framebuffer);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    for (int i = 0; i < 3; i++) glClearBufferfv(GL_COLOR, i, zero);
    if (ang_raycast_tests(r)) {
        glClearBufferfv(GL_DEPTH, 0, zero);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_ALWAYS);
    }
    glBeginQuery(GL_SAMPLES_PASSED, renderer->entered);
    draw(r, program, 1);
    glEndQuery(GL_SAMPLES_PASSED);
    glDepthFunc(GL_LESS);
    GLuint entered = 0;
    glGetQueryObjectuiv(renderer->entered, GL_QUERY_RESULT, &entered);
    return entered;
}

/* What the passes between main passes do before main pass `next`; `query` counts the pixels that it finishes. */
static int draw_between(const ang_renderer *renderer, const ang_raycast *r, const GLuint *programs, int next,
                        GLuint query) {
    int drawn = 0;
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->pass.target.depth_only);
    glDepthMask(GL_TRUE);
    /* Before the first main pass only what joined passes know can finish a pixel. */
    glBeginQuery(GL_SAMPLES_PASSED, query);
    if (next > 0 || r->joined) {
        ang_uniform_int(programs[ANG_RAYCAST_FINISH], "pass_next", next);
        draw(r, programs[ANG_RAYCAST_FINISH], 0);
        drawn++;
    }
    glEndQuery(GL_SAMPLES_PASSED);
    if (programs[ANG_RAYCAST_EMPTY]) {
        ang_uniform_int(programs[ANG_RAYCAST_EMPTY], "pass_next", next);
        draw(r, programs[ANG_RAYCAST_EMPTY], depth_of(r, next + 0.5));
        drawn++;
    }
    glDepthMask(GL_FALSE);
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->pass.target.framebuffer);
    return drawn;
}

/* Main passes after which OpenGL is waited for. */
static int passes_of_piece(const ang_raycast *r) {
    double pixels = (double)r->scene->width * r->scene->height;
    return (int)fmin(fmax(piece_samples / (pixels * r->steps), 1), ANG_RAYCAST_LOOK);
}

/* All main passes, until no pixel is left. */
static bool cast(const ang_renderer *renderer, const ang_raycast *r, const GLuint *programs, uint64_t left, int *passes,
                 const ang_progress *progress, ang_error *err) {
    bool tests = ang_raycast_tests(r);
    int piece = passes_of_piece(r), asked = 0;
    for (int k = 0; k < r->passes && left > 0; k++) {
        if (tests) *passes += draw_between(renderer, r, programs, k, renderer->finished[asked++]);
        ang_uniform_int(programs[ANG_RAYCAST_MAIN], "pass_first", k * r->steps);
        draw(r, programs[ANG_RAYCAST_MAIN], depth_of(r, k));
        ++*passes;
        if ((k + 1) % piece != 0 && k + 1 < r->passes) continue;
        if (!tests) glFinish();
        for (; asked > 0; asked--) {
            GLuint found = 0;
            glGetQueryObjectuiv(renderer->finished[asked - 1], GL_QUERY_RESULT, &found);
            left -= found < left ? found : left;
        }
        if (!ang_progress_update(progress, "rendering", (k + 1.0) / r->passes))
            return ang_fail(err, ANG_INTERRUPTED, "interrupted while rendering");
    }
    return true;
}

static void resolve(const ang_renderer *renderer, GLuint program) {
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->resolved.framebuffer);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glUseProgram(program);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

/* Adds the samples of main passes, or of the refinement of surfaces, to `of_pixels`. */
static bool add_counts(const ang_target *target, float *of_pixels, ang_frame_stats *stats, ang_error *err) {
    size_t pixels = (size_t)target->width * (size_t)target->height;
    float *counts = ang_alloc(pixels, sizeof *counts, "counts", err);
    if (!counts) return false;
    uint64_t counted = 0;
    ang_target_read_counts(target, 0, target->height, counts, &stats->samples, &counted);
    for (size_t i = 0; of_pixels && i < pixels; i++) of_pixels[i] += counts[i];
    free(counts);
    return true;
}

static bool read_counts(const ang_renderer *renderer, bool resolved, float *of_pixels, ang_frame_stats *stats,
                        ang_error *err) {
    const ang_target *target = &renderer->pass.target;
    for (size_t i = 0; of_pixels && i < (size_t)target->width * (size_t)target->height; i++) of_pixels[i] = 0;
    return add_counts(target, of_pixels, stats, err) &&
           (!resolved || !renderer->resolved.counts || add_counts(&renderer->resolved, of_pixels, stats, err));
}

static void set_state(const ang_renderer *renderer, const ang_raycast *r) {
    glViewport(0, 0, r->scene->width, r->scene->height);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glBindVertexArray(renderer->pass.vertices);
    ang_raycast_bind(renderer, r);
    if (!r->covers) return;
    /* GL's rows are the picture's from the top, which turns faces round; so does an affine that mirrors. */
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    glFrontFace(ang_mat4_determinant(&r->frame.to_mm) > 0 ? GL_CW : GL_CCW);
}

static void reset_state(void) {
    glUseProgram(0);
    glBindVertexArray(0);
    glDisable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthRange(0, 1);
    glDisable(GL_CULL_FACE);
    glFrontFace(GL_CCW);
    glCullFace(GL_BACK);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

/* Then there is no ray to follow; in other modes what is shown depends on which rays meet the box. */
static bool shows_nothing(const ang_renderer *renderer, const ang_raycast *r) {
    return r->scene->mode == ANG_MODE_DVR && r->skips && renderer->blocks.shown == 0;
}

static bool draw_all(ang_renderer *renderer, const ang_raycast *r, ang_image *image, bool counting,
                     ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    GLuint programs[ANG_RAYCAST_PASSES] = {0};
    /* First, since it binds textures. */
    if (!resize(renderer, r, counting, err)) return false;
    for (int pass = 0; pass < ANG_RAYCAST_PASSES; pass++) {
        if (!ang_raycast_has(r, (ang_raycast_pass)pass)) continue;
        programs[pass] = ang_raycast_program(renderer, r, (ang_raycast_pass)pass, counting, err);
        if (!programs[pass]) return false;
    }
    set_state(renderer, r);
    bool nothing = shows_nothing(renderer, r);
    uint64_t entered = nothing ? 0 : draw_rays(renderer, r, programs[ANG_RAYCAST_RAYS]);
    set_outputs(renderer, counting, r->joined);
    set_blending(r->scene);
    glDepthMask(GL_FALSE);
    stats->fragments = entered;
    stats->passes = !nothing;
    if (!cast(renderer, r, programs, entered, &stats->passes, progress, err)) return false;
    const ang_target *shown = &renderer->pass.target;
    if (programs[ANG_RAYCAST_RESOLVE]) {
        resolve(renderer, programs[ANG_RAYCAST_RESOLVE]);
        shown = &renderer->resolved;
        stats->passes++;
    }
    ang_target_read(shown, 0, r->scene->height, image);
    ang_limit_texture_join(&renderer->pass.limits, r->scene, image);
    return !counting || read_counts(renderer, shown == &renderer->resolved, stats->counts, stats, err);
}

static bool render(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_image *image,
                   ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    ang_raycast r;
    ang_frame_stats done = {.counts = stats ? stats->counts : NULL};
    bool ok = ang_raycast_decide(renderer, scene, options, &r, err) &&
              ang_ray_pass_hold(&renderer->pass, ang_plan_uses(&r.plan, ANG_PART_SLABS) ? NULL : r.first, r.end,
                                &r.upload_ms, err) &&
              draw_all(renderer, &r, image, stats != NULL, &done, progress, err);
    reset_state();
    if (!ok) return false;
    done.step_mm = ang_ray_step(renderer->pass.volume, options);
    done.bricks_total = r.skips ? renderer->blocks.blocks : 1;
    done.bricks_drawn = r.skips ? renderer->blocks.shown : 1;
    done.octree_ms = renderer->blocks.build_ms;
    done.upload_ms = r.upload_ms;
    done.note = ang_ray_pass_note(&renderer->pass, scene);
    done.classification = ang_scene_classification(scene, &renderer->pass.table);
    if (stats) *stats = done;
    return ang_gl_check(renderer->pass.gl, err);
}

const ang_method ang_method_raycast = {
    .name = "raycast",
    .title = "rays in passes of several samples; the depth test ends rays and leaves out empty stretches",
    .source = "Krueger & Westermann, Acceleration Techniques for GPU-based Volume Rendering, IEEE Visualization 2003",
    .needs_gl = true,
    .takes = ANG_TAKES_TERMINATION | ANG_TAKES_MANUAL_FILTER | ANG_TAKES_NO_SKIP | ANG_TAKES_PASS_STEPS |
             ANG_TAKES_SEPARATE_PASSES | ANG_TAKES_GPU_MEMORY | ANG_TAKES_CLASSIFICATION,
    .create = create,
    .render = render,
    .explain = ang_raycast_explain,
    .destroy = destroy,
};
