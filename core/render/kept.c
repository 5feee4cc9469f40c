#include "core/render/kept.h"

#include <string.h>

/* None of these fields holds padding, whose bytes nobody sets. */
#define SAME(field) (memcmp(&a->field, &b->field, sizeof a->field) == 0)

static bool same_camera(const ang_camera *a, const ang_camera *b) {
    return SAME(eye) && SAME(forward) && SAME(right) && SAME(up) && SAME(projection) && SAME(fov_deg) &&
           SAME(half_height) && SAME(near_mm) && SAME(focus_mm);
}

/* But for what the scenes borrow. */
static bool same_scene(const ang_scene *a, const ang_scene *b) {
    return SAME(width) && SAME(height) && SAME(sampling) && same_camera(&a->camera, &b->camera) && SAME(clip_lower) &&
           SAME(clip_upper) && SAME(clip_plane) && SAME(mode) && SAME(shading) && SAME(phong) && SAME(iso_hu) &&
           SAME(window_centre) && SAME(window_width) && SAME(background);
}

static bool same_options(const ang_render_options *a, const ang_render_options *b) {
    return SAME(step_voxels) && SAME(termination) && SAME(manual_filter) && SAME(no_skip) && SAME(proxy) &&
           SAME(bricks) && SAME(pass_steps) && SAME(separate_passes) && SAME(show_bricks) && SAME(gpu_memory) &&
           SAME(gradients) && SAME(skipping) && SAME(quads) && SAME(count_shown) && SAME(forced) && SAME(threads) &&
           SAME(classification);
}

/* The transfer function is compared by its contents; objects may have moved. */
static bool is_same(const ang_kept *kept, const ang_scene *scene, const ang_render_options *options) {
    if (!kept->valid || scene->objects || !scene->transfer != !kept->transfer) return false;
    return same_scene(scene, &kept->scene) && same_options(options, &kept->options) &&
           (!kept->transfer || ang_transfer_same(scene->transfer, kept->transfer));
}

static size_t image_bytes(const ang_image *image) {
    return 4 * sizeof *image->rgba * (size_t)image->width * (size_t)image->height;
}

/* What cannot be kept for want of memory is drawn again. */
static void keep(ang_kept *kept, const ang_scene *scene, const ang_render_options *options, const ang_image *image,
                 const ang_frame_stats *stats) {
    ang_kept_clear(kept);
    if (!ang_image_create(&kept->image, image->width, image->height, NULL)) return;
    memcpy(kept->image.rgba, image->rgba, image_bytes(image));
    if (scene->transfer) kept->transfer = ang_transfer_shifted(scene->transfer, 0, NULL);
    kept->valid = !scene->transfer || kept->transfer;
    kept->scene = *scene;
    kept->options = *options;
    kept->counted = stats != NULL;
    if (stats) kept->stats = *stats;
    kept->stats.counts = NULL;
    kept->stats.note = NULL;
}

bool ang_kept_render(ang_kept *kept, const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                     const ang_render_options *options, ang_image *image, ang_frame_stats *stats,
                     const ang_progress *progress, ang_error *err) {
    bool counts = stats && stats->counts;
    ang_plan_facts facts = {.same_as_before = is_same(kept, scene, options), .forced = options->forced};
    ang_plan_decisions plan = ang_plan_decide(&facts);
    kept->given = !ang_plan_uses(&plan, ANG_PART_REDRAW) && !counts && (!stats || kept->counted);
    if (kept->given) {
        kept->decisions = plan;
        memcpy(image->rgba, kept->image.rgba, image_bytes(image));
        if (stats) *stats = kept->stats;
        return true;
    }
    if (!method->render(renderer, scene, options, image, stats, progress, err)) return false;
    keep(kept, scene, options, image, stats);
    return true;
}

void ang_kept_clear(ang_kept *kept) {
    ang_transfer_free(kept->transfer);
    ang_image_clear(&kept->image);
    *kept = (ang_kept){0};
}
