#include "ui/panes/volume_pane.h"

#include "core/scene/annotation.h"
#include "ui/panes/identity.h"
#include "ui/panes/measure_drawing.h"
#include "ui/panes/orientation.h"
#include "ui/panes/overlay.h"
#include "ui/panes/playing.h"
#include "ui/panes/volume_ray.h"
#include "ui/study.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>

/* Millimetres of a pixel at the depth of the volume's centre. */
static double scale_of(const ang_viewer *viewer, ang_rect rect) {
    ang_scene scene = ang_volume_scene(viewer, &viewer->document, NULL, (int)rect.width, (int)rect.height);
    return ang_annotation_make(&scene, NULL).mm_per_pixel;
}

double ang_volume_zoom_percent(const ang_viewer *viewer) {
    double pixel = scale_of(viewer, viewer->pane[ANG_PANE_VOLUME]);
    return pixel > 0 ? 100 * ang_volume_smallest_spacing(viewer->study.volume) / pixel : 0;
}

static void zoom(ang_viewer *viewer, ang_rect rect, double x, double y, double factor) {
    ang_view_zoom(&viewer->document.view, viewer->study.volume, (int)rect.width, (int)rect.height, x, y, factor);
}

void ang_volume_zoom(ang_viewer *viewer, double factor) {
    ang_rect rect = viewer->pane[ANG_PANE_VOLUME];
    zoom(viewer, rect, rect.width / 2, rect.height / 2, factor);
}

void ang_volume_pan(ang_viewer *viewer, double right, double down) {
    double mm = scale_of(viewer, viewer->pane[ANG_PANE_VOLUME]);
    viewer->document.view.pan_mm[0] -= right * mm;
    viewer->document.view.pan_mm[1] += down * mm;
}

/* As 3D Slicer: up and down shift, across stretches. */
static void bend(ang_viewer *viewer, const ang_canvas *canvas) {
    const ang_document *before = &viewer->gesture.before;
    double low = before->points[0].hu, high = before->points[before->count - 1].hu;
    double speed = fmax(high - low, 1) / 2000 / viewer->input.scale;
    double shift = -(canvas->y - canvas->start_y) * speed;
    double stretch = exp((canvas->x - canvas->start_x) / (300 * viewer->input.scale));
    ang_document_bend(&viewer->document, before, shift, stretch);
}

/* Up makes everything more opaque, by half for each 60 pixels. */
static void strengthen(ang_viewer *viewer, const ang_canvas *canvas) {
    double factor = exp((canvas->start_y - canvas->y) / (150 * viewer->input.scale));
    ang_document_strengthen(&viewer->document, &viewer->gesture.before, factor);
}

static void turn(ang_viewer *viewer, const ang_canvas *canvas, ang_rect rect) {
    ang_view *view = &viewer->document.view;
    double degrees = 180 / fmin(rect.width, rect.height);
    if (viewer->turns_about_crosshair)
        ang_view_turn_about(view, viewer->study.volume, viewer->document.crosshair, canvas->dx * degrees,
                            canvas->dy * degrees);
    else
        ang_view_turn(view, canvas->dx * degrees, canvas->dy * degrees);
}

static void drag(ang_viewer *viewer, const ang_canvas *canvas, ang_rect rect) {
    bool panning =
        canvas->held == ANG_BUTTON_MIDDLE ||
        (canvas->held == ANG_BUTTON_LEFT && (viewer->input.key[ANG_KEY_SPACE] || viewer->tool == ANG_TOOL_PAN));
    if (panning) {
        ang_volume_pan(viewer, canvas->dx, canvas->dy);
    } else if (canvas->held == ANG_BUTTON_RIGHT) {
        zoom(viewer, rect, canvas->start_x, canvas->start_y, exp(-canvas->dy / (150 * viewer->input.scale)));
    } else if (viewer->gesture.strengthens) {
        strengthen(viewer, canvas);
    } else if (viewer->gesture.bends) {
        bend(viewer, canvas);
    } else {
        turn(viewer, canvas, rect);
    }
}

static ang_cutting_pane cutting_pane(const ang_viewer *viewer, ang_rect rect) {
    ang_camera camera = ang_camera_for(viewer->study.volume, &viewer->document.view);
    return (ang_cutting_pane){rect, ang_pane_map_of_camera(&camera, (int)rect.width, (int)rect.height), NULL};
}

