#include "ui/panels/panel.h"

#include "ui/panels/cutting_panel.h"
#include "ui/panels/measures.h"
#include "ui/panels/presets_panel.h"
#include "ui/panels/transfer_editor.h"
#include "ui/panes/identity.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>

static void rendering(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_document *document = &viewer->document;
    const char *unit = viewer->study.hounsfield ? "%.0f HU" : "%.0f";
    ang_gui_heading(gui, "RENDERING");
    static const char *const modes[] = {"Volume rendering", "Maximum (MIP)", "Minimum (MinIP)", "Mean", "Surface"};
    int mode = (int)document->mode;
    ang_gui_label(gui, "Mode");
    if (ang_gui_choice(gui, "##mode", modes, 5, &mode, 0)) document->mode = (ang_mode)mode;
    ang_gui_tooltip(gui, "How the values along a ray become a pixel of the 3D pane");
    if (document->mode == ANG_MODE_DVR) {
        bool shaded = document->shading == ANG_SHADING_PHONG;
        ang_gui_label(gui, "Shading");
        if (ang_gui_checkbox(gui, "Phong##shading", &shaded))
            document->shading = shaded ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
        ang_gui_tooltip(gui, "Light and shade by the direction in which values change");
    } else if (document->mode == ANG_MODE_ISO) {
        ang_gui_label(gui, "Surface at");
        ang_gui_number(gui, "##iso", &document->iso_hu, 2, -1e5, 1e5, unit, 0);
        ang_gui_tooltip(gui, "Value of the surface: drag, or type after a double click or Enter");
    } else {
        ang_gui_label(gui, "Window");
        ang_gui_text_dim(gui, "that of the slices");
    }
    const char *names[16] = {"auto"};
    int indices[16] = {0}, count = 1, chosen = 0;
    for (int i = 0; ang_methods()[i] && count < 16; i++) {
        /* It takes minutes: only where a state has it. */
        if (ang_methods()[i] == &ang_method_reference && document->method != i + 1) continue;
        names[count] = ang_methods()[i]->name;
        indices[count++] = i + 1;
    }
    for (int i = 0; i < count; i++)
        if (indices[i] == document->method) chosen = i;
    ang_gui_label(gui, "Method");
    if (ang_gui_choice(gui, "##method", names, count, &chosen, 0)) document->method = indices[chosen];
    if (viewer->volume.method) ang_gui_tooltip(gui, viewer->volume.method->title);
}

static void slices(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_document *document = &viewer->document;
    const char *unit = viewer->study.hounsfield ? "%.0f HU" : "%.0f";
    double low = -1e5, high = 1e5;
    ang_gui_heading(gui, "SLICES");
    ang_gui_label(gui, "Window");
    double half = (ang_gui_room(gui) - ang_gui_px(gui, 8)) / 2;
    char format[32];
    snprintf(format, sizeof format, "W %s", unit);
    ang_gui_number(gui, "##width", &document->window_width, 2, viewer->study.volume->slope, high, format, half);
    ang_gui_tooltip(gui, "Width of the window: drag, or type after a double click or Enter. Also by dragging in a "
                         "slice, and keys 1 to 9.");
    ang_gui_same_line(gui);
    snprintf(format, sizeof format, "C %s", unit);
    ang_gui_number(gui, "##centre", &document->window_centre, 2, low, high, format, half);
    ang_gui_tooltip(gui, "Centre of the window");
    ang_gui_label(gui, "Slab");
    ang_gui_number(gui, "##slab", &document->slab_mm, 0.1, 0, 200, document->slab_mm > 0 ? "%.1f mm" : "off", half);
    ang_gui_tooltip(gui, "Thickness of what a slice shows; 0: the plane alone. Keys [ and ].");
    ang_gui_same_line(gui);
    static const char *const slabs[] = {"Mean", "MIP", "MinIP"};
    int slab = (int)document->slab;
    if (ang_gui_choice(gui, "##slab-mode", slabs, 3, &slab, half)) document->slab = (ang_slab)slab;
    ang_gui_tooltip(gui, "What a slab shows: the mean, the greatest or the least value across it");
}

static void series(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_study *study = &viewer->study;
    const int *dims = study->volume->dims;
    ang_gui_heading(gui, "SERIES");
    char title[340];
    ang_gui_text(gui, "%s", ang_identity_series(viewer, title));
    ang_gui_text_dim(gui, "%d x %d x %d voxels", dims[0], dims[1], dims[2]);
    ang_gui_text_dim(gui, "%.3g x %.3g x %.3g mm", ang_volume_spacing(study->volume, 0),
                     ang_volume_spacing(study->volume, 1), ang_volume_slice_distance(study->volume));
    char text[80];
    double half = (ang_gui_room(gui) - ang_gui_px(gui, 8)) / 2;
    if (study->series_count > 1)
        snprintf(text, sizeof text, "Series %d of %d", study->series, study->series_count);
    else
        snprintf(text, sizeof text, "Series");
    if (ang_gui_button(gui, text, half, true)) viewer->series.open = true;
    ang_gui_tooltip(gui, "What else there is, with pictures. Key F3.");
    ang_gui_same_line(gui);
    if (study->warnings > 0)
        snprintf(text, sizeof text, "\u25b2 %d warning%s", study->warnings, ang_plural(study->warnings));
    else
        snprintf(text, sizeof text, "Report");
    if (ang_gui_button(gui, text, half, true)) viewer->notes = true;
    ang_gui_tooltip(gui, "What loading found and assumed. Key F2.");
}

void ang_panel(ang_viewer *viewer, ang_rect rect) {
    ang_gui_area_begin(viewer->gui, "panel", rect, true);
    if (viewer->series.open) {
        ang_series_browser_show(viewer);
    } else if (viewer->ready) {
        ang_presets_panel(viewer);
        ang_transfer_editor(viewer);
        rendering(viewer);
        ang_cutting_panel(viewer);
        slices(viewer);
        ang_measures_list(viewer);
        series(viewer);
    }
    ang_gui_area_end(viewer->gui);
}
