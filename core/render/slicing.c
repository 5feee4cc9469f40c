/* Slicing with octree skipping: Rezk-Salama & Kolb 2005; the proxies of Benassarou et al. 2005. */
#include "core/render/method.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/plan/boxes.h"
#include "core/render/brick_store.h"
#include "core/render/scene_parts.h"
#include "core/render/slice_geometry.h"
#include "core/render/slice_program.h"
#include "core/render/target.h"

#include <glad/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { UNIT_ACCUMULATED = ANG_UNIT_FREE };

/* Voxels: no farther from any voxel is another. */
static double most_reach(const ang_volume *volume) {
    const int *dims = volume->dims;
    return fmax(dims[0], fmax(dims[1], dims[2]));
}

/* What a polygon costs in fragments, without and with shading: measured on llvmpipe (docs/papers.md). */
static const double polygon_cost = 300, polygon_cost_shaded = 120;
/* Work is handed to OpenGL in pieces of about this many fragments, so that it can be interrupted... */
static const double piece_samples = 8e6;
/* ... and pixels that are finished are looked for about this often in a picture, but not for less than this many
 * fragments a pixel: a look costs about four. */
static const double finish_looks = 12, finish_least = 8;
/* A look that finds less than this share of the picture was not worth it. */
static const double finish_share = 0.02;

struct ang_renderer {
    ang_gl *gl;
    const ang_volume *volume;
    ang_brick_store store;
    ang_table_texture table;
    ang_programs programs;
    ang_target accumulated, resolved;
    ang_slice_geometry geometry;
    ang_slice_boxes boxes;
    ang_octree *octree;
    GLuint vertices;    /* no attributes, but a draw needs one bound */
    GLuint query;       /* counts finished pixels */
    GLuint invocations; /* counts fragments */
    char note[512];     /* what the user should know */
};

/* All that is decided about one picture before anything is drawn. */
typedef struct slicing {
    ang_ray_frame frame;
    ang_clip_space space;
    ang_slice_planes planes;
    ang_vec3 margin; /* index units: see step_margin */
    double length;   /* mm of a ray from one plane to the next, at most */
    int group;       /* planes that share a polygon */
    ang_visibility visibility;
    ang_brick_needs needs;
    ang_slice_order order;
    bool skips, finishes;
    const char *why_no_skip, *why_no_finish;
    double octree_ms;
} slicing;

