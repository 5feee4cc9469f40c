#include "ui/state/crop_geometry.h"

#include <math.h>

static double *component(ang_vec3 *v, int axis) { return axis == 0 ? &v->x : axis == 1 ? &v->y : &v->z; }

ang_crop_box ang_crop_box_of(const ang_document *document) {
    return (ang_crop_box){document->crop_lower, document->crop_upper};
}

void ang_crop_box_set(ang_document *document, const ang_crop_box *box) {
    document->crop_lower = box->lower;
    document->crop_upper = box->upper;
}

bool ang_crop_box_whole(const ang_crop_box *box, const ang_volume *volume) {
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    for (int axis = 0; axis < 3; axis++)
        if (ang_vec3_at(box->lower, axis) > ang_vec3_at(lower, axis) ||
            ang_vec3_at(box->upper, axis) < ang_vec3_at(upper, axis))
            return false;
    return true;
}

double ang_crop_face_at(const ang_crop_box *box, int face) {
    return ang_vec3_at(face % 2 ? box->upper : box->lower, face / 2);
}

void ang_crop_face_move(ang_crop_box *box, const ang_volume *volume, int face, double index) {
    int axis = face / 2;
    ang_vec3 lower, upper;
    ang_volume_box(volume, &lower, &upper);
    if (face % 2)
        *component(&box->upper, axis) = fmin(fmax(index, ang_vec3_at(box->lower, axis) + 1), ang_vec3_at(upper, axis));
    else
        *component(&box->lower, axis) = fmax(fmin(index, ang_vec3_at(box->upper, axis) - 1), ang_vec3_at(lower, axis));
}

static ang_vec3 corner(const ang_crop_box *box, const ang_volume *volume, const bool upper[3]) {
    ang_vec3 index = {upper[0] ? box->upper.x : box->lower.x, upper[1] ? box->upper.y : box->lower.y,
                      upper[2] ? box->upper.z : box->lower.z};
    return ang_mat4_point(&volume->affine, index);
}

/* Number 0 to 3, around the face. */
static ang_vec3 face_corner(const ang_crop_box *box, const ang_volume *volume, int face, int number) {
    bool upper[3];
    int axis = face / 2;
    upper[axis] = face % 2;
    upper[(axis + 1) % 3] = number == 1 || number == 2;
    upper[(axis + 2) % 3] = number >= 2;
    return corner(box, volume, upper);
}

ang_vec3 ang_crop_face_middle(const ang_crop_box *box, const ang_volume *volume, int face) {
    ang_vec3 index = ang_vec3_scale(ang_vec3_add(box->lower, box->upper), 0.5);
    *component(&index, face / 2) = ang_crop_face_at(box, face);
    return ang_mat4_point(&volume->affine, index);
}

bool ang_crop_face_seen(const ang_crop_box *box, const ang_volume *volume, int face, const ang_pane_map *map) {
    int axis = face / 2;
    ang_vec3 outward = ang_mat4_column(&volume->affine, axis);
    ang_vec3 normal = ang_vec3_cross(ang_mat4_column(&volume->affine, (axis + 1) % 3),
                                     ang_mat4_column(&volume->affine, (axis + 2) % 3));
    double out = face % 2 ? ang_vec3_dot(normal, outward) : -ang_vec3_dot(normal, outward);
    ang_vec3 sight = ang_pane_map_sight(map, ang_crop_face_middle(box, volume, face));
    return ang_vec3_dot(normal, sight) * out < 0;
}

ang_vec3 ang_crop_corner(const ang_crop_box *box, const ang_volume *volume, int number) {
    return corner(box, volume, (bool[3]){number & 1, number & 2, number & 4});
}

unsigned ang_crop_corner_faces(int number) {
    unsigned faces = 0;
    for (int axis = 0; axis < 3; axis++) faces |= 1u << (2 * axis + (number >> axis & 1));
    return faces;
}

bool ang_crop_corner_seen(const ang_crop_box *box, const ang_volume *volume, int number, const ang_pane_map *map) {
    for (int face = 0; face < ANG_CROP_FACES; face++)
        if (ang_crop_corner_faces(number) >> face & 1 && ang_crop_face_seen(box, volume, face, map)) return true;
    return false;
}

ang_crop_edge ang_crop_edge_of(const ang_crop_box *box, const ang_volume *volume, int edge) {
    int axis = edge / 4, next = (axis + 1) % 3, last = (axis + 2) % 3;
    bool upper[3];
    upper[next] = edge & 1;
    upper[last] = edge & 2;
    ang_crop_edge found = {.faces = {2 * next + upper[next], 2 * last + upper[last]}};
    for (int i = 0; i < 2; i++) {
        upper[axis] = i;
        found.ends[i] = corner(box, volume, upper);
    }
    return found;
}

/* Where the plane cuts a face's boundary: a corner that lies in it counts as before it, or with `behind` as behind. */
static bool cut_face(const ang_crop_box *box, const ang_volume *volume, int face, ang_vec3 normal, double offset_mm,
                     bool behind, ang_vec3 ends[2]) {
    double close = 1e-6 * ang_volume_smallest_spacing(volume);
    double far[4];
    ang_vec3 at[4];
    int found = 0;
    for (int i = 0; i < 4; i++) {
        at[i] = face_corner(box, volume, face, i);
        far[i] = ang_vec3_dot(normal, at[i]) - offset_mm;
        if (fabs(far[i]) <= close) far[i] = behind ? -close : close;
    }
    for (int i = 0; i < 4 && found < 2; i++) {
        int next = (i + 1) % 4;
        if ((far[i] < 0) == (far[next] < 0)) continue;
        ends[found++] = ang_vec3_along(at[i], ang_vec3_sub(at[next], at[i]), far[i] / (far[i] - far[next]));
    }
    return found == 2;
}

