#include "ui/panes/slice_pane.h"

#include "core/scene/annotation.h"
#include "ui/panes/crosshair.h"
#include "ui/panes/identity.h"
#include "ui/panes/measure_drawing.h"
#include "ui/panes/overlay.h"
#include "ui/panes/planes.h"
#include "ui/panes/playing.h"
#include "ui/study.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>

static const double least_window = 1;

ang_slice_frame ang_slice_frame_of(const ang_viewer *viewer, ang_orientation orientation, ang_rect rect) {
    return ang_slice_frame_make(viewer->study.volume, &viewer->turn, orientation,
                                &viewer->document.slice_view[orientation], viewer->document.crosshair, (int)rect.width,
                                (int)rect.height);
}

double ang_slice_zoom_percent(const ang_viewer *viewer, ang_pane pane) {
    double pixel = ang_vec3_length(viewer->slice[pane].plane.step_x);
    return pixel > 0 ? 100 * ang_volume_smallest_spacing(viewer->study.volume) / pixel : 0;
}

void ang_slice_scroll(ang_viewer *viewer, ang_orientation orientation, int slices) {
    ang_playing_stop(viewer);
    viewer->document.crosshair = ang_slice_move(&viewer->range[orientation], viewer->document.crosshair, slices);
}

/* To the right widens the window, up brightens; Shift: ten times finer. */
static void drag_window(ang_viewer *viewer, const ang_canvas *canvas) {
    ang_document *document = &viewer->document;
    double speed =
        fmax(viewer->gesture.before.window_width / 300, viewer->study.volume->slope / 4) / viewer->input.scale;
    if (canvas->modifiers & ANG_MOD_SHIFT) speed /= 10;
    document->window_width =
        fmax(document->window_width + canvas->dx * speed, least_window * viewer->study.volume->slope);
    document->window_centre += canvas->dy * speed;
}

/* Up goes on: the pane's height through all slices, or slower where they are few; Shift: ten times finer. */
static void drag_slices(ang_viewer *viewer, ang_orientation orientation, const ang_canvas *canvas, int height) {
    ang_gesture *gesture = &viewer->gesture;
    const ang_slice_range *range = &viewer->range[orientation];
    double pixels = fmin((double)height / range->count, 8 * viewer->input.scale);
    if (canvas->modifiers & ANG_MOD_SHIFT) pixels *= 10;
    gesture->slices -= canvas->dy / pixels;
    ang_playing_stop(viewer);
    viewer->document.crosshair = ang_slice_move(range, gesture->before.crosshair, (int)round(gesture->slices));
}

static void drag(ang_viewer *viewer, ang_orientation orientation, const ang_canvas *canvas,
                 const ang_slice_frame *frame) {
    ang_slice_view *view = &viewer->document.slice_view[orientation];
    const ang_volume *volume = viewer->study.volume;
    bool panning =
        canvas->held == ANG_BUTTON_MIDDLE ||
        (canvas->held == ANG_BUTTON_LEFT && (viewer->tool == ANG_TOOL_PAN || viewer->input.key[ANG_KEY_SPACE]));
    if (panning) {
        view->pan_mm[0] -= canvas->dx * frame->mm_per_pixel;
        view->pan_mm[1] -= canvas->dy * frame->mm_per_pixel;
        ang_slice_keep_inside(view, volume, &frame->axes);
    } else if (canvas->held == ANG_BUTTON_RIGHT) {
        ang_slice_zoom(view, frame, canvas->start_x, canvas->start_y, exp(-canvas->dy / (150 * viewer->input.scale)));
        ang_slice_keep_inside(view, volume, &frame->axes);
    } else if (viewer->gesture.turns) {
        ang_crosshair_turn(viewer, (ang_pane)orientation, frame, canvas);
    } else if (viewer->tool == ANG_TOOL_CROSSHAIR) {
        ang_viewer_point_at(viewer, ang_slice_at(frame, canvas->x, canvas->y));
    } else if (viewer->tool == ANG_TOOL_SCROLL) {
        drag_slices(viewer, orientation, canvas, frame->height);
    } else if (viewer->tool == ANG_TOOL_WINDOW) {
        drag_window(viewer, canvas);
    }
}

