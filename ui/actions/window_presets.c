#include "ui/actions/window_presets.h"

#include "ui/study.h"
#include "ui/viewer_private.h"

#include <math.h>

static const ang_window_preset windows[] = {{"Of the file", NAN, NAN}, {"CTA", 600, 200},    {"Soft tissue", 400, 40},
                                            {"Bone", 2000, 400},       {"Lung", 1500, -600}, {"Brain", 80, 40},
                                            {"Mediastinum", 350, 50},  {"Liver", 150, 70},   {"Stent", 2500, 700}};
enum { window_count = sizeof windows / sizeof *windows };

const ang_window_preset *ang_window_presets(int *count) {
    *count = window_count;
    return windows;
}

void ang_window_preset_choose(ang_viewer *viewer, int index) {
    double width = windows[index].width, centre = windows[index].centre;
    if (index == 0) ang_viewer_file_window(viewer, &centre, &width);
    viewer->document.window_centre = centre;
    viewer->document.window_width = width;
}
