/* What loading found: facts, warnings, files left out, assumptions. */
#ifndef ANG_UI_LOAD_REPORT_H
#define ANG_UI_LOAD_REPORT_H

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

void ang_load_report_window(ang_viewer *viewer);
/* Whether the key was for it. */
bool ang_load_report_key(ang_viewer *viewer, int key, unsigned modifiers);

#endif
