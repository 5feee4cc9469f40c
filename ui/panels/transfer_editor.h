/* The transfer function over the histogram: what the hands do with points and ranges, and the numbers below. */
#ifndef ANG_UI_TRANSFER_EDITOR_H
#define ANG_UI_TRANSFER_EDITOR_H

typedef struct ang_viewer ang_viewer;

void ang_transfer_editor(ang_viewer *viewer);
/* For another volume. */
void ang_transfer_editor_start(ang_viewer *viewer);
/* Keys are no longer the editor's once the pointer has come to a pane. After the panes of each frame. */
void ang_transfer_editor_leave(ang_viewer *viewer);
/* The range of HU: nearly all values of the volume; all values and points; narrower (factor < 1) or wider. */
void ang_transfer_editor_show_data(ang_viewer *viewer);
void ang_transfer_editor_show_all(ang_viewer *viewer);
void ang_transfer_editor_zoom(ang_viewer *viewer, double about, double factor);
/* This point alone; -1: none. */
void ang_transfer_editor_choose(ang_viewer *viewer, int index);

#endif
