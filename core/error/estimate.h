/* How wrong one picture may be, without a reference: from pictures of some of its pixels with finer steps
 * (docs/error.md).
 */
#ifndef ANG_ERROR_ESTIMATE_H
#define ANG_ERROR_ESTIMATE_H

#include "core/error/metrics.h"
#include "core/render/method.h"

/* In levels (DESIGN.md, "Error"): 1/255 of that channel of a pixel which is farthest off. */
typedef struct ang_error_estimate {
    double levels; /* estimate of the largest error of the pixels looked at, the sum of the parts below, at most 255;
                      NAN where there is none */
    /* The parts: */
    double step;        /* samples lie apart: by Richardson from the step's half and quarter; NAN where `levels` is */
    double termination; /* rays end early: at most what is left unseen behind the pixels looked at; with opaque objects,
                           which hide that, against rays that do not */
    double filtering;   /* texture units interpolate with few bits: against manual filtering */
    double arithmetic;  /* tables and floats: a constant, as measured */

    /* Of the same pixels, by the same ways: */
    double rms;     /* levels */
    double p999;    /* levels: what at least 99.9 % of the pixels do not exceed */
    double flipped; /* 0..1: share of pixels that differ by more than 16 levels between the step and its quarter */
    double order;   /* of convergence as observed, -log2 of what a halved step leaves of the largest error; NAN: none */

    int pixels;      /* looked at */
    double ms;       /* that the estimate took */
    const char *why; /* why there is no estimate; NULL where there is one */
} ang_error_estimate;

/* Every so many pixels along each axis from the first one; along an axis where that lies beyond the picture, which is
 * then narrower than a few strides, the middle one alone. Never empty. */
ang_scene ang_error_grid(const ang_scene *scene, int stride, int first_x, int first_y);

/* The pixels that are looked at: a grid of about 64 x 64, always the same one, that starts off the picture's corner and
 * off its diagonal. */
ang_scene ang_error_subset(const ang_scene *scene);

/* Levels, at most 255, since no picture can be farther off; NaN, not known, stays. */
double ang_error_capped(double levels);

/* Adds what comes on top of the step's error and the like, such as pixels interpolated between those that are drawn. */
void ang_error_estimate_add(ang_error_estimate *estimate, const ang_metrics *more);

/* numerics.md: what ending rays at the opacity `termination` can change, in levels; shading adds at most its specular
 * part. 0 where no ray ends early. */
double ang_error_termination_bound(const ang_method *method, const ang_scene *scene, double termination);

/* Estimates the error of the scene's picture as `method` draws it with `options`, by drawing pictures of
 * ang_error_subset: with the step, its half and its quarter, where opaque objects end rays also with rays that do not
 * end early, and of every fourth of its pixels with manual filtering. The reference's own is 0. There is none for
 * iso-surfaces, whose pictures jump, and where the method cannot go finer. False as method->render. */
bool ang_error_estimate_make(const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                             const ang_render_options *options, ang_error_estimate *out, const ang_progress *progress,
                             ang_error *err);

#endif
