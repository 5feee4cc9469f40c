/* Pictures and presets to files, through the host. */
#include "core/base/memory.h"
#include "ui/viewer_private.h"

#include <stdlib.h>

void ang_viewer_save_preset(ang_viewer *viewer) {
    ang_error err = {0};
    const ang_viewer_host *host = viewer->host;
    if (!host->save_preset(host->context, &viewer->document, viewer->saved, sizeof viewer->saved, &err)) {
        viewer->saved[0] = '\0';
        ang_viewer_say(viewer, true, "%s", err.message);
    } else {
        ang_viewer_say(viewer, false, "Saved %s", viewer->saved);
    }
}

/* With the state of the 3D pane's picture in it, where it is that. */
static void save(ang_viewer *viewer, const char *what, const ang_image *image, bool with_state, ang_error *err) {
    ang_viewer_state state;
    if (with_state) ang_viewer_describe(viewer, &state);
    if (!viewer->host->save_picture(viewer->host->context, what, image, with_state ? &state : NULL, viewer->saved,
                                    sizeof viewer->saved, err)) {
        viewer->saved[0] = '\0';
        ang_viewer_say(viewer, true, "%s", err->message);
    } else {
        ang_viewer_say(viewer, false, "Saved %s", viewer->saved);
    }
}

void ang_save_window(ang_viewer *viewer) {
    ang_error err = {0};
    ang_image image = {0};
    int width = viewer->input.width, height = viewer->input.height;
    size_t pixels = (size_t)width * (size_t)height;
    viewer->save_window = false;
    uint8_t *rgb = ang_alloc(pixels, 3, "the window's picture", &err);
    if (rgb && ang_image_create(&image, width, height, &err)) {
        ang_painter_read(viewer->painter, rgb);
        for (size_t i = 0; i < pixels; i++) {
            for (size_t c = 0; c < 3; c++) image.rgba[4 * i + c] = (float)rgb[3 * i + c] / 255;
            image.rgba[4 * i + 3] = 1;
        }
        save(viewer, "window", &image, false, &err);
        ang_image_clear(&image);
    } else {
        ang_viewer_say(viewer, true, "%s", err.message);
    }
    free(rgb);
}

/* The 3D pane's picture only once it is refined. */
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