static void handle(ang_viewer *viewer, ang_pane pane, const ang_canvas *canvas, const ang_slice_frame *frame) {
    ang_orientation orientation = (ang_orientation)pane;
    ang_gesture *gesture = &viewer->gesture;
    ang_vec3 before = gesture->before.crosshair;
    if (canvas->pressed)
        *gesture = (ang_gesture){.pane = (int)pane,
                                 .before = viewer->document,
                                 .turns = canvas->held == ANG_BUTTON_LEFT && !viewer->input.key[ANG_KEY_SPACE] &&
                                          ang_crosshair_handle_at(viewer, pane, frame, canvas->x, canvas->y)};
    ang_measuring_slice(viewer, pane, canvas, frame);
    if (canvas->double_clicked) {
        viewer->maximised = viewer->maximised == (int)pane ? -1 : (int)pane;
        gesture->cancelled = true;
        viewer->document.crosshair = before; /* the first of the two clicks moved it */
        return;
    }
    bool ours = gesture->pane == (int)pane && !gesture->cancelled;
    ang_cutting_pane cutting = {viewer->pane[pane], ang_pane_map_of_slice(frame), frame};
    bool cuts = gesture->pane == (int)pane && ang_cutting_hands(viewer, &cutting, canvas);
    if (ours && !cuts && canvas->held >= 0 && (canvas->dx != 0 || canvas->dy != 0 || canvas->pressed))
        drag(viewer, orientation, canvas, frame);
    bool points = canvas->clicked && canvas->released == ANG_BUTTON_LEFT && viewer->tool != ANG_TOOL_PAN &&
                  viewer->tool != ANG_TOOL_MEASURE;
    if (ours && !cuts && points && !gesture->turns)
        ang_viewer_point_at(viewer, ang_slice_at(frame, canvas->start_x, canvas->start_y));
    if (canvas->wheel == 0) return;
    ang_slice_view *view = &viewer->document.slice_view[orientation];
    if (canvas->modifiers & ANG_MOD_CONTROL) {
        ang_slice_zoom(view, frame, canvas->x, canvas->y, pow(1.15, canvas->wheel));
        ang_slice_keep_inside(view, viewer->study.volume, &frame->axes);
    } else {
        ang_slice_scroll(viewer, orientation, (int)(canvas->wheel > 0 ? ceil(canvas->wheel) : floor(canvas->wheel)));
    }
}

static void write_corners(ang_viewer *viewer, ang_pane pane, ang_rect rect) {
    static const char *const names[] = {"Axial", "Coronal", "Sagittal"};
    const ang_document *document = &viewer->document;
    const ang_slice_range *range = &viewer->range[pane];
    const char *unit = viewer->study.hounsfield ? " HU" : "";
    char text[200];
    double lean = ang_slice_lean(&viewer->turn, (ang_orientation)pane);
    snprintf(text, sizeof text, "%s, oblique %.1f\xc2\xb0", names[pane], lean);
    ang_pane_corner(viewer, rect, 0, 0, 0, lean > 0 ? text : names[pane]);
    ang_identity_write(viewer, rect);
    double along = ang_vec3_dot(viewer->document.crosshair, range->normal);
    ang_letters side = ang_letters_make(ang_vec3_scale(range->normal, along < 0 ? -1 : 1));
    snprintf(text, sizeof text, "%d / %d", ang_slice_index(range, viewer->document.crosshair) + 1, range->count);
    ang_pane_corner(viewer, rect, 0, 1, 1, text);
    snprintf(text, sizeof text, "%s %.1f mm", side.text, fabs(along));
    ang_pane_corner(viewer, rect, 0, 1, 0, text);
    if (document->slab_mm > 0) {
        static const char *const slabs[] = {"mean", "MIP", "MinIP"};
        snprintf(text, sizeof text, "slab %.1f mm, %s", document->slab_mm, slabs[document->slab]);
        ang_pane_corner(viewer, rect, 0, 1, 2, text);
    }
    ang_playing_write(viewer, pane, rect, document->slab_mm > 0 ? 3 : 2);
    snprintf(text, sizeof text, "C %.0f  W %.0f%s", document->window_centre, document->window_width, unit);
    ang_pane_corner(viewer, rect, 1, 1, 0, text);
    snprintf(text, sizeof text, "%szoom %.0f %%", viewer->voxels_shown ? "voxels, " : "",
             ang_slice_zoom_percent(viewer, pane));
    ang_pane_corner(viewer, rect, 1, 1, 1, text);
}

