#include "ui/panes/kept_picture.h"

#include "ui/viewer_private.h"

#include <stdlib.h>

static void swap(ang_volume_picture *volume) {
    ang_kept_picture *kept = &volume->kept;
    const ang_kept_picture other = *kept;
    *kept = (ang_kept_picture){.filled = volume->shown && volume->refined && !volume->failure[0],
                               .image = volume->image,
                               .scene = volume->scene,
                               .transfer = volume->transfer,
                               .document = volume->document,
                               .size = {volume->size[0], volume->size[1]},
                               .frame_ms = volume->frame_ms,
                               .texture = volume->texture,
                               .judged = volume->error.version == volume->version,
                               .error = volume->error};
    volume->image = other.image;
    volume->scene = other.scene;
    volume->transfer = other.transfer;
    volume->document = other.document;
    volume->size[0] = other.size[0];
    volume->size[1] = other.size[1];
    volume->texture = other.texture;
    volume->shown = volume->refined = other.filled;
    volume->version++;
    volume->error = other.error;
    volume->error.version = other.judged ? volume->version : 0;
    if (!other.filled) return;
    volume->frame_ms = other.frame_ms;
    volume->failure[0] = '\0';
}

void ang_kept_picture_turn(ang_viewer *viewer, const ang_document *wanted, int width, int height) {
    ang_volume_picture *volume = &viewer->volume;
    const ang_kept_picture *kept = &volume->kept;
    if (volume->compared == viewer->comparing) return;
    volume->compared = viewer->comparing;
    bool fits = kept->filled && kept->size[0] == width && kept->size[1] == height &&
                ang_document_same_rendering(&kept->document, wanted);
    /* A coarse one is not worth keeping. */
    if (fits || (volume->shown && volume->refined)) swap(volume);
    if (!fits) volume->shown = false;
}

void ang_kept_picture_clear(ang_viewer *viewer) {
    ang_kept_picture *kept = &viewer->volume.kept;
    ang_image_clear(&kept->image);
    ang_transfer_free(kept->transfer);
    ang_painter_forget(viewer->painter, &kept->texture);
    *kept = (ang_kept_picture){0};
}
