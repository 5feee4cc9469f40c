#include "core/error/estimate.h"

#include "core/base/clock.h"
#include "core/scene/objects.h"

#include <math.h>

enum { GRID = 64 }; /* pixels that a square picture is looked at in along each side, about */

/* With the step, its half and its quarter; of every fourth of these pixels, with the texture unit's filtering and the
 * shader's, which takes many times longer; and the first with rays that do not end early, as the finer ones then are,
 * where objects hide how opaque pixels have become. */
enum { WHOLE, HALF, QUARTER, HARDWARE, MANUAL, ENDLESS, PICTURES };

/* What a halved step leaves of an error, at least and at most, and what is added to be on the safe side. */
static const double least_left = 0.25, most_left = 0.75, safety = 1.2;
static const double arithmetic_levels = 0.01;

ang_scene ang_error_grid(const ang_scene *scene, int stride, int first_x, int first_y) {
    if (first_x >= scene->width) first_x = scene->width / 2;
    if (first_y >= scene->height) first_y = scene->height / 2;
    return ang_scene_subset(scene, stride, first_x, first_y);
}

ang_scene ang_error_subset(const ang_scene *scene) {
    int stride = (int)lround(sqrt((double)scene->width * scene->height) / GRID);
    if (stride < 1) stride = 1;
    /* Off the middle and off the diagonals, on which symmetric things lie. */
    return ang_error_grid(scene, stride, (int)(0.37 * stride), (int)(0.71 * stride));
}

double ang_error_capped(double levels) { return isnan(levels) ? levels : fmin(levels, 255); }

void ang_error_estimate_add(ang_error_estimate *estimate, const ang_metrics *more) {
    estimate->levels = ang_error_capped(estimate->levels + more->max);
    estimate->rms = ang_error_capped(estimate->rms + more->rms);
    estimate->p999 = ang_error_capped(estimate->p999 + more->p999);
    estimate->flipped = fmin(estimate->flipped + more->flipped, 1);
}

double ang_error_termination_bound(const ang_method *method, const ang_scene *scene, double termination) {
    if (method == &ang_method_reference || scene->mode != ANG_MODE_DVR) return 0;
    double brightest = scene->shading == ANG_SHADING_PHONG
                           ? fmax(1, scene->phong.ambient + scene->phong.diffuse + scene->phong.specular)
                           : 1;
    return 255 * brightest * (1 - termination);
}

typedef struct pictures {
    const ang_method *method;
    ang_renderer *renderer;
    const ang_render_options *options;
    const ang_progress *progress;
    ang_classify classification; /* that of the picture itself, with finer steps too */
    bool hidden;                 /* by objects, which make pixels opaque: how opaque rays have become before them */
    int drawn;
    ang_image image[PICTURES];
    double step_mm[PICTURES];
} pictures;

/* Progress over all pictures from that within one. */
static bool update(void *context, const char *what, double fraction) {
    (void)what;
    const pictures *p = context;
    return ang_progress_update(p->progress, "estimating the error",
                               (p->drawn + fraction) / (p->hidden ? PICTURES : ENDLESS));
}

static bool draw(pictures *p, const ang_scene *scene, double finer, ang_error *err) {
    ang_image *image = &p->image[p->drawn];
    ang_render_options options = *p->options;
    if (p->method->coarsest_step > 0) options.step_voxels = fmin(options.step_voxels, p->method->coarsest_step);
    options.step_voxels /= finer;
    options.classification = p->classification;
    options.manual_filter = options.manual_filter || p->drawn == MANUAL;
    if (p->hidden && (p->drawn == HALF || p->drawn == QUARTER || p->drawn == ENDLESS)) options.termination = 1;
    options.show_bricks = false;
    ang_frame_stats stats = {0};
    const ang_progress progress = {update, p};
    bool done = ang_image_create(image, scene->width, scene->height, err) &&
                p->method->render(p->renderer, scene, &options, image, &stats, &progress, err);
    if (p->classification == ANG_CLASSIFY_AUTO) p->classification = stats.classification;
    p->step_mm[p->drawn++] = stats.step_mm;
    return done;
}

static bool draw_all(pictures *p, const ang_scene *subset, ang_error *err) {
    ang_scene few = ang_scene_subset(subset, 2, 0, 0);
    return draw(p, subset, 1, err) && draw(p, subset, 2, err) && draw(p, subset, 4, err) && draw(p, &few, 1, err) &&
           draw(p, &few, 1, err) && (!p->hidden || draw(p, subset, 1, err));
}

