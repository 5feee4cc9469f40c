/* The presets that can be chosen, and which one is shown. */
#ifndef ANG_UI_PRESETS_H
#define ANG_UI_PRESETS_H

#include "core/transfer/preset.h"
#include "ui/state/document.h"

typedef struct ang_viewer ang_viewer;

enum { ANG_PRESETS = 128 }; /* the most that are shown */

/* The host's, after the one of its making for this study. Returns their number. */
int ang_presets(const ang_viewer *viewer, const ang_preset *presets[ANG_PRESETS]);
/* The index of the document's among them; -1: none. */
int ang_preset_chosen(const ang_viewer *viewer, const ang_preset *const *presets, int count);
const ang_preset *ang_preset_named(const ang_viewer *viewer, const char *name); /* of the host; NULL: there is none */
void ang_viewer_choose_preset(ang_viewer *viewer, const ang_preset *preset);
/* Action: the next preset (1), or the one before (-1). */
void ang_viewer_step_preset(ang_viewer *viewer, int by);
/* What the 3D pane shows: the document, or with the preset as it is saved. Borrowed until the next call. */
const ang_document *ang_viewer_shown_document(ang_viewer *viewer);

#endif
