/* The panel's part on what cuts the 3D picture, in numbers. */
#ifndef ANG_UI_CUTTING_PANEL_H
#define ANG_UI_CUTTING_PANEL_H

typedef struct ang_viewer ang_viewer;

void ang_cutting_panel(ang_viewer *viewer);

#endif
