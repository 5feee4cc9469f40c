/* Rays on the processor: the lattice, tables and skipping of the methods that need OpenGL, in SIMD on all cores. */
#include "core/cpu/method_cpu.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/cpu/classifier.h"
#include "core/cpu/flat_blocks.h"
#include "core/render/facts.h"
#include "core/scene/object_layer.h"
#include "core/scene/objects.h"
#include "core/transfer/means.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Samples of a ray are counted in float. */
static const double most_samples = 4e6;
/* Of rays that go from cell to cell, in steps: the pieces that long cells are cut into, and what is left whole. */
static const double longest_piece = 1, longest_whole = 1.5;

struct ang_renderer {
    const ang_volume *volume;
    ang_cast_width width;
    uint16_t *wide;    /* the values, where the volume's rows are of one voxel */
    uint16_t *weights; /* made when a mean first needs them */
    ang_classifier classifier;
    ang_block_grid grid;
    ang_visibility gridded; /* what the grid was brought up to date for, where grid_current */
    bool grid_current;
    ang_object_layer objects;
    bool adapts;      /* the method is `adaptive` */
    ang_means *means; /* of the tables, where it is */
    ang_flat_blocks flat;
    bool flat_current;
};

/* What is decided about one picture. */
typedef struct decision {
    ang_ray_frame frame;
    ang_visibility visibility;
    ang_plan_facts facts;
    ang_plan_decisions plan;
    double step;  /* mm */
    bool whole;   /* steps are classified by all values between their ends */
    bool by_cell; /* rays go from cell to cell */
    bool flat;    /* through blocks where colour and extinction stay the same in one step */
} decision;

static bool uses(const decision *d, ang_part part) { return ang_plan_uses(&d->plan, part); }

static void destroy(ang_renderer *renderer) {
    if (!renderer) return;
    ang_object_layer_clear(&renderer->objects);
    ang_block_grid_clear(&renderer->grid);
    ang_classifier_clear(&renderer->classifier);
    ang_means_free(renderer->means);
    ang_flat_blocks_clear(&renderer->flat);
    free(renderer->weights);
    free(renderer->wide);
    free(renderer);
}

/* Voxels in a row as the loops read them: at least two. */
static int row_width(const ang_volume *volume) { return volume->dims[0] > 1 ? volume->dims[0] : 2; }

static size_t row_count(const ang_volume *volume) { return (size_t)volume->dims[1] * (size_t)volume->dims[2]; }

static bool widen(ang_renderer *renderer, ang_error *err) {
    const ang_volume *volume = renderer->volume;
    if (volume->dims[0] > 1) return true;
    renderer->wide = ang_alloc(2 * row_count(volume), sizeof *renderer->wide, "rows of the volume", err);
    if (!renderer->wide) return false;
    for (size_t i = 0; i < row_count(volume); i++) renderer->wide[2 * i] = renderer->wide[2 * i + 1] = volume->data[i];
    return true;
}

static ang_renderer *create(ang_gl *gl, const ang_volume *volume, const ang_render_options *options, ang_error *err) {
    (void)gl, (void)options;
    if (ang_volume_count(volume) > INT32_MAX) {
        ang_fail(err, ANG_LIMIT,
                 "volume of %dx%dx%d voxels: --method cpu takes at most 2147483647 of them; choose --method slicing",
                 volume->dims[0], volume->dims[1], volume->dims[2]);
        return NULL;
    }
    ang_renderer *renderer = ang_alloc(1, sizeof *renderer, "the ray caster", err);
    if (!renderer) return NULL;
    renderer->volume = volume;
    ang_cast_width widths[ANG_CAST_WIDTHS];
    ang_cast_widths(widths);
    renderer->width = widths[0];
    if (widen(renderer, err)) return renderer;
    destroy(renderer);
    return NULL;
}

void ang_cpu_set_width(ang_renderer *renderer, const ang_cast_width *width) { renderer->width = *width; }

