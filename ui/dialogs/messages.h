/* What stands in the middle of the window: loading, a failure, what to open, what loading found. */
#ifndef ANG_UI_MESSAGES_H
#define ANG_UI_MESSAGES_H

typedef struct ang_viewer ang_viewer;

/* The one that is open, if any; and the help. */
void ang_messages(ang_viewer *viewer);

#endif
