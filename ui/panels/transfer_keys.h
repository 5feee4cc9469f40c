/* The transfer-function editor by keys alone. */
#ifndef ANG_UI_TRANSFER_KEYS_H
#define ANG_UI_TRANSFER_KEYS_H

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

bool ang_transfer_editor_has_keys(const ang_viewer *viewer);
/* Whether the editor has taken an arrow key, or Esc. */
bool ang_transfer_editor_key(ang_viewer *viewer, int key, unsigned modifiers);
bool ang_transfer_editor_escape(ang_viewer *viewer);

/* Actions; `argument` means nothing but where it has another name. */
void ang_curve_edit(ang_viewer *viewer, int argument); /* gives it the keys, or takes them away */
void ang_curve_step(ang_viewer *viewer, int by);       /* to the next point (1), the one before (-1) */
void ang_curve_step_adding(ang_viewer *viewer, int by);
void ang_curve_choose_all(ang_viewer *viewer, int argument);
void ang_curve_insert(ang_viewer *viewer, int argument);
void ang_curve_delete(ang_viewer *viewer, int argument);
void ang_curve_zoom(ang_viewer *viewer, int direction); /* 1: narrower, about the chosen point */
void ang_curve_show_all(ang_viewer *viewer, int argument);
bool ang_curve_can_delete(const ang_viewer *viewer);

#endif
