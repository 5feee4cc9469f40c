/* Object-order empty-space skipping: Haferburg, "Object order empty space skipping in OpenGL 4", and inside the
 * envelope image-order skipping, which that text leaves to others. */
#include "core/render/context_private.h"
#include "core/render/envelope_hull.h"
#include "core/render/gradient_texture.h"
#include "core/render/ray_pass.h"
#include "core/render/scene_parts.h"

#include "core/base/memory.h"

#include <shaders.h>
#include <stdio.h>
#include <stdlib.h>

enum { UNIT_GRID = ANG_UNIT_FREE, UNIT_RANGE, UNIT_GRADIENTS };

/* Faces of the envelope. A small polygon takes software GL about 5 us, so that a frame pays for few; on a GPU as many
 * as Haferburg allows for the 64^3 cells of a 512^3 volume. */
static const size_t most_faces_software = 600, most_faces = 65536;

/* Of a texture of gradients that nobody has asked for. */
static const size_t most_gradient_bytes = (size_t)2 << 30;
static const char no_gradient_memory[] = "there is no memory for it";

struct ang_renderer {
    ang_ray_pass pass;
    ang_skip_grid grid;
    ang_envelope_hull hull;
    ang_gradient_texture gradients;
    bool gradients_refused; /* there was no memory for them */
    char note[160];         /* what the user should know */
};

/* What is decided about one picture. */
typedef struct decision {
    ang_ray_frame frame;
    ang_visibility visibility;
    bool skips, bounds, inside, gradients;
    const char *why_no_skip, *why_no_bounds, *why_no_gradients;
    const ang_renderer *renderer;
} decision;

static void destroy(ang_renderer *renderer) {
    if (!renderer) return;
    ang_gradient_texture_destroy(&renderer->gradients);
    ang_envelope_hull_destroy(&renderer->hull);
    ang_skip_grid_destroy(&renderer->grid);
    ang_ray_pass_destroy(&renderer->pass);
    free(renderer);
}

static ang_renderer *create(ang_gl *gl, const ang_volume *volume, const ang_render_options *options, ang_error *err) {
    ang_renderer *renderer = ang_alloc(1, sizeof *renderer, "the envelope's renderer", err);
    if (!renderer || ang_ray_pass_make(&renderer->pass, "envelope", gl, volume, options, err)) return renderer;
    destroy(renderer);
    return NULL;
}

/* Whether a ray may start inside the volume: the near plane reaches into the clip box. */
static bool may_start_inside(const ang_ray_frame *frame) {
    for (int corner = 0; corner < 8; corner++) {
        ang_vec3 at = {corner & 1 ? frame->upper.x : frame->lower.x, corner & 2 ? frame->upper.y : frame->lower.y,
                       corner & 4 ? frame->upper.z : frame->lower.z};
        ang_vec3 from = ang_vec3_sub(ang_mat4_direction(&frame->to_mm, at), frame->origin_mm);
        if (ang_vec3_dot(from, frame->axis_mm) < frame->near_depth + 1e-3 * fabs(frame->near_depth)) return true;
    }
    return false;
}

/* A texture of gradients pays where samples are shaded and many blocks need none. */
static bool decide_gradients(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                             decision *d, ang_error *err) {
    const ang_volume *volume = renderer->pass.volume;
    if (scene->mode != ANG_MODE_DVR || scene->shading != ANG_SHADING_PHONG)
        d->why_no_gradients =
            scene->mode == ANG_MODE_ISO ? "an iso-surface is shaded once a pixel" : "nothing is shaded";
    else if (options->manual_filter)
        d->why_no_gradients = "--manual-filter";
    else if (options->gradients == ANG_GRADIENTS_LOOKUPS)
        d->why_no_gradients = "--gradients lookups";
    else if (!d->skips)
        d->why_no_gradients = "rays do not skip, and it is made for visible blocks alone";
    else if (options->gpu_memory &&
             ang_gradient_texture_bytes(volume) + 2 * ang_volume_count(volume) > options->gpu_memory)
        d->why_no_gradients = "--gpu-memory does not hold it";
    else if (options->gradients == ANG_GRADIENTS_AUTO && ang_gradient_texture_bytes(volume) > most_gradient_bytes)
        d->why_no_gradients = "it would take more than 2 GB; --gradients texture makes it all the same";
    else if (renderer->gradients_refused)
        d->why_no_gradients = no_gradient_memory;
    else if (!ang_gradient_texture_fits(volume))
        d->why_no_gradients = "it is larger than one texture of this OpenGL may be";
    d->gradients = !d->why_no_gradients;
    renderer->gradients.build_ms = 0;
    ang_error lack = {0};
    if (!d->gradients || ang_gradient_texture_update(&renderer->gradients, renderer->pass.gl, volume, &renderer->grid,
                                                     options->threads, &lack))
        return true;
    if (lack.code != ANG_LIMIT) return ang_fail(err, lack.code, "%s", lack.message);
    ang_gradient_texture_destroy(&renderer->gradients);
    renderer->gradients_refused = true;
    d->gradients = false;
    d->why_no_gradients = no_gradient_memory;
    return true;
}

