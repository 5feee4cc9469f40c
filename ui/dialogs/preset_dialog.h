/* Saving what is shown as a preset, with a name, and deleting one. */
#ifndef ANG_UI_PRESET_DIALOG_H
#define ANG_UI_PRESET_DIALOG_H

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

typedef struct ang_preset_dialog {
    bool open, deletes;
    bool asked; /* whether what has this name may be replaced */
    char name[64], description[240];
    char problem[1024]; /* why it could not be done; empty: nothing */
} ang_preset_dialog;

void ang_preset_dialog_open(ang_viewer *viewer, bool deletes);
void ang_preset_dialog_show(ang_viewer *viewer);

#endif
