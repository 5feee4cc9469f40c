/* Presets as small pictures of the volume. */
#ifndef ANG_UI_THUMBNAILS_H
#define ANG_UI_THUMBNAILS_H

#include "core/render/painter.h"
#include "core/transfer/preset.h"

typedef struct ang_viewer ang_viewer;

enum { ANG_THUMBNAILS = 128 }; /* the most presets that are shown */

/* Small pictures of the presets, in the panel's order. */
typedef struct ang_thumbnails {
    ang_paint_texture texture[ANG_THUMBNAILS];
    bool made[ANG_THUMBNAILS]; /* or tried in vain */
    double scroll;             /* of the strip, pixels */
    int first, last;           /* seen in the strip */
    char shown[64];            /* the preset that the strip was last scrolled to */
} ang_thumbnails;

/* The presets that can be chosen, own_preset first; at most ANG_THUMBNAILS. Returns their number. */
int ang_presets(const ang_viewer *viewer, const ang_preset *presets[ANG_THUMBNAILS]);
/* The index of the document's among them; -1: none. */
int ang_preset_chosen(const ang_viewer *viewer, const ang_preset *const *presets, int count);
/* A row of them in the panel, and all of them in a message. */
void ang_thumbnails_strip(ang_viewer *viewer);
void ang_thumbnails_show(ang_viewer *viewer);
/* Whether one that is seen has no picture yet. */
bool ang_thumbnails_wanted(const ang_viewer *viewer);
/* Makes the next one. */
void ang_thumbnails_step(ang_viewer *viewer);
/* The presets are others: all pictures are made again. */
void ang_thumbnails_renew(ang_viewer *viewer);
/* Lets go of the pictures. Not while a frame is drawn. */
void ang_thumbnails_clear(ang_viewer *viewer);

#endif
