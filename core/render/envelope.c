/* Object-order empty-space skipping: Haferburg, "Object order empty space skipping in OpenGL 4", and inside the
 * envelope image-order skipping, which that text leaves to others. */
#include "core/render/context_private.h"
#include "core/render/envelope_hull.h"
#include "core/render/facts.h"
#include "core/render/gradient_texture.h"
#include "core/render/ray_pass.h"
#include "core/render/scene_parts.h"
#include "core/render/skip_grid.h"

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
    ang_plan_facts facts;
    ang_plan_decisions plan;
    int first[3], end[3]; /* voxels that may be sampled */
    double upload_ms;
    const ang_renderer *renderer;
} decision;

static bool uses(const decision *d, ang_part part) { return ang_plan_uses(&d->plan, part); }
/* Whether rays are bounded by the box of what shows, where no faces do it. */
static bool is_boxed(const decision *d) { return !uses(d, ANG_PART_HULL) && !uses(d, ANG_PART_BORDER); }

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

/* The grid of blocks, where they may be skipped or bound the rays. */
static bool build_grid(ang_renderer *renderer, const ang_render_options *options, decision *d, ang_error *err) {
    const ang_volume *volume = renderer->pass.volume;
    ang_gl *gl = renderer->pass.gl;
    const ang_volume_texture *field = d->facts.software ? NULL : &renderer->pass.field;
    if (field && !ang_ray_pass_hold(&renderer->pass, NULL, NULL, &d->upload_ms, err)) return false;
    if (!ang_skip_grid_update(&renderer->grid, gl, volume, field, &d->visibility, options->threads, err)) return false;
    d->facts.blocks = renderer->grid.shown.blocks;
    d->facts.shown = renderer->grid.shown.visible_blocks;
    return true;
}

static bool build_hull(ang_renderer *renderer, const ang_render_options *options, decision *d, ang_error *err) {
    size_t budget = d->facts.software ? most_faces_software : most_faces;
    if (options->quads > 0) budget = (size_t)options->quads;
    if (!ang_envelope_hull_update(&renderer->hull, renderer->pass.gl, &renderer->grid.shown, &d->frame, budget, err))
        return false;
    d->facts.hull_fits = renderer->hull.cells.side > 0;
    return true;
}

/* Where there is no memory for them they are looked up. */
static bool build_gradients(ang_renderer *renderer, const ang_render_options *options, decision *d, ang_error *err) {
    ang_error lack = {0};
    if (!uses(d, ANG_PART_GRADIENT_TEXTURE) ||
        ang_gradient_texture_update(&renderer->gradients, renderer->pass.gl, renderer->pass.volume,
                                    &renderer->grid.shown, options->threads, &lack))
        return true;
    if (lack.code != ANG_LIMIT) return ang_fail(err, lack.code, "%s", lack.message);
    ang_gradient_texture_destroy(&renderer->gradients);
    renderer->gradients_refused = d->facts.gradients_refused = true;
    d->plan = ang_plan_decide(&d->facts);
    return true;
}

/* What the rays may sample: visible blocks, and the sample after one. An iso-surface looks at the entry of rays as
 * well. */
static void find_sampled(const ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                         decision *d) {
    const ang_volume *volume = renderer->pass.volume;
    d->facts.texture_shared = d->facts.software && scene->mode != ANG_MODE_ISO;
    if (!renderer->grid.shown.octree || !d->facts.texture_shared) return;
    ang_vec3 margin = ang_facts_margin(&d->frame, 2.02 * ang_ray_step(volume, options));
    margin = ang_vec3_add(margin, (ang_vec3){1, 1, 1});
    d->facts.share_uploaded =
        ang_block_box_voxels(&renderer->grid.shown.box, renderer->grid.shown.octree, volume, margin, d->first, d->end);
    if (!uses(d, ANG_PART_GRADIENT_TEXTURE)) return;
    d->facts.share_uploaded = 0;
    for (int axis = 0; axis < 3; axis++) d->end[axis] = d->first[axis];
}

