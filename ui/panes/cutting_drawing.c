/* What cuts the 3D picture, as it is drawn over the panes. */
#include "core/scene/annotation.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>

enum { ring_pieces = 64 };
static const unsigned hidden = 90, off = 130, plain = 210; /* alpha of what lies behind, what is off, and the rest */

static ang_ink with_alpha(ang_ink ink, unsigned alpha) { return (ink & 0xffffffu) | (ang_ink)alpha << 24; }

/* A line that can be seen on bright and dark. */
static void draw_line(ang_viewer *viewer, const ang_cutting_pane *pane, ang_vec3 from, ang_vec3 to, ang_ink ink,
                      unsigned alpha) {
    double e[4], thick = fmax(ang_gui_px(viewer->gui, alpha > hidden ? 1.5 : 1), 1);
    if (!ang_pane_map_line(&pane->map, from, to, e)) return;
    double x = pane->rect.x, y = pane->rect.y;
    ang_gui_guide(viewer->gui, x + e[0], y + e[1], x + e[2], y + e[3], ANG_INK(0, 0, 0, alpha / 2), thick + 2);
    ang_gui_guide(viewer->gui, x + e[0], y + e[1], x + e[2], y + e[3], with_alpha(ink, alpha), thick);
}

/* A square to take hold of: hollow where it lies behind, large under the pointer. */
static void draw_square(ang_viewer *viewer, const ang_cutting_pane *pane, double x, double y, bool seen, bool hot) {
    double half = ang_gui_px(viewer->gui, hot ? 6 : 4);
    x = round(pane->rect.x + x - half);
    y = round(pane->rect.y + y - half);
    ang_rect square = {x, y, 2 * half, 2 * half};
    ang_gui_fill(viewer->gui, (ang_rect){x - 1, y - 1, 2 * half + 2, 2 * half + 2}, ANG_INK(0, 0, 0, 190));
    if (seen || hot)
        ang_gui_fill(viewer->gui, square, hot ? ANG_INK_TEXT : ANG_INK_CROP);
    else
        ang_gui_frame(viewer->gui, square, with_alpha(ANG_INK_CROP, plain));
}

/* A corner to take hold of, smaller than the squares. */
static void draw_corner(ang_viewer *viewer, const ang_cutting_pane *pane, ang_vec3 mm, bool hot) {
    double x, y, radius = ang_gui_px(viewer->gui, hot ? 6 : 3);
    if (!ang_pane_map_point(&pane->map, mm, &x, &y)) return;
    ang_gui_disc(viewer->gui, pane->rect.x + x, pane->rect.y + y, radius + 1, ANG_INK(0, 0, 0, 190));
    ang_gui_disc(viewer->gui, pane->rect.x + x, pane->rect.y + y, radius, hot ? ANG_INK_TEXT : ANG_INK_CROP);
}

static void draw_box(ang_viewer *viewer, const ang_cutting_pane *pane, unsigned hot) {
    const ang_volume *volume = viewer->study.volume;
    ang_crop_box box = ang_crop_box_of(&viewer->document);
    bool seen[ANG_CROP_FACES];
    unsigned alpha = viewer->document.crop ? plain : off;
    for (int face = 0; face < ANG_CROP_FACES; face++) seen[face] = ang_crop_face_seen(&box, volume, face, &pane->map);
    for (int front = 0; front < 2; front++) {
        for (int i = 0; i < ANG_CROP_EDGES; i++) {
            ang_crop_edge edge = ang_crop_edge_of(&box, volume, i);
            bool before = seen[edge.faces[0]] || seen[edge.faces[1]];
            if (before == front)
                draw_line(viewer, pane, edge.ends[0], edge.ends[1], ANG_INK_CROP, front ? alpha : hidden);
        }
        for (int face = 0; face < ANG_CROP_FACES; face++) {
            double x, y;
            if (seen[face] == front && ang_pane_map_point(&pane->map, ang_crop_face_middle(&box, volume, face), &x, &y))
                draw_square(viewer, pane, x, y, seen[face], hot >> face & 1);
        }
    }
    for (int i = 0; i < ANG_CROP_CORNERS; i++)
        if (ang_crop_corner_seen(&box, volume, i, &pane->map))
            draw_corner(viewer, pane, ang_crop_corner(&box, volume, i), hot == ang_crop_corner_faces(i));
}

/* Cuts a side down to what shows of it; one that lies just beside the pane, by rounding, does. */
static bool shows(const ang_cutting_pane *pane, double side[4]) {
    const double beside = 1.5;
    for (int i = 0; i < 4; i++) side[i] += beside;
    bool found = ang_line_within(side, pane->rect.width + 2 * beside, pane->rect.height + 2 * beside);
    for (int i = 0; i < 4; i++) side[i] -= beside;
    return found;
}