static void fill_weights(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    const ang_renderer *renderer = context;
    const ang_volume *volume = renderer->volume;
    size_t width = (size_t)row_width(volume), voxels = (size_t)volume->dims[0];
    for (size_t row = begin; row < end; row++)
        for (size_t x = 0; x < width; x++) {
            size_t voxel = row * voxels + (x < voxels ? x : voxels - 1);
            renderer->weights[row * width + x] = ang_volume_is_padding(volume, voxel) ? 0 : UINT16_MAX;
        }
}

static bool prepare_weights(ang_renderer *renderer, const ang_scene *scene, int threads, ang_error *err) {
    const ang_volume *volume = renderer->volume;
    if (!ang_scene_needs_weight(scene, volume) || renderer->weights) return true;
    renderer->weights =
        ang_alloc(row_count(volume) * (size_t)row_width(volume), sizeof *renderer->weights, "weights of voxels", err);
    if (!renderer->weights) return false;
    ang_parallel_for(row_count(volume), 256, threads, fill_weights, renderer);
    return true;
}

static bool start_grid(ang_renderer *renderer, int threads, ang_error *err) {
    ang_block_grid *grid = &renderer->grid;
    if (grid->octree || ang_block_grid_start(grid, renderer->volume, NULL, threads, err)) return true;
    ang_block_grid_clear(grid);
    return false;
}

/* Which blocks show, where rays may skip those that do not. Another camera changes none of them. */
static bool update_grid(ang_renderer *renderer, const ang_render_options *options, decision *d, ang_error *err) {
    ang_block_grid *grid = &renderer->grid;
    const ang_visibility *before = &renderer->gridded, *now = &d->visibility;
    if (!start_grid(renderer, options->threads, err)) return false;
    bool same_threshold = before->threshold <= now->threshold && before->threshold >= now->threshold;
    bool changed, current = renderer->grid_current && before->mode == now->mode && same_threshold;
    if (!current && !ang_block_grid_update(grid, now, true, options->threads, &changed, err)) return false;
    renderer->gridded = *now;
    renderer->grid_current = true;
    d->facts.blocks = grid->blocks;
    d->facts.shown = grid->visible_blocks;
    return true;
}

/* Shading differs from place to place whatever the transfer function does. Rays that skip nothing take these blocks in
 * one step too, so that skipping changes no bit. */
static bool prepare_flat(ang_renderer *renderer, const ang_scene *scene, int threads, decision *d, ang_error *err) {
    if (!d->by_cell || ang_scene_needs_phong(scene)) return true;
    if (!renderer->flat_current) {
        ang_flat_blocks_clear(&renderer->flat);
        if (!start_grid(renderer, threads, err) ||
            !ang_flat_blocks_find(&renderer->flat, renderer->classifier.table.tables, renderer->grid.octree, err))
            return false;
        renderer->flat_current = true;
    }
    d->flat = renderer->flat.flat != NULL;
    return true;
}

/* The tables of the transfer function, and how steps meet it. */
static bool prepare_classifier(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                               bool warn, decision *d, ang_error *err) {
    ang_classifier *classifier = &renderer->classifier;
    bool made = false;
    if (ang_scene_needs_table(scene) &&
        !ang_classifier_update(classifier, scene->transfer, renderer->volume, &made, err))
        return false;
    if (made) {
        renderer->grid_current = false;
        ang_means_free(renderer->means);
        renderer->means = NULL;
        renderer->flat_current = false;
    }
    if (scene->mode != ANG_MODE_DVR) return true;
    if (d->by_cell) {
        if (!renderer->means) renderer->means = ang_means_create(classifier->table.tables, err);
        return renderer->means != NULL;
    }
    if (!ang_classifier_choose(classifier, scene->transfer, renderer->volume, options->classification, d->step, warn,
                               err))
        return false;
    d->whole = classifier->classification.prefix;
    return true;
}

