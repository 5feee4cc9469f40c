/* The hands on what cuts the 3D picture: the crop box and the clip plane. */
#include "ui/panes/cutting.h"

#include "ui/viewer_private.h"

#include <math.h>

/* Pixels at scale 1. */
static const double reach = 9, side_reach = 7, ring_radius = 52, arrow_length = 84;

ang_vec3 ang_cutting_foot(const ang_viewer *viewer) {
    return ang_clip_plane_foot(&viewer->document.clip, viewer->cutting.pivot);
}

double ang_cutting_ring(const ang_viewer *viewer, const ang_pane_map *map) {
    double scale = ang_pane_map_scale(map, ang_cutting_foot(viewer));
    return scale > 0 ? ang_gui_px(viewer->gui, ring_radius) / scale : 0;
}

ang_vec3 ang_cutting_tip(const ang_viewer *viewer, const ang_pane_map *map) {
    double length = ang_cutting_ring(viewer, map) * arrow_length / ring_radius;
    return ang_vec3_along(ang_cutting_foot(viewer), viewer->document.clip.normal, length);
}

/* The ring as it appears is a circle seen from the side: near enough an ellipse about the foot. */
static bool on_ring(const ang_viewer *viewer, const ang_pane_map *map, double x, double y, double radius) {
    ang_vec3 origin, direction, foot = ang_cutting_foot(viewer), normal = viewer->document.clip.normal;
    ang_pane_map_ray(map, x, y, &origin, &direction);
    double steep = ang_vec3_dot(direction, normal), scale = ang_pane_map_scale(map, foot);
    double away = ang_vec3_dot(ang_vec3_sub(foot, origin), normal) / steep;
    /* Seen end on it is a line, of which the middle can be taken. */
    if (fabs(steep) < 0.05 || !isfinite(away)) return false;
    ang_vec3 from = ang_vec3_sub(ang_vec3_along(origin, direction, away), foot);
    return fabs(ang_vec3_length(from) - ang_cutting_ring(viewer, map)) * scale * fmax(fabs(steep), 0.2) <= radius;
}

static ang_cutting_grip grip_in_volume(const ang_viewer *viewer, const ang_pane_map *map, double x, double y) {
    bool clips = ang_clip_plane_given(&viewer->document.clip);
    double radius = ang_gui_px(viewer->gui, reach);
    ang_crop_box box = ang_crop_box_of(&viewer->document);
    if (clips && ang_pane_map_distance(map, ang_cutting_tip(viewer, map), x, y) <= radius)
        return (ang_cutting_grip){ANG_CUTTING_TIP, 0};
    unsigned faces = ang_crop_pick(&box, viewer->study.volume, map, x, y, radius);
    if (faces) return (ang_cutting_grip){ANG_CUTTING_FACES, faces};
    bool taken = clips && (ang_pane_map_distance(map, ang_cutting_foot(viewer), x, y) <= radius ||
                           on_ring(viewer, map, x, y, ang_gui_px(viewer->gui, side_reach)));
    return (ang_cutting_grip){taken ? ANG_CUTTING_PLANE : ANG_CUTTING_NONE, 0};
}

static ang_cutting_grip grip_in_slice(const ang_viewer *viewer, const ang_cutting_pane *pane, double x, double y) {
    double radius = ang_gui_px(viewer->gui, side_reach), ends[4];
    const ang_slice_frame *frame = pane->frame;
    ang_crop_box box = ang_crop_box_of(&viewer->document);
    ang_crop_side sides[ANG_CROP_FACES];
    ang_vec3 inward = frame->axes.inward;
    int count = ang_crop_outline(&box, viewer->study.volume, inward, ang_vec3_dot(inward, frame->corner), sides);
    unsigned faces = ang_crop_pick_side(sides, count, &pane->map, x, y, radius);
    if (faces) return (ang_cutting_grip){ANG_CUTTING_FACES, faces};
    bool taken = ang_clip_plane_given(&viewer->document.clip) && ang_clip_line(&viewer->document.clip, frame, ends) &&
                 ang_line_distance(ends, x, y) <= radius;
    return (ang_cutting_grip){taken ? ANG_CUTTING_PLANE : ANG_CUTTING_NONE, 0};
}

ang_cutting_grip ang_cutting_grip_at(const ang_viewer *viewer, const ang_cutting_pane *pane, double x, double y) {
    if (viewer->tool != ANG_TOOL_CROP || viewer->input.key[ANG_KEY_SPACE])
        return (ang_cutting_grip){ANG_CUTTING_NONE, 0};
    return pane->frame ? grip_in_slice(viewer, pane, x, y) : grip_in_volume(viewer, &pane->map, x, y);
}

/* The places of a slice pane at which the hand began and to which it has gone. */
static ang_vec3 hand_began(const ang_cutting_pane *pane, const ang_canvas *canvas) {
    return ang_slice_at(pane->frame, canvas->start_x, canvas->start_y);
}
static ang_vec3 hand_is(const ang_viewer *viewer, const ang_cutting_pane *pane, const ang_canvas *canvas) {
    return ang_slice_at(pane->frame, canvas->start_x + viewer->cutting.dx, canvas->start_y + viewer->cutting.dy);
}