/* In the middle of what shows of a side; on the pane's edge whole, and beside the letter that is there. */
static void place_handle(const ang_viewer *viewer, const ang_cutting_pane *pane, const double side[4], double *x,
                         double *y) {
    double inset = ang_gui_px(viewer->gui, 6), aside = ang_gui_px(viewer->gui, 24);
    double middle_x = (side[0] + side[2]) / 2, middle_y = (side[1] + side[3]) / 2;
    *x = fmin(fmax(middle_x, inset), pane->rect.width - inset);
    *y = fmin(fmax(middle_y, inset), pane->rect.height - inset);
    if (fabs(*x - middle_x) > 0)
        *y += aside;
    else if (fabs(*y - middle_y) > 0)
        *x += aside;
}

/* The box in a slice: its outline, and handles on the sides. */
static void draw_outline(ang_viewer *viewer, const ang_cutting_pane *pane, bool handles, unsigned hot) {
    ang_crop_box box = ang_crop_box_of(&viewer->document);
    ang_crop_side sides[ANG_CROP_FACES];
    ang_vec3 inward = pane->frame->axes.inward;
    double offset = ang_vec3_dot(inward, pane->frame->corner), e[4];
    int count = ang_crop_outline(&box, viewer->study.volume, inward, offset, sides);
    unsigned alpha = viewer->document.crop ? plain : off;
    for (int i = 0; i < count; i++) draw_line(viewer, pane, sides[i].ends[0], sides[i].ends[1], ANG_INK_CROP, alpha);
    for (int i = 0; i < count && handles; i++) {
        if (!ang_pane_map_line(&pane->map, sides[i].ends[0], sides[i].ends[1], e)) continue;
        double x, y;
        if (!shows(pane, e)) continue;
        place_handle(viewer, pane, e, &x, &y);
        draw_square(viewer, pane, x, y, true, hot >> sides[i].face & 1);
    }
}

/* The line in which the plane cuts a slice, with strokes into what is cut away. */
static void draw_cut(ang_viewer *viewer, const ang_cutting_pane *pane, bool hot) {
    ang_gui *gui = viewer->gui;
    double e[4], thick = fmax(ang_gui_px(gui, hot ? 2.5 : 1.5), 1);
    if (!ang_clip_line(&viewer->document.clip, pane->frame, e)) return;
    double x = pane->rect.x, y = pane->rect.y, length = hypot(e[2] - e[0], e[3] - e[1]);
    double way[2] = {(e[2] - e[0]) / length, (e[3] - e[1]) / length}, gap = ang_gui_px(gui, 24);
    ang_gui_guide(gui, x + e[0], y + e[1], x + e[2], y + e[3], ANG_INK(0, 0, 0, 110), thick + 2);
    ang_gui_guide(gui, x + e[0], y + e[1], x + e[2], y + e[3], with_alpha(ANG_INK_CLIP, plain), thick);
    for (double at = gap / 2; at < length; at += gap) {
        double from_x = x + e[0] + at * way[0], from_y = y + e[1] + at * way[1], stroke = ang_gui_px(gui, 5);
        ang_gui_guide(gui, from_x, from_y, from_x + stroke * way[1], from_y - stroke * way[0],
                      with_alpha(ANG_INK_CLIP, plain), thick);
    }
}

static void draw_ring(ang_viewer *viewer, const ang_cutting_pane *pane, bool hot) {
    ang_vec3 foot = ang_cutting_foot(viewer), normal = viewer->document.clip.normal;
    double radius = ang_cutting_ring(viewer, &pane->map);
    /* Two directions across the normal. */
    ang_vec3 other = fabs(normal.z) < 0.8 ? (ang_vec3){0, 0, 1} : (ang_vec3){1, 0, 0};
    ang_vec3 u = ang_vec3_unit(ang_vec3_cross(normal, other)), v = ang_vec3_cross(normal, u);
    ang_vec3 last = ang_vec3_along(foot, u, radius);
    for (int i = 1; i <= ring_pieces; i++) {
        double angle = 2 * M_PI * i / ring_pieces;
        ang_vec3 next = ang_vec3_along(ang_vec3_along(foot, u, radius * cos(angle)), v, radius * sin(angle));
        draw_line(viewer, pane, last, next, hot ? ANG_INK_TEXT : ANG_INK_CLIP, plain);
        last = next;
    }
}