/* mm of a ray that are one step at most. */
static double longest_step(const ang_volume *volume, const decision *d) {
    if (!d->by_cell) return d->step;
    double cell = longest_whole / 2 * d->step, block = 0;
    for (int axis = 0; axis < 3 && d->flat; axis++) block += ANG_SKIP_BLOCK * ang_volume_spacing(volume, axis);
    return fmax(cell, block / 2);
}

/* Decides as far as is known, builds what that takes, and decides again. `warn`: whether mid-points may miss something
 * is of interest. */
static bool decide(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, bool warn,
                   decision *d, ang_error *err) {
    const ang_volume *volume = renderer->volume;
    *d = (decision){.step = 0};
    renderer->grid.build_ms = 0;
    if (!(options->step_voxels > 0))
        return ang_fail(err, ANG_USAGE, "--step %g: give a positive multiple of the smallest spacing",
                        options->step_voxels);
    if (!ang_scene_check(scene, err) || !ang_ray_frame_make(volume, scene, &d->frame, err)) return false;
    d->by_cell = renderer->adapts && scene->mode == ANG_MODE_DVR;
    double voxels = options->step_voxels;
    if (d->by_cell) voxels = fmin(voxels, ang_method_adaptive.coarsest_step);
    d->step = fmax(voxels * ang_volume_smallest_spacing(volume), 2 * ang_volume_half_diagonal(volume) / most_samples);
    if (!prepare_classifier(renderer, scene, options, warn, d, err)) return false;
    if (!prepare_flat(renderer, scene, options->threads, d, err)) return false;
    if (!prepare_weights(renderer, scene, options->threads, err)) return false;
    if (scene->objects && !ang_object_layer_make(&renderer->objects, volume, scene, &d->frame, options->threads, err))
        return false;
    d->visibility = ang_visibility_make(volume, scene, renderer->classifier.table.tables);
    d->facts = ang_facts_make(ANG_DRAW_LANES, NULL, volume, scene, options, &d->frame, &renderer->classifier.table,
                              1.01 * longest_step(volume, d));
    d->facts.whole_steps = d->whole;
    if (d->whole) d->facts.extinction = ang_classifier_greatest(&renderer->classifier);
    d->plan = ang_plan_decide(&d->facts);
    d->frame.cuts = uses(d, ANG_PART_CLIP_PLANE);
    if (uses(d, ANG_PART_SKIPPING) && !update_grid(renderer, options, d, err)) return false;
    d->plan = ang_plan_decide(&d->facts);
    return true;
}

static ang_cast_kind choose_kind(const ang_scene *scene, const ang_volume *volume, const decision *d) {
    switch (scene->mode) {
    case ANG_MODE_MIP:
        return ANG_CAST_HIGHEST;
    case ANG_MODE_MINIP:
        return ANG_CAST_LOWEST;
    case ANG_MODE_MEAN:
        return ang_scene_needs_weight(scene, volume) ? ANG_CAST_MEAN_WEIGHTED : ANG_CAST_MEAN;
    case ANG_MODE_ISO:
        return ANG_CAST_SURFACE;
    case ANG_MODE_DVR:
        break;
    }
    bool shaded = uses(d, ANG_PART_GRADIENTS);
    if (d->whole) return shaded ? ANG_CAST_WHOLE_PHONG : ANG_CAST_WHOLE;
    return shaded ? ANG_CAST_LIGHT_PHONG : ANG_CAST_LIGHT;
}

static void set_volume(ang_cast *cast, const ang_renderer *renderer) {
    const ang_volume *volume = renderer->volume;
    cast->values = renderer->wide ? renderer->wide : volume->data;
    cast->weights = renderer->weights;
    cast->row = volume->dims[1] > 1 ? row_width(volume) : 0;
    cast->slice = volume->dims[2] > 1 ? row_width(volume) * volume->dims[1] : 0;
    int longest = 0;
    for (int axis = 0; axis < 3; axis++) {
        cast->last[axis] = volume->dims[axis] - 1;
        cast->top[axis] = cast->last[axis] > 0 ? nextafterf((float)cast->last[axis], 0) : 0;
        longest = volume->dims[axis] > longest ? volume->dims[axis] : longest;
    }
    /* Places are rounded to half a unit in the last place twice over. */
    cast->room = (float)longest * 0x1p-22f;
}