static void drag_faces(ang_viewer *viewer, const ang_cutting_pane *pane, const ang_canvas *canvas) {
    const ang_cutting *cutting = &viewer->cutting;
    const ang_volume *volume = viewer->study.volume;
    unsigned faces = cutting->grip.faces;
    ang_crop_box before = ang_crop_box_of(&viewer->gesture.before);
    ang_crop_box box = pane->frame ? ang_crop_drag_slice(&before, volume, faces, hand_began(pane, canvas),
                                                         hand_is(viewer, pane, canvas))
                                   : ang_crop_drag(&before, volume, faces, &pane->map, cutting->dx, cutting->dy);
    ang_crop_box_set(&viewer->document, &box);
    viewer->document.crop = true;
}

static void drag_plane(ang_viewer *viewer, const ang_cutting_pane *pane, const ang_canvas *canvas) {
    const ang_clip_plane *before = &viewer->gesture.before.clip;
    double mm;
    if (pane->frame) {
        /* The line goes with the pointer at whatever angle the slice cuts the plane. */
        mm = ang_vec3_dot(before->normal, ang_vec3_sub(hand_is(viewer, pane, canvas), hand_began(pane, canvas)));
    } else {
        double x, y;
        ang_vec3 foot = ang_clip_plane_foot(before, viewer->cutting.pivot);
        if (!ang_pane_map_point(&pane->map, foot, &x, &y)) return;
        mm = ang_pane_map_drag(&pane->map, foot, before->normal, x + viewer->cutting.dx, y + viewer->cutting.dy);
    }
    viewer->document.clip = ang_clip_plane_moved(before, viewer->study.volume, mm);
}

static void drag_tip(ang_viewer *viewer, const ang_cutting_pane *pane) {
    ang_cutting *cutting = &viewer->cutting;
    const ang_pane_map *map = &pane->map;
    const ang_clip_plane *before = &viewer->gesture.before.clip;
    /* The arrow is as long as it was: the pivot is in the plane and stays there. */
    double length = ang_cutting_ring(viewer, map) * arrow_length / ring_radius, x, y;
    ang_vec3 tip = ang_vec3_along(cutting->pivot, before->normal, length);
    if (!ang_pane_map_point(map, tip, &x, &y)) return;
    bool towards_eye = ang_clip_tip_towards_eye(map, cutting->pivot, tip);
    ang_vec3 normal = ang_clip_normal_at(map, cutting->pivot, length, towards_eye, x + cutting->dx, y + cutting->dy);
    viewer->document.clip = ang_clip_plane_through(cutting->pivot, normal);
}

bool ang_cutting_hands(ang_viewer *viewer, const ang_cutting_pane *pane, const ang_canvas *canvas) {
    ang_cutting *cutting = &viewer->cutting;
    if (canvas->held < 0 && canvas->released < 0) return false;
    if (canvas->pressed) {
        cutting->grip = canvas->held == ANG_BUTTON_LEFT ? ang_cutting_grip_at(viewer, pane, canvas->x, canvas->y)
                                                        : (ang_cutting_grip){ANG_CUTTING_NONE, 0};
        cutting->dx = cutting->dy = 0;
        if (cutting->grip.kind == ANG_CUTTING_TIP) cutting->pivot = ang_cutting_foot(viewer);
    }
    ang_cutting_grip grip = cutting->grip;
    if (canvas->held < 0) cutting->grip.kind = ANG_CUTTING_NONE;
    bool moves = grip.kind != ANG_CUTTING_NONE && !viewer->gesture.cancelled && (canvas->dx != 0 || canvas->dy != 0);
    if (!moves) return grip.kind != ANG_CUTTING_NONE;
    double fine = canvas->modifiers & ANG_MOD_SHIFT ? 0.1 : 1;
    cutting->dx += fine * canvas->dx;
    cutting->dy += fine * canvas->dy;
    if (grip.kind == ANG_CUTTING_FACES)
        drag_faces(viewer, pane, canvas);
    else if (grip.kind == ANG_CUTTING_PLANE)
        drag_plane(viewer, pane, canvas);
    else
        drag_tip(viewer, pane);
    return true;
}

void ang_crop_reset(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_volume_box(viewer->study.volume, &viewer->document.crop_lower, &viewer->document.crop_upper);
}

void ang_clip_face_viewer(ang_viewer *viewer, int argument) {
    (void)argument;
    ang_camera camera = ang_camera_for(viewer->study.volume, &viewer->document.view);
    viewer->cutting.pivot = viewer->document.crosshair;
    viewer->document.clip = ang_clip_plane_through(viewer->document.crosshair, ang_vec3_scale(camera.forward, -1));
}

void ang_clip_toggle(ang_viewer *viewer, int argument) {
    if (ang_clip_plane_given(&viewer->document.clip))
        viewer->document.clip = (ang_clip_plane){0};
    else
        ang_clip_face_viewer(viewer, argument);
}

void ang_clip_flip(ang_viewer *viewer, int argument) {
    (void)argument;
    viewer->document.clip = ang_clip_plane_flip(&viewer->document.clip);
}

bool ang_clip_is_on(const ang_viewer *viewer, int argument) {
    (void)argument;
    return ang_clip_plane_given(&viewer->document.clip);
}
bool ang_clip_can_flip(const ang_viewer *viewer) { return viewer->ready && ang_clip_is_on(viewer, 0); }
