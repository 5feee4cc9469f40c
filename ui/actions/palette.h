/* Every command by a part of its name: actions, windows of slices, presets. */
#ifndef ANG_UI_PALETTE_H
#define ANG_UI_PALETTE_H

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

typedef struct ang_palette {
    bool open;
    char query[128]; /* UTF-8 */
    int chosen;      /* of those that are listed */
    bool moved;      /* by a key: it is to be brought into view */
} ang_palette;

void ang_palette_open(ang_viewer *viewer);
/* In front of all else, where it is open. */
void ang_palette_show(ang_viewer *viewer);

#endif
