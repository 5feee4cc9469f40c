/* The help, made of the table of actions and of what hands do. */
#ifndef ANG_UI_HELP_H
#define ANG_UI_HELP_H

typedef struct ang_viewer ang_viewer;

void ang_help(ang_viewer *viewer);

#endif
