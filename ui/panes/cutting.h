/* What cuts the 3D picture, in the panes: the crop box with its handles and the clip plane with its arrow. */
#ifndef ANG_UI_CUTTING_H
#define ANG_UI_CUTTING_H

#include "ui/state/clip_geometry.h"
#include "ui/state/crop_geometry.h"

typedef struct ang_viewer ang_viewer;
#include "ui/gui.h"

/* What of it a hand can take hold of. */
typedef enum ang_grip_kind { ANG_CUTTING_NONE, ANG_CUTTING_FACES, ANG_CUTTING_PLANE, ANG_CUTTING_TIP } ang_grip_kind;
typedef struct ang_cutting_grip {
    ang_grip_kind kind;
    unsigned faces; /* of the crop box, 1 << face */
} ang_cutting_grip;

typedef struct ang_cutting {
    ang_vec3 pivot;        /* LPS mm: the clip plane's handles stand at its foot on the plane, which turns about it */
    ang_cutting_grip grip; /* what the drag under way has taken */
    double dx, dy;         /* pixels that the hand has gone since; with Shift a tenth of them counts */
} ang_cutting;

/* A pane that shows it. */
typedef struct ang_cutting_pane {
    ang_rect rect;
    ang_pane_map map;
    const ang_slice_frame *frame; /* NULL: the 3D pane */
} ang_cutting_pane;

/* Takes hold of a handle where the tool is "crop", and drags it. True while it has one: the drag and the click are its
 * own. For the pane of the gesture, after that has been noted. */
bool ang_cutting_hands(ang_viewer *viewer, const ang_cutting_pane *pane, const ang_canvas *canvas);
void ang_cutting_draw(ang_viewer *viewer, const ang_cutting_pane *pane, const ang_canvas *canvas);

/* Where the clip plane's handles are: the foot, and the arrow's tip. */
ang_vec3 ang_cutting_foot(const ang_viewer *viewer);
ang_vec3 ang_cutting_tip(const ang_viewer *viewer, const ang_pane_map *map);
/* Radius in mm of the ring around the foot. */
double ang_cutting_ring(const ang_viewer *viewer, const ang_pane_map *map);
/* What is under (x, y) of the pane. */
ang_cutting_grip ang_cutting_grip_at(const ang_viewer *viewer, const ang_cutting_pane *pane, double x, double y);

/* Actions and what the menu says of them; `argument` means nothing. */
void ang_crop_reset(ang_viewer *viewer, int argument);
/* A clip plane through the crosshair that cuts away what is before it. */
void ang_clip_face_viewer(ang_viewer *viewer, int argument);
void ang_clip_toggle(ang_viewer *viewer, int argument);
void ang_clip_flip(ang_viewer *viewer, int argument);
bool ang_clip_is_on(const ang_viewer *viewer, int argument);
bool ang_clip_can_flip(const ang_viewer *viewer);

#endif
