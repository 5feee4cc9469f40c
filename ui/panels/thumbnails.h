/* Presets as small pictures of this volume, made one by one while the hands rest and kept as long as the volume. */
#ifndef ANG_UI_THUMBNAILS_H
#define ANG_UI_THUMBNAILS_H

#include "core/render/painter.h"
#include "ui/presets.h"

typedef struct ang_viewer ang_viewer;

/* Small pictures of the presets, in the panel's order. */
typedef struct ang_thumbnails {
    ang_paint_texture texture[ANG_PRESETS];
    bool made[ANG_PRESETS]; /* or tried in vain */
    double scroll;          /* of the strip, pixels */
    int first, last;        /* seen in the strip */
    bool by_keys;           /* the strip has the keyboard: */
    int cursor;             /* the one that Enter takes */
    char shown[64];         /* the preset that the strip was last scrolled to */
} ang_thumbnails;

/* A row of them in the panel, and all of them in a message. */
void ang_thumbnails_strip(ang_viewer *viewer);
void ang_thumbnails_show(ang_viewer *viewer);
/* Whether one that is seen has no picture yet. */
bool ang_thumbnails_wanted(const ang_viewer *viewer);
/* How many there are. */
int ang_thumbnails_made(const ang_viewer *viewer);
/* Makes the next one. */
void ang_thumbnails_step(ang_viewer *viewer);
/* The presets are others: all pictures are made again. */
void ang_thumbnails_renew(ang_viewer *viewer);
/* Lets go of the pictures. Not while a frame is drawn. */
void ang_thumbnails_clear(ang_viewer *viewer);

#endif
