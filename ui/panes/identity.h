/* What may identify the patient: on the screen until one key hides it; in pictures of the window only where the host
 * lets it out. */
#ifndef ANG_UI_IDENTITY_H
#define ANG_UI_IDENTITY_H

#include "ui/toolkit/rect.h"

#include <stdbool.h>

typedef struct ang_viewer ang_viewer;

/* Whether names, descriptions and the like may be drawn in this frame. */
bool ang_identity_shown(const ang_viewer *viewer);
/* "CT series 3: head", without its description where that is not shown. */
const char *ang_identity_series(const ang_viewer *viewer, char text[340]);
/* Patient and series in a pane's upper corners. */
void ang_identity_write(ang_viewer *viewer, ang_rect rect);

#endif
