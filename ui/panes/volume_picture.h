/* The volume rendering's picture: coarse within a budget of time while things move, fine when they rest. */
#ifndef ANG_UI_VOLUME_PICTURE_H
#define ANG_UI_VOLUME_PICTURE_H

#include "core/render/method.h"
#include "core/render/progressive.h"
#include "core/scene/objects.h"
#include "ui/panes/kept_picture.h"

typedef struct ang_viewer ang_viewer;

/* The fine picture as far as it is drawn, kept where input interrupts it. */
typedef struct ang_refining {
    bool begun;
    ang_document document; /* that it is of, */
    int size[2];           /* for a pane of this size */
    ang_progressive picture;
    double spent_ms;
    int levels_shown; /* before last ones; of all pictures so far */
} ang_refining;

typedef struct ang_volume_picture {
    const ang_method *method; /* of `renderer` */
    ang_renderer *renderer;
    int choice; /* the document's method that `method` follows */
    ang_image image;
    ang_scene scene;        /* that `image` shows, without what it borrows */
    ang_transfer *transfer; /* of `scene` */
    ang_objects objects;    /* the lengths that `image` shows */
    ang_document document;  /* that `image` shows */
    int size[2];            /* of the pane that `image` was made for */
    bool shown, refined;    /* there is an image; it is as fine as the pane */
    bool awaited;           /* there is none, and the pane is hidden: it comes at rest */
    ang_refining refining;
    unsigned version; /* counts the images */
    ang_picture_error error;
    ang_kept_picture kept;
    bool compared;        /* it shows, or is to show, the preset as it is saved */
    double coarse_pixels; /* as many as the budget of time allows; 0: not known yet */
    bool warm;            /* a picture has been made by `renderer` */
    double frame_ms;      /* of the last picture */
    double asked_seconds; /* when what it shows last changed */
    uint8_t *rgba;
    ang_paint_texture texture;
    char failure[1024]; /* why there is no picture; empty: there is */
    bool software;
} ang_volume_picture;

/* The scene of a document for a picture of this size; borrows `transfer`. */
ang_scene ang_volume_scene(const ang_viewer *viewer, const ang_document *document, const ang_transfer *transfer,
                           int width, int height);
/* Draws a document as a small, coarse picture into `texture`, with the renderer that is there. False where input came
 * or it could not be drawn. */
bool ang_volume_thumbnail(ang_viewer *viewer, const ang_document *document, int width, int height,
                          ang_paint_texture *texture, ang_error *err);
/* Draws a coarse picture where what it should show has changed; or, with `refine`, the next level of the fine one,
 * until input comes. */
void ang_volume_update(ang_viewer *viewer, int width, int height, bool refine);
/* The same for a pane that is hidden, whose size is the one that it has beside the others: nothing is drawn until the
 * hands rest, then the fine picture, of which status line and thumbnails tell. */
void ang_volume_await(ang_viewer *viewer, int width, int height);
/* The levels (core/render/progressive.h) of the fine picture that are shown; 0: a coarse one is. */
int ang_volume_level(const ang_viewer *viewer);
/* Seconds until the fine picture should be begun, or gone on with; infinite where there is nothing to refine. */
double ang_volume_refine_in(const ang_viewer *viewer);
void ang_volume_picture_clear(ang_viewer *viewer);
const char *ang_volume_method_choice(const ang_viewer *viewer); /* "auto" or a name */

#endif