/* Decides as far as is known, builds what that takes, and decides again. */
static bool decide(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, decision *d,
                   ang_error *err) {
    const ang_volume *volume = renderer->pass.volume;
    *d = (decision){.renderer = renderer};
    renderer->grid.shown.build_ms = renderer->gradients.build_ms = 0;
    if (!ang_ray_pass_prepare(&renderer->pass, scene, options, &d->frame, err)) return false;
    d->visibility = ang_visibility_make(volume, scene, renderer->pass.table.cache.tables);
    d->facts = ang_ray_pass_facts(&renderer->pass, ANG_DRAW_ENVELOPE, scene, options, &d->frame);
    d->facts.gradient_bytes = (double)ang_gradient_texture_bytes(volume);
    d->facts.gradient_limit = (double)most_gradient_bytes;
    d->facts.gradients_refused = renderer->gradients_refused;
    d->plan = ang_plan_decide(&d->facts);
    bool blocks = uses(d, ANG_PART_SKIPPING) || uses(d, ANG_PART_HULL) || !uses(d, ANG_PART_BORDER);
    if (blocks && !build_grid(renderer, options, d, err)) return false;
    d->plan = ang_plan_decide(&d->facts);
    if (uses(d, ANG_PART_HULL) && !build_hull(renderer, options, d, err)) return false;
    if (uses(d, ANG_PART_GRADIENT_TEXTURE)) d->facts.gradients_fit = ang_gradient_texture_fits(volume);
    d->plan = ang_plan_decide(&d->facts);
    if (!build_gradients(renderer, options, d, err)) return false;
    find_sampled(renderer, scene, options, d);
    d->plan = ang_plan_decide(&d->facts);
    return true;
}

static void add_parts(const void *context, ang_shader_source *source) {
    const decision *d = context;
    if (uses(d, ANG_PART_BORDER)) {
        ANG_SHADER_ADD(source, bounds_box);
    } else if (is_boxed(d)) {
        ANG_SHADER_ADD(source, bounds_shown);
    } else {
        if (uses(d, ANG_PART_NEAR_PLANE))
            ANG_SHADER_ADD(source, envelope_inside);
        else
            ANG_SHADER_ADD(source, envelope_outside);
        ANG_SHADER_ADD(source, bounds_envelope);
    }
    if (uses(d, ANG_PART_SKIPPING))
        ANG_SHADER_ADD(source, skip_distance);
    else
        ANG_SHADER_ADD(source, skip_none);
}

/* bounds_shown.glsl: half a voxel more on each side for rounding. */
static void bind_box(const ang_block_grid *grid, unsigned program) {
    double lower[3], upper[3];
    for (int axis = 0; axis < 3; axis++) {
        /* The first cell of the box begins at the first voxel, or half a voxel before it where there is only one. */
        double start = -0.5 * grid->octree->cells[axis], leaf = grid->octree->leaf[axis];
        lower[axis] = start + grid->box.first[axis] * leaf - 0.5;
        upper[axis] = start + grid->box.end[axis] * leaf + 0.5;
        if (grid->box.end[axis] <= grid->box.first[axis]) lower[axis] = upper[axis] = 1e9;
    }
    ang_uniform_vec3(program, "shown_lower", (ang_vec3){lower[0], lower[1], lower[2]});
    ang_uniform_vec3(program, "shown_upper", (ang_vec3){upper[0], upper[1], upper[2]});
}

static void set_uniforms(const void *context, unsigned program, const ang_ray_frame *frame) {
    const decision *d = context;
    const ang_renderer *renderer = d->renderer;
    if (uses(d, ANG_PART_SKIPPING)) ang_skip_grid_bind(&renderer->grid, program, UNIT_GRID, frame->centre);
    if (uses(d, ANG_PART_HULL)) ang_envelope_hull_bind(&renderer->hull, program, UNIT_RANGE);
    if (is_boxed(d)) bind_box(&renderer->grid.shown, program);
    if (uses(d, ANG_PART_GRADIENT_TEXTURE)) ang_gradient_texture_bind(&renderer->gradients, program, UNIT_GRADIENTS);
}

static void compose_range(const decision *d, ang_shader_source *vertex, ang_shader_source *fragment) {
    *vertex = *fragment = (ang_shader_source){.count = 0};
    ang_envelope_hull_parts(vertex, fragment, uses(d, ANG_PART_CLIP_PLANE));
}

static bool draw_range(ang_renderer *renderer, const ang_scene *scene, const decision *d, ang_error *err) {
    ang_shader_source vertex, fragment;
    compose_range(d, &vertex, &fragment);
    unsigned program = ang_programs_get(&renderer->pass.programs, "envelope", &vertex, &fragment, err);
    return program && ang_envelope_hull_draw(&renderer->hull, renderer->pass.gl, program, &renderer->grid.shown,
                                             &d->frame, scene->width, scene->height, err);
}

