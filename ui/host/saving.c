#include "ui/host/saving.h"

#include "core/base/memory.h"
#include "core/scene/annotation.h"
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
    viewer->shot.wanted |= 1u << pane;
    viewer->shot.frame = viewer->frames;
}

void ang_shot_ask_pane(ang_viewer *viewer, int argument) {
    (void)argument;
    ask(viewer, viewer->focus.pane);
}

void ang_shot_ask_window(ang_viewer *viewer, int argument) {
    (void)argument;
    ask(viewer, ANG_PANES);
}

static bool waits_for_volume(const ang_viewer *viewer, int pane) {
    /* While slices play nothing is refined: the window is then taken as it is. */
    bool seen = viewer->pane[ANG_PANE_VOLUME].width >= 1 && !viewer->cine.running;
    bool shows = pane == ANG_PANE_VOLUME || (pane == ANG_PANES && seen);
    return shows && viewer->ready && !viewer->volume.refined;
}

void ang_shot_pose(ang_viewer *viewer) {
    ang_shot *shot = &viewer->shot;
    shot->posed = false;
    if (viewer->frames <= shot->frame || ang_gui_popup_open(viewer->gui)) return;
    for (int pane = ANG_PANES; pane >= 0; pane--) {
        if (!(shot->wanted >> pane & 1) || waits_for_volume(viewer, pane)) continue;
        shot->posed = true;
        shot->pane = pane;
    }
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
    static const char *const names[] = {"axial-seen", "coronal-seen", "sagittal-seen", "volume-seen", "window"};
    ang_shot *shot = &viewer->shot;
    if (!shot->posed || waits_for_volume(viewer, shot->pane)) return;
    ang_error err = {0};
    ang_image image = {0};
    ang_rect rect = {0, 0, viewer->input.width, viewer->input.height};
    if (shot->pane < ANG_PANES) rect = viewer->pane[shot->pane];
    if (rect.width >= 1 && read_part(viewer, rect, &image, &err))
        save(viewer, names[shot->pane], &image, false, &err);
    else if (rect.width >= 1)
        ang_viewer_say(viewer, true, "%s", err.message);
    ang_image_clear(&image);
    shot->wanted &= ~(1u << shot->pane);
}

static void save_capture(ang_viewer *viewer, ang_pane pane, const ang_image *image) {
    ang_error err = {0};
    const ang_camera *camera = &viewer->volume.scene.camera;
    bool volume = pane == ANG_PANE_VOLUME;
    const ang_reslice_plane *plane = volume ? NULL : &viewer->slice[pane].plane;
    ang_letters right = ang_letters_make(volume ? camera->right : plane->step_x);
    ang_letters down = ang_letters_make(volume ? ang_vec3_scale(camera->up, -1) : plane->step_y);
    const char *what = volume ? "volume" : ang_orientation_name((ang_orientation)pane);
    bool done = viewer->host->save_capture(viewer->host->context, what, image, &viewer->study, right.text, down.text,
                                           viewer->saved, sizeof viewer->saved, &err);
    ang_say_saved(viewer, done, &err);
}

static void save_pane(ang_viewer *viewer, ang_pane pane, bool as_dicom) {
    ang_error err = {0};
    ang_image image = {0};
    bool volume = pane == ANG_PANE_VOLUME;
    const ang_image *shown = volume ? &viewer->volume.image : &image;
    if (volume && viewer->volume.failure[0])
        ang_viewer_say(viewer, true, "%s", viewer->volume.failure);
    else if (!volume && !ang_slice_image(viewer, (ang_orientation)pane, &image, &err))
        ang_viewer_say(viewer, true, "%s", err.message);
    else if (as_dicom)
        save_capture(viewer, pane, shown);
    else
        save(viewer, volume ? "volume" : ang_orientation_name((ang_orientation)pane), shown, volume, &err);
    ang_image_clear(&image);
}

void ang_save_panes(ang_viewer *viewer) {
    for (int bit = 0; bit < 2 * ANG_PANES; bit++) {
        ang_pane pane = (ang_pane)(bit % ANG_PANES);
        if (!(viewer->save_wanted >> bit & 1)) continue;
        if (pane == ANG_PANE_VOLUME && !viewer->volume.refined) continue;
        save_pane(viewer, pane, bit >= ANG_PANES);
        viewer->save_wanted &= ~(1u << bit);
    }
}

void ang_save_pane_ask(ang_viewer *viewer, int as_dicom) {
    viewer->save_wanted |= 1u << (viewer->focus.pane + (as_dicom ? ANG_PANES : 0));
}
