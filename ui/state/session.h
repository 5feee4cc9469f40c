/* What the viewer shows of a study, to be saved and shown again. A plain value. */
#ifndef ANG_UI_SESSION_H
#define ANG_UI_SESSION_H

#include "ui/state/document.h"

typedef struct ang_session {
    ang_document document;             /* crosshair of three NaN: the middle; method -1: as it is */
    int maximised;                     /* ang_pane; -1: none */
    char tool[16];                     /* "": as it is */
    bool corner_text, crosshair_lines; /* shown on the panes */
    bool voxels_shown;                 /* slices are not interpolated */
    bool turns_about_crosshair;        /* the hand on the 3D picture */
} ang_session;

#endif
