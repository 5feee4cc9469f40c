/* What keys and mouse do, over everything. */
#ifndef ANG_UI_HELP_H
#define ANG_UI_HELP_H

typedef struct ang_viewer ang_viewer;

void ang_help(ang_viewer *viewer);

#endif