static void hover(ang_viewer *viewer, ang_pane pane, const ang_canvas *canvas, const ang_slice_frame *frame) {
    if (!canvas->hovered && canvas->held < 0) return;
    viewer->hovered = pane;
    viewer->hovered_mm = ang_slice_at(frame, canvas->x, canvas->y);
    const ang_slice_picture *picture = &viewer->slice[pane];
    int x = (int)floor(canvas->x), y = (int)floor(canvas->y);
    bool inside = picture->filled && x >= 0 && y >= 0 && x < picture->plane.width && y < picture->plane.height;
    /* What the pixel shows, the slab included. */
    viewer->hovered_hu = inside ? (double)picture->hu[(size_t)y * (size_t)picture->plane.width + (size_t)x] : NAN;
    bool turns =
        canvas->held >= 0 ? viewer->gesture.turns : ang_crosshair_handle_at(viewer, pane, frame, canvas->x, canvas->y);
    ang_gui_cursor(viewer->gui, turns ? ANG_CURSOR_HAND : ANG_CURSOR_CROSS);
}

void ang_slice_pane(ang_viewer *viewer, ang_pane pane, ang_rect rect) {
    ang_orientation orientation = (ang_orientation)pane;
    ang_slice_picture *picture = &viewer->slice[orientation];
    ang_canvas canvas;
    ang_gui_pane_begin(viewer->gui, ang_orientation_name(orientation), rect, &canvas);
    ang_planes_follow(viewer);
    ang_slice_frame frame = ang_slice_frame_of(viewer, orientation, rect);
    handle(viewer, pane, &canvas, &frame);
    ang_planes_follow(viewer);
    frame = ang_slice_frame_of(viewer, orientation, rect);
    ang_reslice_plane plane = ang_slice_plane(&frame, viewer->document.slab_mm, viewer->document.slab);
    plane.nearest = viewer->voxels_shown;
    ang_error err = {0};
    if (ang_slice_picture_fill(viewer, picture, &plane, &err))
        ang_gui_picture(viewer->gui, &picture->texture, rect);
    else
        ang_viewer_say(viewer, true, "%s", err.message);
    ang_slice_mark_show(viewer, picture, rect);
    hover(viewer, pane, &canvas, &frame);
    ang_gui_on_top_begin(viewer->gui);
    ang_pane_letters(viewer, rect, frame.axes.right, frame.axes.down);
    if (viewer->corner_text) {
        write_corners(viewer, pane, rect);
        ang_pane_bar(viewer, rect, frame.mm_per_pixel, false);
    }
    ang_pane_frame(viewer, rect, pane);
    ang_gui_on_top_end(viewer->gui);
    ang_cutting_pane cutting = {rect, ang_pane_map_of_slice(&frame), &frame};
    ang_cutting_draw(viewer, &cutting, &canvas);
    if (viewer->crosshair_shown) ang_crosshair_draw(viewer, pane, rect, &frame, &canvas);
    ang_measures_draw_slice(viewer, pane, rect, &canvas, &frame);
    ang_gui_pane_end(viewer->gui);
}