static bool decide_skipping(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                            decision *d, ang_error *err) {
    const ang_volume *volume = renderer->pass.volume;
    d->visibility = ang_visibility_make(volume, scene, renderer->pass.table.tables);
    renderer->grid.build_ms = 0;
    if (options->no_skip)
        d->why_no_skip = "--no-skip";
    else if (scene->mode == ANG_MODE_MEAN)
        d->why_no_skip = "every value counts in a mean";
    d->why_no_bounds = d->why_no_skip;
    if (d->why_no_skip) return true;
    const ang_volume_texture *field = ang_gl_is_software(renderer->pass.gl) ? NULL : &renderer->pass.field;
    if (!ang_skip_grid_update(&renderer->grid, renderer->pass.gl, volume, field, &d->visibility, options->threads, err))
        return false;
    if (renderer->grid.visible_blocks == renderer->grid.blocks) {
        d->why_no_skip = d->why_no_bounds = "no block of the volume is invisible";
        return true;
    }
    d->skips = options->skipping != ANG_SKIP_OUTSIDE;
    if (!d->skips) d->why_no_skip = "--skipping outside";
    if (options->skipping == ANG_SKIP_BETWEEN) {
        d->why_no_bounds = "--skipping between";
        return true;
    }
    ang_clip_space space = ang_clip_space_make(&d->frame, scene->width, scene->height);
    if (!ang_clip_space_ahead(&space, d->frame.lower, d->frame.upper)) {
        d->why_no_bounds =
            "the eye is in or beside the volume, where faces would be clipped; the clip box bounds the rays";
        return true;
    }
    size_t budget = ang_gl_is_software(renderer->pass.gl) ? most_faces_software : most_faces;
    if (options->quads > 0) budget = (size_t)options->quads;
    if (!ang_envelope_hull_update(&renderer->hull, renderer->pass.gl, &renderer->grid, &d->frame, budget, err))
        return false;
    d->bounds = renderer->hull.cells.side > 0;
    if (!d->bounds) d->why_no_bounds = "its faces would be more than the budget allows; the clip box bounds the rays";
    d->inside = d->bounds && may_start_inside(&d->frame);
    return true;
}

static bool decide(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, decision *d,
                   ang_error *err) {
    *d = (decision){.renderer = renderer};
    return ang_ray_pass_prepare(&renderer->pass, scene, options, &d->frame, err) &&
           decide_skipping(renderer, scene, options, d, err) && decide_gradients(renderer, scene, options, d, err);
}

static void add_parts(const void *context, ang_shader_source *source) {
    const decision *d = context;
    if (!d->bounds) {
        ANG_SHADER_ADD(source, bounds_box);
    } else {
        if (d->inside)
            ANG_SHADER_ADD(source, envelope_inside);
        else
            ANG_SHADER_ADD(source, envelope_outside);
        ANG_SHADER_ADD(source, bounds_envelope);
    }
    if (d->skips)
        ANG_SHADER_ADD(source, skip_distance);
    else
        ANG_SHADER_ADD(source, skip_none);
}

static void set_uniforms(const void *context, unsigned program, const ang_ray_frame *frame) {
    const decision *d = context;
    if (d->skips) ang_skip_grid_bind(&d->renderer->grid, program, UNIT_GRID, frame->centre);
    if (d->bounds) ang_envelope_hull_bind(&d->renderer->hull, program, UNIT_RANGE);
    if (d->gradients) ang_gradient_texture_bind(&d->renderer->gradients, program, UNIT_GRADIENTS);
}

static void compose_range(ang_shader_source *vertex, ang_shader_source *fragment) {
    *vertex = *fragment = (ang_shader_source){.count = 0};
    ang_envelope_hull_parts(vertex, fragment);
}

static bool draw_range(ang_renderer *renderer, const ang_scene *scene, const decision *d, ang_error *err) {
    ang_shader_source vertex, fragment;
    compose_range(&vertex, &fragment);
    unsigned program = ang_programs_get(&renderer->pass.programs, "envelope", &vertex, &fragment, err);
    return program && ang_envelope_hull_draw(&renderer->hull, renderer->pass.gl, program, &renderer->grid, &d->frame,
                                             scene->width, scene->height, err);
}