static void handle(ang_viewer *viewer, const ang_canvas *canvas, ang_rect rect) {
    ang_gesture *gesture = &viewer->gesture;
    ang_vec3 before = gesture->before.crosshair;
    if (canvas->pressed)
        *gesture = (ang_gesture){.pane = ANG_PANE_VOLUME,
                                 .before = viewer->document,
                                 .bends = canvas->modifiers == ANG_MOD_SHIFT,
                                 .strengthens = canvas->modifiers == (ANG_MOD_SHIFT | ANG_MOD_CONTROL)};
    ang_measuring_volume(viewer, canvas);
    if (canvas->double_clicked) {
        viewer->maximised = viewer->maximised == ANG_PANE_VOLUME ? -1 : ANG_PANE_VOLUME;
        gesture->cancelled = true;
        viewer->document.crosshair = before; /* the first of the two clicks moved it */
        return;
    }
    bool ours = gesture->pane == ANG_PANE_VOLUME && !gesture->cancelled;
    ang_cutting_pane cutting = cutting_pane(viewer, rect);
    bool cuts = gesture->pane == ANG_PANE_VOLUME && ang_cutting_hands(viewer, &cutting, canvas);
    if (ours && !cuts && canvas->held >= 0 && (canvas->dx != 0 || canvas->dy != 0)) drag(viewer, canvas, rect);
    ang_vec3 mm;
    bool picks = ours && !cuts && canvas->clicked && canvas->released == ANG_BUTTON_LEFT && !gesture->bends &&
                 !gesture->strengthens && viewer->tool != ANG_TOOL_MEASURE;
    if (picks && ang_volume_pick(viewer, canvas->start_x, canvas->start_y, &mm)) ang_viewer_point_at(viewer, mm);
    if (canvas->wheel != 0) zoom(viewer, rect, canvas->x, canvas->y, pow(1.15, canvas->wheel));
}

static void write_corners(ang_viewer *viewer, ang_rect rect) {
    const ang_document *document = &viewer->document;
    const ang_volume_picture *volume = &viewer->volume;
    const char *unit = viewer->study.hounsfield ? " HU" : "";
    char text[200];
    ang_pane_corner(viewer, rect, 0, 0, 0, "Volume");
    ang_identity_write(viewer, rect);
    bool bent = document->shift_hu != 0 || document->stretch < 1 || document->stretch > 1;
    ang_crop_box box = ang_crop_box_of(document);
    bool cropped = document->crop && !ang_crop_box_whole(&box, viewer->study.volume);
    snprintf(text, sizeof text, "%s%s, %s%s%s", document->preset,
             viewer->comparing           ? " (as saved)"
             : document->edited && !bent ? " (changed)"
                                         : "",
             ang_mode_name(document->mode), cropped ? ", cropped" : "",
             ang_clip_plane_given(&document->clip) ? ", clipped" : "");
    ang_pane_corner(viewer, rect, 0, 1, 0, text);
    if (bent) {
        snprintf(text, sizeof text, "shift %+.0f%s, stretch %.2f", document->shift_hu, unit, document->stretch);
        ang_pane_corner(viewer, rect, 0, 1, 1, text);
    }
    ang_playing_write(viewer, ANG_PANE_VOLUME, rect, bent ? 2 : 1);
    double percent = ang_volume_zoom_percent(viewer);
    if (document->mode == ANG_MODE_DVR)
        snprintf(text, sizeof text, "zoom %.0f %%", percent);
    else if (document->mode == ANG_MODE_ISO)
        snprintf(text, sizeof text, "surface %.0f%s  zoom %.0f %%", document->iso_hu, unit, percent);
    else
        snprintf(text, sizeof text, "C %.0f  W %.0f%s  zoom %.0f %%", document->window_centre, document->window_width,
                 unit, percent);
    ang_pane_corner(viewer, rect, 1, 1, 0, text);
    ang_pane_corner(viewer, rect, 1, 1, 1, volume->refined ? "" : ang_volume_level(viewer) > 0 ? "refining" : "coarse");
}

void ang_volume_pane(ang_viewer *viewer, ang_rect rect) {
    ang_canvas canvas;
    ang_gui_pane_begin(viewer->gui, "volume", rect, &canvas);
    handle(viewer, &canvas, rect);
    ang_volume_update(viewer, (int)rect.width, (int)rect.height, false);
    if (canvas.hovered || (canvas.held >= 0 && viewer->gesture.pane == ANG_PANE_VOLUME))
        viewer->hovered = ANG_PANE_VOLUME;
    if (viewer->volume.failure[0])
        ang_gui_write(viewer->gui, rect.x + rect.width / 2, rect.y + rect.height / 2 - ang_gui_px(viewer->gui, 32), 0.5,
                      true, false, ANG_INK_TEXT, viewer->volume.failure);
    else
        ang_gui_picture(viewer->gui, &viewer->volume.texture, rect);
    ang_scene scene = ang_volume_scene(viewer, &viewer->document, NULL, (int)rect.width, (int)rect.height);
    ang_gui_on_top_begin(viewer->gui);
    ang_pane_letters(viewer, rect, scene.camera.right, ang_vec3_scale(scene.camera.up, -1));
    if (viewer->corner_text) {
        write_corners(viewer, rect);
        ang_orientation_axes(viewer, rect, &scene.camera);
        ang_pane_bar(viewer, rect, ang_annotation_make(&scene, NULL).mm_per_pixel,
                     scene.camera.projection == ANG_PERSPECTIVE);
    }
    ang_pane_frame(viewer, rect, ANG_PANE_VOLUME);
    ang_gui_on_top_end(viewer->gui);
    ang_cutting_pane cutting = cutting_pane(viewer, rect);
    ang_cutting_draw(viewer, &cutting, &canvas);
    ang_measures_draw_volume(viewer, rect, scene);
    ang_gui_pane_end(viewer->gui);
}
