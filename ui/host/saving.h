/* Pictures to files, through the host. */
#ifndef ANG_UI_SAVING_H
#define ANG_UI_SAVING_H

#include "core/base/error.h"

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

/* Pictures of panes and of the window as they are seen, those asked for and the one that is taken. */
typedef struct ang_shot {
    unsigned wanted; /* a bit for each ang_pane, that of ANG_PANES for the window */
    int frame;       /* that was drawn when the last was asked for: the menu may still be in it */
    bool posed;      /* this frame is taken: it names neither folders nor people, shows no handles and is not shown */
    int pane;        /* of which; ANG_PANES: the whole window */
} ang_shot;

/* Says that `saved` has been written, or why not. */
void ang_say_saved(ang_viewer *viewer, bool done, const ang_error *err);

void ang_shot_pose(ang_viewer *viewer); /* before a frame is drawn */
void ang_shot_take(ang_viewer *viewer); /* after it has been painted */
/* What ang_save_pane_ask has asked for; the 3D pane's picture only once it is refined. */
void ang_save_panes(ang_viewer *viewer);

/* Actions, on the pane that keys apply to. */
void ang_save_pane_ask(ang_viewer *viewer, int as_dicom); /* its picture, without writing on it */
/* A picture of the pane or window as it is seen, writing included: of the next frame without a menu, with the volume
 * once it is refined. */
void ang_shot_ask_pane(ang_viewer *viewer, int argument);
void ang_shot_ask_window(ang_viewer *viewer, int argument);

#endif