static bool render(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_image *image,
                   ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    decision d;
    if (!decide(renderer, scene, options, &d, err)) return false;
    if (d.bounds && !draw_range(renderer, scene, &d, err)) return false;
    const ang_skip_grid *grid = &renderer->grid;
    bool refused = options->gradients == ANG_GRADIENTS_TEXTURE && d.why_no_gradients;
    if (refused)
        snprintf(renderer->note, sizeof renderer->note, "--gradients texture: gradients are looked up, since %s",
                 d.why_no_gradients);
    if (stats)
        *stats = (ang_frame_stats){.counts = stats->counts,
                                   .bricks_drawn = d.skips || d.bounds ? grid->visible_blocks : 1,
                                   .bricks_total = d.skips || d.bounds ? grid->blocks : 1,
                                   .polygons = d.bounds ? renderer->hull.faces : 0,
                                   .passes = d.bounds ? 2 : 1,
                                   .octree_ms = grid->build_ms,
                                   .upload_ms = renderer->gradients.build_ms,
                                   .note = refused ? renderer->note : NULL};
    const ang_ray_limits limits = {add_parts, set_uniforms, &d, d.skips, d.gradients};
    return ang_ray_pass_draw(&renderer->pass, scene, options, &d.frame, &limits, image, stats, progress, err);
}

static void explain_skipping(const ang_renderer *renderer, const decision *d, ang_plan *plan) {
    const ang_skip_grid *grid = &renderer->grid;
    if (!d->skips) {
        ang_plan_leave_out(plan, "skipping of invisible blocks", "%s", d->why_no_skip);
    } else {
        ang_plan_use(plan,
                     "skipping by the distance to the next visible block: %zu of %zu blocks of %d cells a side "
                     "show",
                     grid->visible_blocks, grid->blocks, ANG_SKIP_BLOCK);
        if (ang_gl_is_software(renderer->pass.gl))
            ang_plan_leave_out(plan, "ranges of blocks by compute shader", "without a GPU the processor is faster");
        else
            ang_plan_use(plan, "ranges of blocks by compute shader");
        if (grid->visible_blocks < grid->blocks)
            ang_plan_leave_out(plan, "parts of the volume", "%zu of %zu blocks: %s",
                               grid->blocks - grid->visible_blocks, grid->blocks,
                               ang_visibility_reason(d->visibility.mode));
    }
    if (!d->bounds) {
        ang_plan_leave_out(plan, "envelope of what shows", "%s", d->why_no_bounds);
        return;
    }
    int side = ANG_SKIP_BLOCK * renderer->hull.cells.side;
    ang_plan_use(plan, "envelope of what shows: %zu faces of cells of %dx%dx%d", renderer->hull.faces, side, side,
                 side);
    if (!d->inside)
        ang_plan_leave_out(plan, "rays that start inside the envelope", "the near plane lies before the whole volume");
}

static bool explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_plan *plan,
                    ang_error *err) {
    decision d;
    if (!decide(renderer, scene, options, &d, err)) return false;
    explain_skipping(renderer, &d, plan);
    if (d.gradients)
        ang_plan_use(plan, "texture of gradients: %zu blocks filled, %.1f MB", renderer->gradients.blocks_filled,
                     (double)renderer->gradients.bytes / 1e6);
    else
        ang_plan_leave_out(plan, "texture of gradients", "%s", d.why_no_gradients);
    if (d.bounds) {
        ang_shader_source vertex, fragment;
        compose_range(&vertex, &fragment);
        ang_shader_explain(plan, "range of each ray in the envelope", &vertex, &fragment, 0);
    }
    const ang_ray_limits limits = {add_parts, set_uniforms, &d, d.skips, d.gradients};
    ang_ray_pass_explain(&renderer->pass, scene, options, &limits, plan);
    return true;
}

const ang_method ang_method_envelope = {
    .name = "envelope",
    .title = "rays between the faces of an envelope of what shows, skipping inside it",
    .source = "Haferburg, Object order empty space skipping in OpenGL 4",
    .needs_gl = true,
    .takes = ANG_TAKES_COUNT_SHOWN | ANG_TAKES_TERMINATION | ANG_TAKES_MANUAL_FILTER | ANG_TAKES_NO_SKIP |
             ANG_TAKES_GRADIENTS | ANG_TAKES_ENVELOPE | ANG_TAKES_GPU_MEMORY,
    .create = create,
    .render = render,
    .explain = explain,
    .destroy = destroy,
};
