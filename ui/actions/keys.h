/* Keys that were pressed, to those that they are meant for. */
#ifndef ANG_UI_KEYS_H
#define ANG_UI_KEYS_H

typedef struct ang_viewer ang_viewer;

/* Those of this frame. */
void ang_keys(ang_viewer *viewer);

#endif
