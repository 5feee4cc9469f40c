/* The panel's part with the presets, and going from one to another. */
#ifndef ANG_UI_PRESETS_H
#define ANG_UI_PRESETS_H

#include "ui/state/document.h"

typedef struct ang_viewer ang_viewer;

void ang_presets_panel(ang_viewer *viewer);
/* The next preset of the list, or the one before. */
void ang_viewer_step_preset(ang_viewer *viewer, int by);
/* What the 3D pane shows: the document, or with the preset as it is saved. Borrowed until the next call. */
const ang_document *ang_viewer_shown_document(ang_viewer *viewer);

#endif