static void set_grid(ang_cast *cast, const ang_renderer *renderer, const decision *d) {
    const ang_octree *octree = renderer->grid.octree;
    cast->skips = uses(d, ANG_PART_SKIPPING);
    if (d->flat) cast->flat = renderer->flat.flat;
    if (octree) memcpy(cast->blocks, octree->level[0].dims, sizeof cast->blocks);
    if (!cast->skips) return;
    cast->distance = renderer->grid.distance;
    for (int i = 0; i < ANG_CAST_LEVELS; i++) {
        int level = i < octree->levels ? i : octree->levels - 1;
        cast->ranges[i].nodes = octree->level[level].nodes;
        cast->ranges[i].shift = level;
        for (int side = ANG_SKIP_BLOCK; side > 1; side /= 2) cast->ranges[i].shift++;
        memcpy(cast->ranges[i].dims, octree->level[level].dims, sizeof cast->ranges[i].dims);
    }
}

static void set_means(ang_cast *cast, const ang_means *means, const decision *d) {
    cast->means = means->records;
    cast->mean_unit = (float)means->unit;
    cast->plateaus = means->plateaus;
    /* What bends would move across a step of the transfer function tells little of what is there. */
    cast->most_bent = cast->jumps ? 0.5f : 8;
    cast->longest = (float)(longest_piece * d->step);
    cast->longest_whole = (float)(longest_whole * d->step);
}

static void set_table(ang_cast *cast, const ang_renderer *renderer, const decision *d) {
    const ang_table_cache *table = &renderer->classifier.table;
    if (!table->tables) return;
    cast->entries = table->tables->entries;
    cast->extinctions = table->extinctions;
    cast->first = (float)table->tables->first;
    cast->per_value = (float)table->tables->per_value;
    cast->intervals = table->tables->intervals;
    if (d->whole) {
        cast->steps = renderer->classifier.steps;
        cast->integrals = renderer->classifier.prefix->sums;
        cast->plateaus = renderer->classifier.prefix->plateaus;
    }
    cast->jumps = uses(d, ANG_PART_ROUNDING);
    cast->thin = !uses(d, ANG_PART_EXPONENTIAL);
    cast->one_colour = !uses(d, ANG_PART_COLOUR);
    for (int c = 0; c < 3; c++) cast->colour[c] = (float)table->colour[c];
    if (d->by_cell) set_means(cast, renderer->means, d);
}

static void set_phong(ang_cast *cast, const ang_volume *volume, const ang_scene *scene, const decision *d) {
    /* Shading that is forced although there is none must change nothing. */
    bool shades = ang_scene_needs_phong(scene);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            cast->gradient_to_mm[i][k] = (float)(0.5 * volume->slope * d->frame.to_index.m[k][i]);
    cast->half_slope = (float)(0.5 * volume->slope);
    cast->ambient = shades ? (float)scene->phong.ambient : 1;
    cast->diffuse = shades ? (float)scene->phong.diffuse : 0;
    cast->specular = shades ? (float)scene->phong.specular : 0;
    cast->power = (float)scene->phong.power;
    bool whole = scene->phong.power >= 0 && scene->phong.power <= 1024 && fmod(scene->phong.power, 1) == 0;
    cast->whole_power = whole ? (int)scene->phong.power : -1;
    cast->g0 = (float)scene->phong.g0;
}