/* What rays that have ended leave unseen, at most and as an RMS over all pixels, in levels of which `scale` are what is
 * wholly unseen: an opacity of A lets at most 1 - A of anything behind through. */
static double unseen(const ang_image *image, double termination, double scale, double *rms) {
    double most = 0, squares = 0, pixels = (double)image->width * image->height;
    for (size_t i = 0; i < (size_t)pixels; i++) {
        double opacity = (double)image->rgba[4 * i + 3];
        if (opacity < termination) continue;
        most = fmax(most, 1 - opacity);
        squares += (1 - opacity) * (1 - opacity);
    }
    *rms = scale * sqrt(squares / pixels);
    return scale * most;
}

/* Error of the step h from the greatest differences of pictures with h, h/2 and h/4. Where halving leaves the share r
 * of an error, they are (1 - r), r (1 - r) and, between the outer two, 1 - r^2 of h's. */
static double extrapolate(double coarse, double fine, double outer) {
    double left = coarse > 0 ? fine / coarse : most_left;
    left = fmin(fmax(left, least_left), most_left);
    return safety * outer / (1 - left * left);
}

static bool gather(const pictures *p, double termination_bound, ang_error_estimate *out, ang_error *err) {
    ang_metrics coarse, fine, outer, filtering, endless = {0};
    const ang_image *first = &p->image[p->hidden ? ENDLESS : WHOLE];
    if (!ang_metrics_compute(first, &p->image[HALF], false, &coarse, err) ||
        !ang_metrics_compute(&p->image[HALF], &p->image[QUARTER], false, &fine, err) ||
        !ang_metrics_compute(first, &p->image[QUARTER], false, &outer, err) ||
        !ang_metrics_compute(&p->image[HARDWARE], &p->image[MANUAL], false, &filtering, err) ||
        (p->hidden && !ang_metrics_compute(&p->image[WHOLE], first, false, &endless, err)))
        return false;
    double termination = p->options->termination, unseen_rms = 0;
    double scale = termination_bound > 0 ? termination_bound / (1 - termination) : 0;
    out->termination = unseen(&p->image[WHOLE], termination, scale, &unseen_rms);
    if (p->hidden) {
        out->termination = endless.max;
        unseen_rms = endless.rms;
    }
    out->step = extrapolate(coarse.max, fine.max, outer.max);
    out->filtering = filtering.max;
    out->arithmetic = arithmetic_levels;
    out->levels = ang_error_capped(out->step + out->termination + out->filtering + out->arithmetic);
    out->rms = extrapolate(coarse.rms, fine.rms, outer.rms) + unseen_rms + filtering.rms + arithmetic_levels;
    out->p999 = extrapolate(coarse.p999, fine.p999, outer.p999) + out->termination + filtering.p999 + arithmetic_levels;
    out->flipped = fmin(outer.flipped + endless.flipped, 1);
    out->order = coarse.max > 0 && fine.max > 0 ? log2(coarse.max / fine.max) : NAN;
    return true;
}

bool ang_error_estimate_make(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                             const ang_render_options *options, ang_error_estimate *out, const ang_progress *progress,
                             ang_error *err) {
    *out = (ang_error_estimate){.order = NAN};
    if (method == &ang_method_reference) {
        out->pixels = scene->width * scene->height;
        return true;
    }
    double start = ang_now_ms();
    ang_scene subset = ang_error_subset(scene);
    double bound = ang_error_termination_bound(method, scene, options->termination);
    pictures p = {.method = method,
                  .renderer = renderer,
                  .options = options,
                  .progress = progress,
                  .classification = options->classification,
                  .hidden = bound > 0 && ang_scene_limits_rays(scene)};
    bool done = draw_all(&p, &subset, err) && gather(&p, bound, out, err);
    for (int i = 0; i < PICTURES; i++) ang_image_clear(&p.image[i]);
    out->pixels = subset.width * subset.height;
    out->ms = ang_now_ms() - start;
    if (scene->mode == ANG_MODE_ISO)
        out->why =
            "an iso-surface jumps at its silhouettes, where one pixel may be off by any number of levels: rms, p999 "
            "and flipped judge it";
    else if (!(p.step_mm[QUARTER] < 0.3 * p.step_mm[WHOLE]))
        out->why = "the step is about the finest that the method goes, so that no finer one tells its error";
    if (out->why) out->levels = out->step = NAN;
    return done;
}
