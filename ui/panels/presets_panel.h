/* The panel's part with the presets: which one, its pictures, compared with what is saved, saved, deleted. */
#ifndef ANG_UI_PRESETS_PANEL_H
#define ANG_UI_PRESETS_PANEL_H

typedef struct ang_viewer ang_viewer;

void ang_presets_panel(ang_viewer *viewer);

#endif