static void set_values(ang_cast *cast, const ang_volume *volume, const ang_scene *scene) {
    /* A window of no width is a threshold; its scale must stay finite. */
    double width = fmax(scene->window_width, 1e-9);
    cast->window_lower = (float)ang_volume_stored(volume, scene->window_centre - width / 2);
    cast->window_scale = (float)(volume->slope / width);
    cast->enough = cast->window_lower;
    if (scene->mode == ANG_MODE_MIP) cast->enough += 1 / cast->window_scale;
    while (scene->mode == ANG_MODE_MIP && !((cast->enough - cast->window_lower) * cast->window_scale >= 1))
        cast->enough = nextafterf(cast->enough, INFINITY);
    /* Without padding any base will do: one near the values keeps the sums small. */
    double middle = 0.5 * (volume->minimum + volume->maximum);
    cast->mean_base = volume->padding ? ang_volume_padding_value(volume) : (float)middle;
    cast->mean_empty = (float)ang_volume_stored(volume, -1000);
    if (scene->mode != ANG_MODE_ISO) return;
    double colour[3];
    ang_transfer_colour(scene->transfer, scene->iso_hu, colour);
    cast->iso = (float)ang_volume_stored(volume, scene->iso_hu);
    for (int c = 0; c < 3; c++) cast->iso_colour[c] = (float)colour[c];
}

static ang_cast make_cast(const ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                          const decision *d, ang_image *image) {
    ang_cast cast = {.kind = choose_kind(scene, renderer->volume, d),
                     .frame = d->frame,
                     .width = scene->width,
                     .height = scene->height,
                     .step = (float)d->step,
                     .termination = (float)options->termination,
                     .rgba = image->rgba};
    if (scene->objects && ang_scene_limits_rays(scene)) cast.limit_mm = renderer->objects.limit_mm;
    set_volume(&cast, renderer);
    set_grid(&cast, renderer, d);
    set_table(&cast, renderer, d);
    set_phong(&cast, renderer->volume, scene, d);
    set_values(&cast, renderer->volume, scene);
    return cast;
}

typedef struct picture_job {
    const ang_cast *cast;
    ang_cast_tile *tile;
    size_t columns, tiles;
    const ang_progress *progress;
    atomic_size_t done;
    atomic_bool cancelled;
    struct {
        _Alignas(64) ang_cast_took took; /* no two threads write to one line of the cache */
    } worker[ANG_MAX_THREADS];
} picture_job;

static void draw_tiles(void *context, size_t begin, size_t end, int worker) {
    picture_job *job = context;
    ang_cast_took *took = &job->worker[worker].took;
    for (size_t i = begin; i < end; i++) {
        if (atomic_load_explicit(&job->cancelled, memory_order_relaxed)) return;
        job->tile(job->cast, (int)(i % job->columns) * ANG_CAST_TILE, (int)(i / job->columns) * ANG_CAST_TILE, took);
    }
    double done = (double)(atomic_fetch_add(&job->done, end - begin) + end - begin) / (double)job->tiles;
    if (!ang_progress_update(job->progress, "rendering", done)) atomic_store(&job->cancelled, true);
}

