#include "ui/panels/transfer_keys.h"

#include "core/scene/annotation.h"
#include "ui/panels/transfer_editor.h"
#include "ui/viewer_private.h"

#include <math.h>

bool ang_transfer_editor_has_keys(const ang_viewer *viewer) { return viewer->ready && viewer->editing.focused; }

bool ang_curve_can_delete(const ang_viewer *viewer) {
    return ang_transfer_editor_has_keys(viewer) && viewer->point >= 0;
}

/* So that what is moved is seen. */
static void show_point(ang_viewer *viewer) {
    if (viewer->point < 0) return;
    ang_hu_range range = {viewer->editor_low, viewer->editor_high};
    range = ang_hu_range_with(range, viewer->document.points[viewer->point].hu);
    viewer->editor_low = range.low;
    viewer->editor_high = range.high;
}

static void step(ang_viewer *viewer, int by, bool adds) {
    int count = viewer->document.count, now = viewer->point;
    int next = now < 0 ? (by > 0 ? 0 : count - 1) : now + by;
    if (next < 0 || next >= count) return;
    if (adds)
        viewer->editing.chosen.has[next] = true;
    else
        ang_point_set_only(&viewer->editing.chosen, next);
    viewer->point = next;
    show_point(viewer);
}

void ang_curve_step(ang_viewer *viewer, int by) { step(viewer, by, false); }
void ang_curve_step_adding(ang_viewer *viewer, int by) { step(viewer, by, true); }

void ang_curve_edit(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->editing.focused = !viewer->editing.focused;
    /* A move of the pointer before the key does not take them away again. */
    viewer->editing.x = viewer->input.x;
    viewer->editing.y = viewer->input.y;
    if (viewer->editing.focused) ang_gui_leave_widgets(viewer->gui);
    if (viewer->editing.focused && viewer->point < 0) step(viewer, 1, false);
}

void ang_curve_choose_all(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_point_set_all(&viewer->editing.chosen, &viewer->document);
    if (viewer->point < 0) viewer->point = 0;
}

void ang_curve_delete(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_points_delete(&viewer->document, &viewer->editing.chosen);
    viewer->point = -1;
}

/* Between the chosen point and the next one, else in the middle of what is shown. */
void ang_curve_insert(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_document *document = &viewer->document;
    double width = viewer->editor_high - viewer->editor_low, hu = viewer->editor_low + width / 2;
    int at = viewer->point;
    if (at >= 0) {
        const ang_transfer_point *points = document->points;
        hu = at + 1 < document->count ? (points[at].hu + points[at + 1].hu) / 2
                                      : fmin(points[at].hu + width / 20, ANG_TRANSFER_HU_LIMIT);
    }
    int added = ang_document_add_point(document, hu);
    if (added < 0)
        ang_viewer_say(viewer, true, "A transfer function has at most %d points.", ANG_DOCUMENT_POINTS);
    else
        ang_transfer_editor_choose(viewer, added);
    show_point(viewer);
}

void ang_curve_zoom(ang_viewer *viewer, int direction) {
    double about =
        viewer->point >= 0 ? viewer->document.points[viewer->point].hu : (viewer->editor_low + viewer->editor_high) / 2;
    ang_transfer_editor_zoom(viewer, about, direction > 0 ? 0.5 : 2);
}

void ang_curve_show_all(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_transfer_editor_show_all(viewer);
}

static void move(ang_viewer *viewer, int across, int up, bool fine) {
    ang_editing *editing = &viewer->editing;
    double least = fine ? 0.1 : 1;
    /* A round number near a hundredth of what is shown; a hundredth of opacity. */
    double step = ang_round_length((viewer->editor_high - viewer->editor_low) / 100);
    const ang_document from = viewer->document;
    ang_points_move(&viewer->document, &from, &editing->chosen,
                    (ang_point_shift){.hu = across * step * least, .opacity = up * 0.01 * least});
    show_point(viewer);
}

bool ang_transfer_editor_key(ang_viewer *viewer, int key, unsigned modifiers) {
    if (!ang_transfer_editor_has_keys(viewer) || (modifiers & ~(unsigned)ANG_MOD_SHIFT)) return false;
    int across = (key == ANG_KEY_RIGHT) - (key == ANG_KEY_LEFT), up = (key == ANG_KEY_UP) - (key == ANG_KEY_DOWN);
    if (across == 0 && up == 0) return false;
    if (viewer->point >= 0)
        move(viewer, across, up, (modifiers & ANG_MOD_SHIFT) != 0);
    else if (across != 0)
        step(viewer, across, false);
    return true;
}

bool ang_transfer_editor_escape(ang_viewer *viewer) {
    ang_editing *editing = &viewer->editing;
    if (!editing->focused && !editing->has_range) return false;
    if (viewer->point >= 0)
        ang_transfer_editor_choose(viewer, -1);
    else if (editing->has_range)
        editing->has_range = false;
    else
        editing->focused = false;
    return true;
}