int ang_crop_outline(const ang_crop_box *box, const ang_volume *volume, ang_vec3 normal, double offset_mm,
                     ang_crop_side sides[ANG_CROP_FACES]) {
    int count = 0;
    for (int behind = 0; behind < 2 && count == 0; behind++)
        for (int face = 0; face < ANG_CROP_FACES; face++) {
            sides[count].face = face;
            count += cut_face(box, volume, face, normal, offset_mm, behind, sides[count].ends);
        }
    return count;
}

static unsigned pick_corner(const ang_crop_box *box, const ang_volume *volume, const ang_pane_map *map, double x,
                            double y, double radius) {
    unsigned faces = 0;
    for (int i = 0; i < ANG_CROP_CORNERS; i++) {
        double distance = ang_pane_map_distance(map, ang_crop_corner(box, volume, i), x, y);
        if (distance > radius || !ang_crop_corner_seen(box, volume, i, map)) continue;
        radius = distance;
        faces = ang_crop_corner_faces(i);
    }
    return faces;
}

unsigned ang_crop_pick(const ang_crop_box *box, const ang_volume *volume, const ang_pane_map *map, double x, double y,
                       double radius) {
    int best = -1;
    double nearest = radius;
    for (int face = 0; face < ANG_CROP_FACES; face++) {
        double distance = ang_pane_map_distance(map, ang_crop_face_middle(box, volume, face), x, y);
        /* One that is seen lies over one that is not. */
        if (!ang_crop_face_seen(box, volume, face, map)) distance += 0.5 * radius;
        if (distance > nearest) continue;
        nearest = distance;
        best = face;
    }
    return best >= 0 ? 1u << best : pick_corner(box, volume, map, x, y, radius);
}

unsigned ang_crop_pick_side(const ang_crop_side *sides, int count, const ang_pane_map *map, double x, double y,
                            double radius) {
    unsigned faces = 0;
    double nearest = radius, ends[4];
    for (int i = 0; i < count; i++) {
        if (!ang_pane_map_line(map, sides[i].ends[0], sides[i].ends[1], ends)) continue;
        for (int end = 0; end < 2; end++)
            for (int k = 0; k < i; k++) {
                double other[4];
                if (!ang_pane_map_line(map, sides[k].ends[0], sides[k].ends[1], other)) continue;
                bool meet = hypot(ends[2 * end] - other[0], ends[2 * end + 1] - other[1]) < 1e-3 ||
                            hypot(ends[2 * end] - other[2], ends[2 * end + 1] - other[3]) < 1e-3;
                if (meet && hypot(ends[2 * end] - x, ends[2 * end + 1] - y) <= radius)
                    return 1u << sides[i].face | 1u << sides[k].face;
            }
        double distance = ang_line_distance(ends, x, y);
        if (distance > nearest) continue;
        nearest = distance;
        faces = 1u << sides[i].face;
    }
    return faces;
}

ang_crop_box ang_crop_drag_slice(const ang_crop_box *before, const ang_volume *volume, unsigned faces, ang_vec3 from_mm,
                                 ang_vec3 to_mm) {
    ang_crop_box box = *before;
    ang_mat4 to_index;
    if (!ang_mat4_inverse(&volume->affine, &to_index)) return box;
    ang_vec3 moved = ang_mat4_direction(&to_index, ang_vec3_sub(to_mm, from_mm));
    for (int face = 0; face < ANG_CROP_FACES; face++)
        if (faces >> face & 1)
            ang_crop_face_move(&box, volume, face, ang_crop_face_at(before, face) + ang_vec3_at(moved, face / 2));
    return box;
}

static ang_crop_box drag_corner(const ang_crop_box *before, const ang_volume *volume, int number,
                                const ang_pane_map *map, double dx, double dy) {
    ang_vec3 from = ang_crop_corner(before, volume, number);
    double scale = ang_pane_map_scale(map, from);
    if (!(scale > 0)) return *before;
    ang_vec3 to = ang_vec3_along(ang_vec3_along(from, map->right, dx / scale), map->down, dy / scale);
    return ang_crop_drag_slice(before, volume, ang_crop_corner_faces(number), from, to);
}

ang_crop_box ang_crop_drag(const ang_crop_box *before, const ang_volume *volume, unsigned faces,
                           const ang_pane_map *map, double dx, double dy) {
    ang_crop_box box = *before;
    for (int i = 0; i < ANG_CROP_CORNERS; i++)
        if (faces == ang_crop_corner_faces(i)) return drag_corner(before, volume, i, map, dx, dy);
    for (int face = 0; face < ANG_CROP_FACES; face++) {
        double x, y;
        ang_vec3 middle = ang_crop_face_middle(before, volume, face);
        if (!(faces >> face & 1) || !ang_pane_map_point(map, middle, &x, &y)) continue;
        double steps = ang_pane_map_drag(map, middle, ang_mat4_column(&volume->affine, face / 2), x + dx, y + dy);
        ang_crop_face_move(&box, volume, face, ang_crop_face_at(before, face) + steps);
    }
    return box;
}