static bool render(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_image *image,
                   ang_frame_stats *stats, const ang_progress *progress, ang_error *err) {
    decision d;
    if (!decide(renderer, scene, options, stats != NULL, &d, err)) return false;
    ang_cast cast = make_cast(renderer, scene, options, &d, image);
    cast.counts = stats ? stats->counts : NULL;
    size_t columns = ((size_t)scene->width + ANG_CAST_TILE - 1) / ANG_CAST_TILE;
    size_t rows = ((size_t)scene->height + ANG_CAST_TILE - 1) / ANG_CAST_TILE;
    picture_job job = {.cast = &cast,
                       .tile = d.by_cell ? renderer->width.cells : renderer->width.tile,
                       .columns = columns,
                       .tiles = columns * rows,
                       .progress = progress};
    /* Whoever may interrupt it should not wait for more than a tile of each thread. */
    ang_parallel_for(job.tiles, progress ? 1 : 4, options->threads, draw_tiles, &job);
    if (job.cancelled) return ang_fail(err, ANG_INTERRUPTED, "interrupted while rendering");
    if (scene->objects) ang_object_layer_join(&renderer->objects, scene, image);
    static const ang_classification by_cell = {.prefix = true};
    const ang_classification *how = scene->mode == ANG_MODE_DVR ? &renderer->classifier.classification : NULL;
    if (d.by_cell) how = &by_cell;
    ang_cast_took took = {0};
    for (int i = 0; i < ANG_MAX_THREADS; i++) {
        took.samples += job.worker[i].took.samples;
        took.rays += job.worker[i].took.rays;
    }
    if (stats)
        *stats = (ang_frame_stats){.counts = stats->counts,
                                   .samples = took.samples,
                                   .fragments = took.rays,
                                   .step_mm = d.step,
                                   .bricks_drawn = cast.skips ? renderer->grid.visible_blocks : 1,
                                   .bricks_total = cast.skips ? renderer->grid.blocks : 1,
                                   .passes = 1,
                                   .classification = !how          ? ANG_CLASSIFY_AUTO
                                                     : how->prefix ? ANG_CLASSIFY_PREFIX
                                                                   : ANG_CLASSIFY_MIDPOINT,
                                   .note = how && how->may_miss ? how->warning : NULL,
                                   .octree_ms = renderer->grid.build_ms};
    return true;
}

static bool explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_plan *plan,
                    ang_error *err) {
    decision d;
    if (!decide(renderer, scene, options, true, &d, err)) return false;
    ang_plan_use(plan, "%s, %d threads", renderer->width.name, ang_thread_count(options->threads));
    ang_plan_use(plan, "the volume as it lies in memory");
    const ang_block_grid *grid = &renderer->grid;
    if (uses(&d, ANG_PART_SKIPPING)) {
        ang_plan_use(plan,
                     "skipping by the distance to the next visible block: %zu of %zu blocks of %d cells a side show",
                     grid->visible_blocks, grid->blocks, ANG_SKIP_BLOCK);
        if (grid->visible_blocks < grid->blocks)
            ang_plan_leave_out(plan, "parts of the volume", "%zu of %zu blocks: %s",
                               grid->blocks - grid->visible_blocks, grid->blocks, ang_visibility_reason(scene->mode));
    }
    if (d.by_cell)
        ang_plan_use(plan, "steps from face to face of cells, at most %.3g mm, integrated over the transfer function",
                     longest_whole * d.step);
    if (d.flat)
        ang_plan_use(plan, "one step through each of %zu blocks where colour and extinction stay the same",
                     renderer->flat.count);
    if (scene->mode == ANG_MODE_DVR && !d.by_cell)
        ang_classification_explain(&renderer->classifier.classification,
                                   d.whole && renderer->classifier.prefix->plateaus, plan);
    ang_scene_explain(plan, scene, renderer->volume, &d.plan);
    return true;
}

static ang_renderer *create_adaptive(ang_gl *gl, const ang_volume *volume, const ang_render_options *options,
                                     ang_error *err) {
    ang_renderer *renderer = create(gl, volume, options, err);
    if (renderer) renderer->adapts = true;
    return renderer;
}

const ang_method ang_method_adaptive = {
    .name = "adaptive",
    .title = "cpu with steps from cell to cell, integrated over the transfer function",
    .source = "docs/adaptive.md",
    .takes = ANG_TAKES_TERMINATION | ANG_TAKES_NO_SKIP,
    .coarsest_step = 1, /* rays stop at every face of a cell anyway */
    .splits = true,
    .create = create_adaptive,
    .render = render,
    .explain = explain,
    .destroy = destroy,
};

const ang_method ang_method_cpu = {
    .name = "cpu",
    .title = "rays on the processor, in SIMD on all cores, skipping what shows nothing",
    .source = "DESIGN.md, Rendering methods; numerics.md",
    .takes = ANG_TAKES_TERMINATION | ANG_TAKES_NO_SKIP | ANG_TAKES_CLASSIFICATION,
    .splits = true,
    .create = create,
    .render = render,
    .explain = explain,
    .destroy = destroy,
};