/* The plane's polygon in the box, its ring to push and its arrow, which points into what is cut away, to turn. */
static void draw_plane(ang_viewer *viewer, const ang_cutting_pane *pane, ang_grip_kind hot) {
    ang_gui *gui = viewer->gui;
    const ang_clip_plane *clip = &viewer->document.clip;
    ang_crop_box box = ang_crop_box_of(&viewer->document);
    if (!viewer->document.crop) ang_volume_box(viewer->study.volume, &box.lower, &box.upper);
    ang_crop_side sides[ANG_CROP_FACES];
    int count = ang_crop_outline(&box, viewer->study.volume, clip->normal, clip->offset_mm, sides);
    for (int i = 0; i < count; i++) draw_line(viewer, pane, sides[i].ends[0], sides[i].ends[1], ANG_INK_CLIP, plain);
    draw_ring(viewer, pane, hot == ANG_CUTTING_PLANE);
    ang_vec3 foot = ang_cutting_foot(viewer), tip = ang_cutting_tip(viewer, &pane->map);
    draw_line(viewer, pane, foot, tip, ANG_INK_CLIP, plain);
    double x, y, size = ang_gui_px(gui, 4);
    if (ang_pane_map_point(&pane->map, foot, &x, &y))
        ang_gui_disc(gui, pane->rect.x + x, pane->rect.y + y, size * 0.75, ANG_INK_CLIP);
    if (!ang_pane_map_point(&pane->map, tip, &x, &y)) return;
    double radius = hot == ANG_CUTTING_TIP ? 1.75 * size : 1.25 * size;
    ang_gui_disc(gui, pane->rect.x + x, pane->rect.y + y, radius + 1, ANG_INK(0, 0, 0, 190));
    ang_gui_disc(gui, pane->rect.x + x, pane->rect.y + y, radius, hot == ANG_CUTTING_TIP ? ANG_INK_TEXT : ANG_INK_CLIP);
}

/* What is held, in numbers as they stand in the panel. */
static void write_numbers(ang_viewer *viewer, const ang_cutting_pane *pane, const ang_canvas *canvas) {
    const ang_volume *volume = viewer->study.volume;
    ang_cutting_grip grip = viewer->cutting.grip;
    char text[96] = "";
    size_t used = 0;
    ang_crop_box box = ang_crop_box_of(&viewer->document);
    for (int face = 0; face < ANG_CROP_FACES && grip.kind == ANG_CUTTING_FACES; face++) {
        if (!(grip.faces >> face & 1)) continue;
        ang_vec3 outward = ang_vec3_scale(ang_mat4_column(&volume->affine, face / 2), face % 2 ? 1 : -1);
        double mm = ang_crop_face_at(&box, face) * ang_volume_spacing(volume, face / 2);
        int more = snprintf(text + used, sizeof text - used, "%s%c %.1f mm", used > 0 ? "   " : "",
                            ang_letters_make(outward).text[0], mm);
        used += more > 0 ? (size_t)more : 0;
    }
    double azimuth, elevation;
    ang_clip_plane_angles(&viewer->document.clip, &azimuth, &elevation);
    if (grip.kind == ANG_CUTTING_PLANE)
        snprintf(text, sizeof text, "%.1f mm", ang_clip_offset(&viewer->document.clip, volume));
    else if (grip.kind == ANG_CUTTING_TIP)
        snprintf(text, sizeof text, "azimuth %.1f\xc2\xb0, elevation %.1f\xc2\xb0", azimuth, elevation);
    double x = pane->rect.x + canvas->x, y = pane->rect.y + canvas->y - ang_gui_px(viewer->gui, 30);
    ang_gui_write(viewer->gui, x, y, 0.5, true, true, ANG_INK_TEXT, text);
}

void ang_cutting_draw(ang_viewer *viewer, const ang_cutting_pane *pane, const ang_canvas *canvas) {
    bool tool = viewer->tool == ANG_TOOL_CROP, clips = ang_clip_plane_given(&viewer->document.clip);
    bool holding = canvas->held >= 0 && viewer->cutting.grip.kind != ANG_CUTTING_NONE;
    ang_cutting_grip grip = {ANG_CUTTING_NONE, 0};
    if (holding)
        grip = viewer->cutting.grip;
    else if (canvas->hovered && canvas->held < 0)
        grip = ang_cutting_grip_at(viewer, pane, canvas->x, canvas->y);
    unsigned faces = grip.kind == ANG_CUTTING_FACES ? grip.faces : 0;
    if (grip.kind != ANG_CUTTING_NONE) ang_gui_cursor(viewer->gui, ANG_CURSOR_HAND);
    if (pane->frame) {
        if (tool || viewer->document.crop) draw_outline(viewer, pane, tool, faces);
        if (clips) draw_cut(viewer, pane, grip.kind == ANG_CUTTING_PLANE);
    } else if (tool) {
        draw_box(viewer, pane, faces);
        if (clips) draw_plane(viewer, pane, grip.kind);
    }
    if (holding) write_numbers(viewer, pane, canvas);
}
