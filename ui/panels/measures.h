/* The panel's list of measures, and what is done with them by menu or key. */
#ifndef ANG_UI_MEASURES_H
#define ANG_UI_MEASURES_H

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

void ang_measures_list(ang_viewer *viewer);
/* Actions. */
void ang_measuring_next(ang_viewer *viewer, int argument); /* takes the tool; once more: the next kind */
void ang_measures_delete_chosen(ang_viewer *viewer, int argument);
void ang_measures_clear(ang_viewer *viewer, int argument);
void ang_measures_copy(ang_viewer *viewer, int argument); /* to the clipboard */
void ang_measures_toggle(ang_viewer *viewer, int argument);
bool ang_measures_any(const ang_viewer *viewer);
bool ang_measures_chosen(const ang_viewer *viewer);
bool ang_measures_shown(const ang_viewer *viewer, int argument);

#endif
