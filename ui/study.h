/* The study that is shown, and what is asked of it. */
#ifndef ANG_UI_STUDY_H
#define ANG_UI_STUDY_H

#include "ui/viewer.h"

typedef struct ang_viewer ang_viewer;

extern const ang_view ang_viewer_first_view;
/* Shows a study, which is taken, instead of the one before. */
void ang_study_show(ang_viewer *viewer, const ang_study *study, const char *wanted_preset);
void ang_study_close(ang_viewer *viewer);
/* The crosshair to a place, kept within the volume and on slices. */
void ang_viewer_point_at(ang_viewer *viewer, ang_vec3 mm);
/* The window that the file asks for, else one that suits. */
void ang_viewer_file_window(const ang_viewer *viewer, double *centre, double *width);
double ang_viewer_hu_at(const ang_viewer *viewer, ang_vec3 mm); /* NaN outside */

#endif