static bool render(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_image *image,
                   ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    decision d;
    if (!decide(renderer, scene, options, &d, err)) return false;
    bool bounds = uses(&d, ANG_PART_HULL), skips = uses(&d, ANG_PART_SKIPPING);
    bool whole = uses(&d, ANG_PART_SLABS);
    if (!ang_ray_pass_hold(&renderer->pass, whole ? NULL : d.first, d.end, &d.upload_ms, err)) return false;
    if (bounds && !draw_range(renderer, scene, &d, err)) return false;
    const ang_block_grid *grid = &renderer->grid.shown;
    const ang_decision *gradients = &d.plan.part[ANG_PART_GRADIENT_TEXTURE];
    bool refused = options->gradients == ANG_GRADIENTS_TEXTURE && gradients->why;
    if (refused)
        snprintf(renderer->note, sizeof renderer->note, "--gradients texture: gradients are looked up, since %s",
                 gradients->why);
    if (stats)
        *stats = (ang_frame_stats){.counts = stats->counts,
                                   .bricks_drawn = skips || bounds ? grid->visible_blocks : 1,
                                   .bricks_total = skips || bounds ? grid->blocks : 1,
                                   .polygons = bounds ? renderer->hull.faces : 0,
                                   .passes = bounds ? 2 : 1,
                                   .octree_ms = grid->build_ms,
                                   .upload_ms = d.upload_ms + renderer->gradients.build_ms,
                                   .note = refused ? renderer->note : NULL};
    const ang_ray_limits limits = {add_parts, set_uniforms, &d, uses(&d, ANG_PART_GRADIENT_TEXTURE), &d.plan};
    return ang_ray_pass_draw(&renderer->pass, scene, options, &d.frame, &limits, image, stats, progress, err);
}

static void explain_blocks(const ang_renderer *renderer, const decision *d, ang_plan *plan) {
    const ang_block_grid *grid = &renderer->grid.shown;
    bool skips = uses(d, ANG_PART_SKIPPING), bounds = uses(d, ANG_PART_HULL);
    if (skips)
        ang_plan_use(plan,
                     "skipping by the distance to the next visible block: %zu of %zu blocks of %d cells a side "
                     "show",
                     grid->visible_blocks, grid->blocks, ANG_SKIP_BLOCK);
    if (skips && d->facts.software)
        ang_plan_leave_out(plan, "ranges of blocks by compute shader", "without a GPU the processor is faster");
    else if (skips)
        ang_plan_use(plan, "ranges of blocks by compute shader");
    if (skips && grid->visible_blocks < grid->blocks)
        ang_plan_leave_out(plan, "parts of the volume", "%zu of %zu blocks: %s", grid->blocks - grid->visible_blocks,
                           grid->blocks, ang_visibility_reason(d->visibility.mode));
    int side = ANG_SKIP_BLOCK * renderer->hull.cells.side;
    if (bounds)
        ang_plan_use(plan, "envelope of what shows: %zu faces of cells of %dx%dx%d", renderer->hull.faces, side, side,
                     side);
    else if (is_boxed(d))
        ang_plan_use(plan, "the box of what shows bounds the rays");
    if (uses(d, ANG_PART_GRADIENT_TEXTURE))
        ang_plan_use(plan, "texture of gradients: %zu blocks filled, %.1f MB", renderer->gradients.blocks_filled,
                     (double)renderer->gradients.bytes / 1e6);
}

static bool explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_plan *plan,
                    ang_error *err) {
    decision d;
    if (!decide(renderer, scene, options, &d, err)) return false;
    explain_blocks(renderer, &d, plan);
    if (uses(&d, ANG_PART_HULL)) {
        ang_shader_source vertex, fragment;
        compose_range(&d, &vertex, &fragment);
        ang_shader_explain(plan, "range of each ray in the envelope", &vertex, &fragment, 0);
    }
    const ang_ray_limits limits = {add_parts, set_uniforms, &d, uses(&d, ANG_PART_GRADIENT_TEXTURE), &d.plan};
    ang_ray_pass_explain(&renderer->pass, scene, options, &limits, plan);
    return true;
}

const ang_method ang_method_envelope = {
    .name = "envelope",
    .title = "rays between the faces of an envelope of what shows, skipping inside it",
    .source = "Haferburg, Object order empty space skipping in OpenGL 4",
    .needs_gl = true,
    .takes = ANG_TAKES_COUNT_SHOWN | ANG_TAKES_TERMINATION | ANG_TAKES_MANUAL_FILTER | ANG_TAKES_NO_SKIP |
             ANG_TAKES_GRADIENTS | ANG_TAKES_ENVELOPE | ANG_TAKES_GPU_MEMORY | ANG_TAKES_CLASSIFICATION,
    .create = create,
    .render = render,
    .explain = explain,
    .destroy = destroy,
};
