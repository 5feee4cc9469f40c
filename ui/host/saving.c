#include "ui/host/saving.h"

#include "core/base/memory.h"
#include "ui/viewer_private.h"

#include <stdlib.h>

void ang_say_saved(ang_viewer *viewer, bool done, const ang_error *err) {
    if (!done) viewer->saved[0] = '\0';
    if (done)
        ang_viewer_say(viewer, false, "Saved %s", viewer->saved);
    else
        ang_viewer_say(viewer, true, "%s", err->message);
}

/* With the state of the 3D pane's picture in it, where it is that. */
static void save(ang_viewer *viewer, const char *what, const ang_image *image, bool with_state, ang_error *err) {
    ang_viewer_state state;
    if (with_state) ang_viewer_describe(viewer, &state);
    bool done = viewer->host->save_picture(viewer->host->context, what, image, with_state ? &state : NULL,
                                           viewer->saved, sizeof viewer->saved, err);
    ang_say_saved(viewer, done, err);
}

static void ask(ang_viewer *viewer, int pane) {
    viewer->shot = (ang_shot){.wanted = true, .pane = pane, .frame = viewer->frames};
}

void ang_shot_ask_pane(ang_viewer *viewer, int argument) {
    (void)argument;
    ask(viewer, viewer->focus.pane);
}

void ang_shot_ask_window(ang_viewer *viewer, int argument) {
    (void)argument;
    ask(viewer, -1);
}

static bool waits_for_volume(const ang_viewer *viewer) {
    return viewer->shot.pane == ANG_PANE_VOLUME && viewer->ready && !viewer->volume.refined;
}

void ang_shot_pose(ang_viewer *viewer) {
    ang_shot *shot = &viewer->shot;
    shot->posed =
        shot->wanted && viewer->frames > shot->frame && !ang_gui_popup_open(viewer->gui) && !waits_for_volume(viewer);
}

/* A part of what has been painted. */
static bool read_part(ang_viewer *viewer, ang_rect rect, ang_image *image, ang_error *err) {
    size_t width = (size_t)viewer->input.width, height = (size_t)viewer->input.height;
    uint8_t *rgb = ang_alloc(width * height, 3, "the window's picture", err);
    bool done = rgb && ang_image_create(image, (int)rect.width, (int)rect.height, err);
    if (done) ang_painter_read(viewer->painter, rgb);
    for (int y = 0; y < image->height && done; y++)
        for (int x = 0; x < image->width; x++) {
            const uint8_t *from = rgb + 3 * (((size_t)rect.y + (size_t)y) * width + (size_t)rect.x + (size_t)x);
            float *to = image->rgba + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
            for (int c = 0; c < 3; c++) to[c] = (float)from[c] / 255;
            to[3] = 1;
        }
    free(rgb);
    return done;
}

void ang_shot_take(ang_viewer *viewer) {
    static const char *const names[ANG_PANES] = {"axial-seen", "coronal-seen", "sagittal-seen", "volume-seen"};
    ang_shot *shot = &viewer->shot;
    if (!shot->posed || waits_for_volume(viewer)) return;
    ang_error err = {0};
    ang_image image = {0};
    ang_rect rect = {0, 0, viewer->input.width, viewer->input.height};
    if (shot->pane >= 0) rect = viewer->pane[shot->pane];
    if (rect.width >= 1 && read_part(viewer, rect, &image, &err))
        save(viewer, shot->pane < 0 ? "window" : names[shot->pane], &image, false, &err);
    else if (rect.width >= 1)
        ang_viewer_say(viewer, true, "%s", err.message);
    ang_image_clear(&image);
    *shot = (ang_shot){0};
    viewer->redraws = 2; /* with all that was left out */
}

void ang_save_pane(ang_viewer *viewer) {
    ang_error err = {0};
    if (viewer->save_pane == ANG_PANE_VOLUME) {
        if (!viewer->volume.refined) return;
        if (viewer->volume.failure[0])
            ang_viewer_say(viewer, true, "%s", viewer->volume.failure);
        else
            save(viewer, "volume", &viewer->volume.image, true, &err);
    } else {
        ang_image image = {0};
        if (ang_slice_image(viewer, (ang_orientation)viewer->save_pane, &image, &err))
            save(viewer, ang_orientation_name((ang_orientation)viewer->save_pane), &image, false, &err);
        else
            ang_viewer_say(viewer, true, "%s", err.message);
        ang_image_clear(&image);
    }
    viewer->save_wanted = false;
}

void ang_save_pane_ask(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->save_wanted = true;
    viewer->save_pane = (ang_pane)viewer->focus.pane;
}