static void destroy(ang_renderer *renderer) {
    if (!renderer) return;
    if (renderer->vertices) glDeleteVertexArrays(1, &renderer->vertices);
    if (renderer->query) glDeleteQueries(1, &renderer->query);
    if (renderer->invocations) glDeleteQueries(1, &renderer->invocations);
    ang_target_destroy(&renderer->accumulated);
    ang_target_destroy(&renderer->resolved);
    ang_programs_clear(&renderer->programs);
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

/* Millimetres that a ray moves from one plane to the next, at most. */
static double step_length(const ang_scene *scene, const ang_ray_frame *frame, const ang_slice_planes *planes) {
    double least_cosine = 1;
    for (int corner = 0; corner < 4; corner++) {
        ang_ray ray = ang_ray_through(frame, corner & 1 ? scene->width : 0, corner & 2 ? scene->height : 0);
        least_cosine = fmin(least_cosine, ang_vec3_dot(ray.direction_mm, frame->axis_mm));
    }
    return 1.01 * planes->distance / fmax(least_cosine, 1e-3);
}

/* The same in index units along each axis. */
static ang_vec3 step_margin(const ang_ray_frame *frame, double length) {
    double margin[3];
    for (int axis = 0; axis < 3; axis++) {
        const double *row = frame->to_index.m[axis];
        margin[axis] = length * sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
    }
    return (ang_vec3){margin[0], margin[1], margin[2]};
}

static bool prepare_octree(ang_renderer *renderer, const ang_render_options *options, slicing *s, ang_error *err) {
    const ang_volume *volume = renderer->volume;
    int leaf[3], apron = 1;
    /* A hit before a plane shows at that plane: what lies a step before it must count as well. */
    if (s->visibility.mode == ANG_MODE_ISO) apron += s->needs.reach;
    for (int axis = 0; axis < 3; axis++) {
        int cells = volume->dims[axis] > 1 ? volume->dims[axis] - 1 : 1, bricks = options->bricks[axis];
        leaf[axis] = bricks > 0 ? (cells + bricks - 1) / bricks : ANG_OCTREE_LEAF;
        if (leaf[axis] > cells) leaf[axis] = cells;
    }
    ang_octree *now = renderer->octree;
    if (now && memcmp(now->leaf, leaf, sizeof leaf) == 0 && now->apron == apron) return true;
    ang_octree_free(now);
    double start = ang_now_ms();
    renderer->octree = ang_octree_build(volume, leaf, apron, options->threads, err);
    s->octree_ms = ang_now_ms() - start;
    return renderer->octree != NULL;
}

static void decide_skipping(const ang_renderer *renderer, const ang_render_options *options, slicing *s) {
    s->why_no_skip = NULL;
    if (options->no_skip)
        s->why_no_skip = "--no-skip";
    else if (s->visibility.mode == ANG_MODE_MEAN)
        s->why_no_skip = "every value counts in a mean";
    else if (ang_visibility_of_all(&s->visibility, renderer->octree->level[renderer->octree->levels - 1].nodes[0]))
        s->why_no_skip = "nothing in the volume is invisible";
    s->skips = !s->why_no_skip;
}

/* Looks for finished pixels are left out where they cannot pay. */
static void decide_finishing(const ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                             slicing *s) {
    s->why_no_finish = NULL;
    if (scene->mode != ANG_MODE_DVR) {
        s->why_no_finish = scene->mode == ANG_MODE_ISO ? "the depth test itself keeps the nearest hit"
                                                       : "every sample counts in this mode";
    } else if (!(options->termination < 1)) {
        s->why_no_finish = "--no-termination";
    } else {
        double depth = renderer->table.greatest * 2 * ang_volume_half_diagonal(renderer->volume);
        if (-expm1(-depth) < options->termination)
            s->why_no_finish = "no ray can reach the threshold";
        else if (renderer->boxes.samples < finish_least * scene->width * scene->height)
            s->why_no_finish = "there are too few fragments to spare any";
    }
    s->finishes = !s->why_no_finish;
}

static bool same_texture(const void *context, const ang_slice_box *a, const ang_slice_box *b) {
    return ang_brick_store_same(context, a->level, a->node, b->level, b->node);
}

static void decide_order(const ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                         slicing *s) {
    s->order = (ang_slice_order){.proxy = options->proxy,
                                 .back_to_front = scene->mode == ANG_MODE_DVR && !s->finishes,
                                 .group = s->group,
                                 .margin = s->margin,
                                 .most_samples = piece_samples,
                                 .same_texture = same_texture,
                                 .context = &renderer->store};
    if (s->finishes) {
        double least = finish_least * scene->width * scene->height;
        s->order.most_samples = fmin(fmax(renderer->boxes.samples / finish_looks, least), piece_samples);
    }
}

/* Everything up to the boxes: what render() and explain() share. */
static bool decide(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, slicing *s,
                   ang_error *err) {
    *s = (slicing){0};
    const ang_volume *volume = renderer->volume;
    if (!(options->step_voxels > 0))
        return ang_fail(err, ANG_USAGE, "--step %g: give a positive multiple of the smallest spacing",
                        options->step_voxels);
    if (!ang_scene_check(scene, err) || !ang_ray_frame_make(volume, scene, &s->frame, err)) return false;
    if (ang_scene_needs_table(scene) &&
        !ang_table_texture_update(&renderer->table, renderer->gl, scene->transfer, volume, err))
        return false;
    s->space = ang_clip_space_make(&s->frame, scene->width, scene->height);
    s->planes = ang_slice_planes_make(&s->frame, options->step_voxels * ang_volume_smallest_spacing(volume));
    s->visibility = ang_visibility_make(volume, scene, renderer->table.tables);
    s->needs.weight = ang_scene_needs_weight(scene, volume);
    s->needs.reach = ang_scene_needs_phong(scene);
    s->length = step_length(scene, &s->frame, &s->planes);
    s->margin = step_margin(&s->frame, s->length);
    if (scene->mode == ANG_MODE_ISO)
        s->needs.reach += (int)fmin(ceil(fmax(s->margin.x, fmax(s->margin.y, s->margin.z))), most_reach(volume));
    if (!prepare_octree(renderer, options, s, err) ||
        !ang_brick_store_arrange(&renderer->store, renderer->octree, s->needs, err))
        return false;
    decide_skipping(renderer, options, s);
    s->group = ang_slice_group(scene, options);
    bool shaded = ang_scene_needs_phong(scene);
    ang_slice_cut cut = {.visibility = s->skips ? &s->visibility : NULL,
                         .to_leaves = options->bricks[0] > 0,
                         .top_level = ang_brick_store_level(&renderer->store),
                         .margin = s->margin,
                         .group = s->group,
                         .polygon_cost = shaded ? polygon_cost_shaded : polygon_cost};
    if (!ang_slice_boxes_make(&renderer->boxes, renderer->octree, &s->frame, &s->planes, &s->space, &cut, err))
        return false;
    decide_finishing(renderer, scene, options, s);
    decide_order(renderer, scene, options, s);
    return true;
}

/* Blending and depth test of the pass that accumulates. */
static void set_state(const ang_scene *scene, const slicing *s, bool counting) {
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
static void set_planes(GLuint program, const slicing *s) {
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

static ang_slice_recipe make_recipe(const ang_renderer *renderer, const ang_scene *scene,
                                    const ang_render_options *options, const slicing *s, bool counting) {
    return (ang_slice_recipe){scene, renderer->volume, options, &renderer->table, s->length, s->finishes, counting};
}

static bool get_program(ang_renderer *renderer, bool wanted, ang_slice_pass pass, const ang_slice_recipe *recipe,
                        GLuint *program, ang_error *err) {
    *program = wanted ? ang_slice_program(&renderer->programs, pass, recipe, err) : 0;
    return !wanted || *program;
}

static bool get_programs(ang_renderer *renderer, const ang_slice_recipe *recipe, programs *out, ang_error *err) {
    bool resolves = ang_slice_needs_resolve(recipe->scene), edges = recipe->options->show_bricks;
    if (!get_program(renderer, true, ANG_SLICE_INNER, recipe, &out->slices[0], err) ||
        !get_program(renderer, true, ANG_SLICE_FACES, recipe, &out->slices[1], err) ||
        !get_program(renderer, recipe->early, ANG_SLICE_FINISH, recipe, &out->finish, err) ||
        !get_program(renderer, resolves, ANG_SLICE_RESOLVE, recipe, &out->resolve, err) ||
        !get_program(renderer, edges, ANG_SLICE_EDGES, recipe, &out->edges, err))
        return false;
    if (!out->finish) return true;
    ang_uniform_int(out->finish, "slice_accumulated", UNIT_ACCUMULATED);
    ang_uniform_float(out->finish, "termination", recipe->options->termination);
    return true;
}

/* Draws all slices; the accumulated target is bound. */
static bool accumulate(ang_renderer *renderer, const slicing *s, const programs *use, ang_frame_stats *stats,
                       const ang_progress *progress, ang_error *err) {
    const ang_slice_geometry *geometry = &renderer->geometry;
    const ang_volume_texture *bound = NULL;
    double drawn = 0, since_look = 0, since_stop = 0, total = fmax(renderer->boxes.samples, 1);
    double interval = s->order.most_samples,
           worth = finish_share * renderer->accumulated.width * renderer->accumulated.height;
    int looks = 0;
    for (size_t i = 0; i < geometry->draws; i++) {
        const ang_slice_draw *draw = &geometry->draw[i];
        double start = ang_now_ms();
        uint64_t uploads = renderer->store.uploads;
        const ang_volume_texture *texture = ang_brick_store_get(&renderer->store, draw->level, draw->node, err);
        if (!texture) return false;
        if (texture != bound || uploads != renderer->store.uploads)
            for (int k = 0; k < 2; k++) ang_uniforms_field(use->slices[k], texture, renderer->volume, &s->frame);
        if (uploads != renderer->store.uploads) stats->upload_ms += ang_now_ms() - start;
        bound = texture;
        glUseProgram(use->slices[draw->faces]);
        ang_slice_geometry_draw(geometry, draw, s->order.proxy);
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

static void resolve(ang_renderer *renderer, const ang_scene *scene, const slicing *s, GLuint program) {
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
static bool draw_edges(ang_renderer *renderer, const ang_scene *scene, const slicing *s, GLuint program,
                       ang_error *err) {
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDrawBuffer(GL_COLOR_ATTACHMENT0); /* edges are no samples */
    glUseProgram(program);
    ang_uniforms_clip_space(program, &s->space);
    /* Many boxes lie one behind the other. */
    double opacity = fmin(0.4, 6 / sqrt((double)renderer->boxes.nodes + 1));
    ang_uniform_vec4(program, "edge_colour", ang_vec3_scale((ang_vec3){0.95, 0.8, 0.3}, opacity), opacity);
    bool ok = ang_slice_geometry_draw_edges(&renderer->boxes, renderer->octree, &s->frame, err);
    static const GLenum attachments[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    if (!ang_slice_needs_resolve(scene) && renderer->accumulated.counts) glDrawBuffers(2, attachments);
    return ok;
}

static bool read_counts(const ang_target *target, ang_frame_stats *stats, ang_error *err) {
    float *counts = ang_alloc((size_t)target->width * (size_t)target->height, sizeof *counts, "counts", err);
    if (!counts) return false;
    uint64_t pixels = 0;
    ang_target_read_counts(target, 0, target->height, counts, &stats->samples, &pixels);
    free(counts);
    return true;
}

static void make_note(ang_renderer *renderer, const ang_render_options *options) {
    const ang_brick_store *store = &renderer->store;
    const int *made = renderer->octree->level[0].dims, *asked = options->bricks;
    renderer->note[0] = '\0';
    bool other = asked[0] != made[0] || asked[1] != made[1] || asked[2] != made[2];
    if (store->whole && asked[0] > 0 && other)
        snprintf(renderer->note, sizeof renderer->note,
                 "--bricks %dx%dx%d: bricks of equal size are %dx%dx%d, of %dx%dx%d cells each", asked[0], asked[1],
                 asked[2], made[0], made[1], made[2], renderer->octree->leaf[0], renderer->octree->leaf[1],
                 renderer->octree->leaf[2]);
    if (store->whole) return;
    const ang_octree_level *nodes = &store->octree->level[store->level];
    snprintf(renderer->note, sizeof renderer->note,
             "the volume is drawn in bricks, since %s: %d x %d x %d of up to %d x %d x %d voxels, %zu held at once",
             store->reason, nodes->dims[0], nodes->dims[1], nodes->dims[2], store->dims[0], store->dims[1],
             store->dims[2], store->slots);
}

static void sum_up(ang_renderer *renderer, const ang_render_options *options, const slicing *s, uint64_t uploads_before,
                   ang_frame_stats *stats) {
    stats->step_mm = s->planes.distance;
    stats->bricks_total = renderer->boxes.leaves_total;
    stats->bricks_drawn = renderer->boxes.nodes;
    stats->bricks_uploaded = renderer->store.uploads - uploads_before;
    stats->octree_ms = s->octree_ms;
    make_note(renderer, options);
    stats->note = renderer->note[0] ? renderer->note : NULL;
}

static bool draw(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, const slicing *s,
                 ang_image *image, bool counting, ang_frame_stats *stats, const ang_progress *progress,
                 ang_error *err) {
    programs use;
    unsigned parts = (counting ? ANG_TARGET_COUNTS : 0u) |
                     (s->finishes || scene->mode == ANG_MODE_ISO ? (unsigned)ANG_TARGET_DEPTH : 0u);
    ang_target *shown = ang_slice_needs_resolve(scene) ? &renderer->resolved : &renderer->accumulated;
    ang_slice_recipe recipe = make_recipe(renderer, scene, options, s, counting);
    if (!get_programs(renderer, &recipe, &use, err) ||
        !ang_target_resize(&renderer->accumulated, renderer->gl, scene->width, scene->height, parts, err) ||
        (use.resolve && !ang_target_resize(&renderer->resolved, renderer->gl, scene->width, scene->height, 0, err)) ||
        !ang_slice_geometry_make(&renderer->geometry, renderer->gl, &renderer->boxes, &s->planes, &s->frame, &s->order,
                                 err))
        return false;
    glBindFramebuffer(GL_FRAMEBUFFER, renderer->accumulated.framebuffer);
    glViewport(0, 0, scene->width, scene->height);
    set_state(scene, s, counting);
    for (int k = 0; k < 2; k++) {
        ang_uniforms_ray(use.slices[k], &s->frame);
        ang_uniforms_scene(use.slices[k], scene, renderer->volume, &s->frame, &renderer->table);
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
    return ok && (!counting || read_counts(&renderer->accumulated, stats, err));
}

static bool render(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_image *image,
                   ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    slicing s;
    ang_frame_stats done = {0};
    uint64_t uploads = renderer->store.uploads;
    bool ok = decide(renderer, scene, options, &s, err) &&
              draw(renderer, scene, options, &s, image, stats != NULL, &done, progress, err);
    glUseProgram(0);
    glBindVertexArray(0);
    glDisable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (!ok) return false;
    sum_up(renderer, options, &s, uploads, &done);
    if (stats) *stats = done;
    return ang_gl_check(renderer->gl, err);
}

static void explain_storage(const ang_renderer *renderer, ang_plan *plan) {
    const ang_brick_store *store = &renderer->store;
    if (store->whole) {
        ang_plan_use(plan, "one 3D texture of 16 bits for the whole volume");
        ang_plan_leave_out(plan, "one texture a brick", "the volume fits into one");
    } else {
        ang_plan_use(plan, "one 3D texture of 16 bits a brick, since %s; invisible bricks are never uploaded",
                     store->reason);
    }
}

static void explain_boxes(const ang_renderer *renderer, const slicing *s, ang_plan *plan) {
    const ang_slice_boxes *boxes = &renderer->boxes;
    ang_plan_use(plan, "%d planes %.4g mm apart, %s", s->planes.count, s->planes.distance,
                 s->order.back_to_front ? "back to front" : "front to back");
    if (s->group > 1)
        ang_plan_use(plan, "%d planes composited by a fragment before it blends", s->group);
    else
        ang_plan_leave_out(plan, "compositing of planes before they blend", "%s",
                           s->visibility.mode == ANG_MODE_ISO ? "only the nearest hit shows"
                                                              : "it does not pay with shading, or --passes-steps 1");
    ang_plan_use(plan, "polygons by %s: %zu boxes of the octree, %.0f polygons", ang_proxy_name(s->order.proxy),
                 boxes->nodes, boxes->polygons);
    if (!s->skips) ang_plan_leave_out(plan, "skipping of invisible boxes", "%s", s->why_no_skip);
    if (boxes->leaves_total > boxes->leaves_drawn)
        ang_plan_leave_out(plan, "boxes", "%zu of %zu leaves of the octree: %s%sout of the picture or the clip box",
                           boxes->leaves_total - boxes->leaves_drawn, boxes->leaves_total,
                           s->skips ? ang_visibility_reason(s->visibility.mode) : "", s->skips ? ", or " : "");
}

static bool explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_plan *plan,
                    ang_error *err) {
    slicing s;
    if (!decide(renderer, scene, options, &s, err)) return false;
    explain_storage(renderer, plan);
    explain_boxes(renderer, &s, plan);
    ang_scene_explain(plan, scene, renderer->volume);
    ang_slice_recipe recipe = make_recipe(renderer, scene, options, &s, false);
    ang_slice_explain_pass(plan, ANG_SLICE_INNER, &recipe);
    ang_slice_explain_pass(plan, ANG_SLICE_FACES, &recipe);
    if (s.finishes)
        ang_slice_explain_pass(plan, ANG_SLICE_FINISH, &recipe);
    else
        ang_plan_leave_out(plan, "early termination by the depth test", "%s", s.why_no_finish);
    if (ang_slice_needs_resolve(scene))
        ang_slice_explain_pass(plan, ANG_SLICE_RESOLVE, &recipe);
    else
        ang_plan_leave_out(plan, "pass from values to grey", "slices blend to the picture itself");
    if (options->show_bricks) ang_slice_explain_pass(plan, ANG_SLICE_EDGES, &recipe);
    return true;
}

const ang_method ang_method_slicing = {
    .name = "slicing",
    .title = "view-aligned slices of octree boxes",
    .source =
        "Rezk-Salama & Kolb, A Vertex Program for Efficient Box-Plane Intersection, VMV 2005; Benassarou, Bittar, "
        "John & Lucas, MC Slicing for Volume Rendering Applications, ICCS 2005",
    .needs_gl = true,
    .create = create,
    .render = render,
    .explain = explain,
    .destroy = destroy,
};
