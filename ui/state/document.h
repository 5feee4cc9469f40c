/* What undo takes back: how the volume is shown. A plain value. */
#ifndef ANG_UI_DOCUMENT_H
#define ANG_UI_DOCUMENT_H

#include "core/scene/scene.h"
#include "core/transfer/preset.h"
#include "core/volume/measures.h"
#include "core/volume/reslice.h"
#include "ui/state/slice_geometry.h"

enum { ANG_DOCUMENT_POINTS = 128 };

typedef struct ang_document {
    char preset[64];                                /* the name of the one it began from */
    bool edited;                                    /* its transfer function is no longer that preset's */
    ang_transfer_point points[ANG_DOCUMENT_POINTS]; /* rising in HU */
    int count;                                      /* >= 1 */
    double unit_distance;                           /* mm */
    bool by_extinction;                             /* as in ang_transfer */
    double shift_hu, stretch; /* by how much drags have moved and widened it since the preset; 0, 1 */
    ang_mode mode;
    ang_shading shading;
    ang_phong phong;
    double iso_hu;                      /* finite */
    ang_view view;                      /* the 3D camera */
    double window_centre, window_width; /* HU, width > 0: slices, and 3D in modes of values */
    ang_slab slab;
    double slab_mm;                  /* 0: none */
    bool crop;                       /* the 3D picture shows the crop box alone */
    ang_vec3 crop_lower, crop_upper; /* the crop box, kept while it is off: voxel index, within ang_volume_box */
    ang_clip_plane clip;             /* of the 3D picture; a zero normal: none */
    ang_turn turn;                   /* of the slice planes */
    ang_vec3 crosshair;              /* LPS mm */
    ang_slice_view slice_view[ANG_ORIENTATIONS];
    int method; /* that draws the volume: 0: auto, else 1 + index into ang_methods */
    ang_measures measures;
} ang_document;

/* Takes over everything of a preset but the window, which it takes where the preset shows values (mip, minip, mean).
 * Points beyond ANG_DOCUMENT_POINTS are left out evenly. */
void ang_document_take_preset(ang_document *document, const ang_preset *preset);
/* Takes over from another document all that a preset says, and leaves camera, windows and slices as they are. */
void ang_document_take_look(ang_document *document, const ang_document *from);
/* The transfer function. NULL with ANG_LIMIT. */
ang_transfer *ang_document_transfer(const ang_document *document, ang_error *err);
/* Moves the points of `from` by `shift` HU after spreading them by `stretch` (> 0) about the middle between the first
 * and the last that shows anything, and the iso value along. */
void ang_document_bend(ang_document *document, const ang_document *from, double shift, double stretch);
/* The points of `from` with the extinction of all multiplied by `factor` (>= 0): opacity 1 stays 1. */
void ang_document_strengthen(ang_document *document, const ang_document *from, double factor);

/* Whether two documents give the same volume rendering. */
bool ang_document_same_rendering(const ang_document *a, const ang_document *b);

/* Editing points. Moves keep the order: a point stops at its neighbours. */
/* Inserts a point on the function at `hu`; its index, or -1 where there is no room. */
int ang_document_add_point(ang_document *document, double hu);
/* Never the last one. */
void ang_document_delete_point(ang_document *document, int index);
void ang_document_move_point(ang_document *document, int index, double hu, double opacity);
/* What a point shows as opacity per unit distance (0..1), and how to set it, also where points give extinction. */
double ang_document_opacity(const ang_document *document, int index);

/* What leads from a state to the next. */
typedef enum ang_history_step { ANG_STEP_NONE, ANG_STEP_CROSSHAIR, ANG_STEP_ZOOM, ANG_STEP_CHANGE } ang_history_step;

/* Past and future states. Zero-initialise; free with ang_history_clear. */
typedef struct ang_history {
    ang_document *states;
    int count, capacity, now; /* states[now] is what is shown when nothing is pending */
    double seconds;           /* when states[now] was noted */
    ang_history_step last;    /* led to it; NONE: undo or redo did */
} ang_history;

/* Notes a state that is to be kept; to be called when no drag is under way. Turns of the wheel come one by one: a state
 * that differs from the last in zoom and pan (and the crosshair) alone, as that did from the one before, takes its
 * place where it comes within a second. However long the crosshair alone moves it is one step; and none where it moves
 * after an undo, so that a look around leaves what can be redone. */
void ang_history_note(ang_history *history, const ang_document *document, double seconds);
/* Steps back or forth; false where there is nothing. */
bool ang_history_undo(ang_history *history, ang_document *document);
bool ang_history_redo(ang_history *history, ang_document *document);
bool ang_history_can_undo(const ang_history *history);
bool ang_history_can_redo(const ang_history *history);
void ang_history_clear(ang_history *history);

#endif
