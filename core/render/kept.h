/* The last picture of a renderer, which who asks for the same again gets without drawing. */
#ifndef ANG_RENDER_KEPT_H
#define ANG_RENDER_KEPT_H

#include "core/render/method.h"

/* Zero-initialise; owns all. For one renderer. */
typedef struct ang_kept {
    bool valid;
    ang_scene scene;
    ang_transfer *transfer; /* a copy; NULL where the scene had none */
    ang_render_options options;
    ang_image image;
    ang_frame_stats stats;        /* its note is not kept */
    bool counted;                 /* stats were asked for */
    bool given;                   /* the last call gave the picture without drawing... */
    ang_plan_decisions decisions; /* ... as ANG_PART_REDRAW of these says */
} ang_kept;

/* As `method`'s render, but where scene and options are what they were in the last call the picture of that is copied,
 * unless options->forced asks for ANG_PART_REDRAW or counts of each pixel are wanted. False as render. */
bool ang_kept_render(ang_kept *kept, const ang_method *method, ang_renderer *renderer, const ang_scene *scene,
                     const ang_render_options *options, ang_image *image, ang_frame_stats *stats,
                     const ang_progress *progress, ang_error *err);
void ang_kept_clear(ang_kept *kept);

#endif
