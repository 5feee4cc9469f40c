/* The other of the two pictures of a comparison, kept so that going from one to the other takes no time. */
#ifndef ANG_UI_KEPT_PICTURE_H
#define ANG_UI_KEPT_PICTURE_H

#include "core/render/painter.h"
#include "core/scene/image.h"
#include "ui/panes/picture_error.h"
#include "ui/state/document.h"

typedef struct ang_viewer ang_viewer;

/* A fine picture that is not shown now. */
typedef struct ang_kept_picture {
    bool filled;
    ang_image image;
    ang_scene scene;
    ang_transfer *transfer;
    ang_document document;
    int size[2];
    double frame_ms;
    ang_paint_texture texture;
    bool judged;
    ang_picture_error error; /* where judged */
} ang_kept_picture;

/* Where a comparison has begun or ended: the picture of the other side, if it still is `wanted`'s of this size, else
 * none; the one that was shown is kept. */
void ang_kept_picture_turn(ang_viewer *viewer, const ang_document *wanted, int width, int height);
void ang_kept_picture_clear(ang_viewer *viewer);

#endif
