#include "ui/panes/picture_error.h"

#include "core/base/clock.h"
#include "core/error/estimate.h"
#include "ui/panes/interruption.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>

static const double rest_seconds = 0.3; /* after input that has interrupted it */

double ang_picture_error_in(const ang_viewer *viewer) {
    const ang_volume_picture *volume = &viewer->volume;
    const ang_picture_error *error = &volume->error;
    bool fine = volume->shown && volume->refined && volume->renderer && !volume->failure[0];
    if (!fine || error->version == volume->version) return INFINITY;
    return fmax(error->not_before - ang_now_ms() / 1000, 0);
}

void ang_picture_error_find(ang_viewer *viewer) {
    ang_volume_picture *volume = &viewer->volume;
    ang_render_options options = ang_render_options_default;
    options.threads = viewer->host->threads;
    ang_scene scene =
        ang_volume_scene(viewer, &volume->document, volume->transfer, volume->image.width, volume->image.height);
    ang_interruption input;
    ang_progress progress = ang_interruption_start(&input, viewer->window);
    ang_error_estimate estimate;
    ang_error err = {0};
    bool done = ang_error_estimate_make(volume->method, volume->renderer, &scene, &options, &estimate, &progress, &err);
    if (!done && err.code == ANG_INTERRUPTED) {
        volume->error.not_before = ang_now_ms() / 1000 + rest_seconds;
        return;
    }
    /* What failed is not tried again until the picture changes. */
    volume->error = (ang_picture_error){
        .version = volume->version, .levels = done ? estimate.levels : NAN, .rms = done ? estimate.rms : NAN};
}

void ang_picture_error_text(const ang_viewer *viewer, char *text, size_t size) {
    const ang_volume_picture *volume = &viewer->volume;
    const ang_picture_error *error = &volume->error;
    text[0] = '\0';
    if (!volume->shown || !volume->refined || volume->failure[0]) return;
    if (error->version != volume->version) {
        snprintf(text, size, "estimating error");
        return;
    }
    bool largest = isfinite(error->levels);
    double levels = largest ? error->levels : error->rms;
    if (!isfinite(levels)) return;
    /* Upwards: rather too much than too little. */
    levels = levels < 10 ? ceil(10 * levels) / 10 : ceil(levels);
    snprintf(text, size, "%s \xc2\xb1%.*f levels", largest ? "error about" : "RMS error about", levels < 10, levels);
}
