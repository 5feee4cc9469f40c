#include "core/plan/boxes.h"

#include <stdlib.h>
#include <string.h>

typedef struct traversal {
    ang_slice_boxes *boxes;
    const ang_octree *octree;
    const ang_ray_frame *frame;
    const ang_slice_planes *planes;
    const ang_clip_space *space;
    const ang_slice_cut *cut;
    double cell_samples; /* samples in one cell at the plane of p */
    ang_error *err;
    bool failed;
} traversal;

/* What a part of the tree costs to draw, and what it holds. */
typedef struct cost {
    double polygons, samples;
    size_t leaves;
} cost;

static double weigh(const traversal *t, const cost *c) { return c->polygons * t->cut->polygon_cost + c->samples; }

static void set(ang_vec3 *v, int axis, double value) {
    if (axis == 0)
        v->x = value;
    else if (axis == 1)
        v->y = value;
    else
        v->z = value;
}

static double start_of(const ang_octree *octree, int axis) { return -0.5 * octree->cells[axis]; }

bool ang_slice_node_bounds(const ang_octree *octree, const ang_ray_frame *frame, int level, const int node[3],
                           ang_vec3 *lower, ang_vec3 *upper) {
    int first[3], end[3];
    ang_octree_cells(octree, level, node, first, end);
    for (int axis = 0; axis < 3; axis++) {
        /* The clip box as the fragments see it: a face may fall on a seam by rounding. */
        double from = fmax(start_of(octree, axis) + first[axis], (float)ang_vec3_at(frame->lower, axis));
        double to = fmin(start_of(octree, axis) + end[axis], (float)ang_vec3_at(frame->upper, axis));
        if (!(from <= to)) return false;
        set(lower, axis, from);
        set(upper, axis, to);
    }
    return true;
}

/* Fills the planes of a box, within `reach` mm of its depths; false where nothing of it can be seen. */
static bool find_planes(const traversal *t, double reach, ang_slice_box *box) {
    double least, greatest;
    ang_slice_depths(t->planes, box->lower, box->upper, &least, &greatest);
    ang_slice_range(t->planes, least - reach, greatest + reach, &box->begin, &box->end);
    return box->begin < box->end && !ang_clip_space_outside(t->space, box->lower, box->upper);
}

/* The box of a node; false where nothing of it can be seen. */
static bool bound(const traversal *t, int level, const int node[3], ang_slice_box *box) {
    int first[3], end[3];
    *box = (ang_slice_box){.level = level, .node = {node[0], node[1], node[2]}};
    if (!ang_slice_node_bounds(t->octree, t->frame, level, node, &box->lower, &box->upper)) return false;
    ang_octree_cells(t->octree, level, node, first, end);
    for (int axis = 0; axis < 3; axis++) {
        bool bottom = first[axis] == 0, top = end[axis] == t->octree->cells[axis];
        set(&box->owner_lower, axis, bottom ? -INFINITY : start_of(t->octree, axis) + first[axis]);
        set(&box->owner_upper, axis, top ? INFINITY : start_of(t->octree, axis) + end[axis]);
    }
    return find_planes(t, t->planes->distance / 2, box);
}

/* Samples lie a step apart in depth and a pixel apart across, and pixels grow with the depth. */
static double estimate_samples(const traversal *t, const ang_slice_box *box) {
    ang_vec3 size = ang_vec3_sub(box->upper, box->lower);
    double cells = size.x * size.y * size.z, growth = 1;
    if (t->frame->perspective) {
        ang_vec3 middle = ang_vec3_scale(ang_vec3_add(box->lower, box->upper), 0.5);
        double depth = ang_vec3_dot(t->space->w.gradient, middle) + t->space->w.constant;
        double reference = ang_vec3_dot(ang_vec3_sub(t->frame->origin_mm, t->frame->eye_mm), t->frame->axis_mm);
        growth = reference / fmax(depth, 0.05 * reference);
    }
    return cells * t->cell_samples * growth * growth;
}

static bool append(traversal *t, const ang_slice_box *box) {
    ang_slice_boxes *boxes = t->boxes;
    if (boxes->count == boxes->capacity) {
        size_t wanted = boxes->capacity ? 2 * boxes->capacity : 1024;
        ang_slice_box *grown = realloc(boxes->box, wanted * sizeof *grown);
        if (!grown) return ang_fail(t->err, ANG_LIMIT, "no memory for %zu boxes to slice", wanted);
        boxes->box = grown;
        boxes->capacity = wanted;
    }
    boxes->box[boxes->count++] = *box;
    return true;
}

/* A stretch of a box along one axis. */
typedef struct stretch {
    double lower, upper, owner_lower, owner_upper;
    double from_eye; /* how far along the axis it begins from the eye; grows front to back */
    bool faces;
} stretch;

static int nearer(const void *left, const void *right) {
    double a = ((const stretch *)left)->from_eye, b = ((const stretch *)right)->from_eye;
    return (a > b) - (a < b);
}

static double distance_from_eye(const traversal *t, int axis, const stretch *s) {
    if (!t->frame->perspective) return ang_vec3_at(t->frame->axis, axis) >= 0 ? s->lower : -s->lower;
    double eye = ang_vec3_at(t->frame->eye, axis);
    return fmax(fmax(s->lower - eye, eye - s->upper), 0);
}

/* Cuts a box along one axis where the margins of the clip box end, front to back; returns how many stretches there are.
 */
static int cut_axis(const traversal *t, const ang_slice_box *box, int axis, stretch out[3]) {
    double lower = ang_vec3_at(box->lower, axis), upper = ang_vec3_at(box->upper, axis);
    double margin = ang_vec3_at(t->cut->margin, axis);
    double low = ang_vec3_at(t->frame->lower, axis) + margin, high = ang_vec3_at(t->frame->upper, axis) - margin;
    double cuts[4] = {lower, fmin(fmax(low, lower), upper), fmin(fmax(high, lower), upper), upper};
    if (low >= high) cuts[1] = cuts[2] = upper; /* all of it is margin */
    int count = 0;
    for (int i = 0; i < 3; i++) {
        bool whole = lower == upper && i == 0;
        if (!(cuts[i] < cuts[i + 1]) && !whole) continue;
        stretch *s = &out[count++];
        *s = (stretch){cuts[i], cuts[i + 1], cuts[i], cuts[i + 1], 0, i != 1};
        if (whole) s->upper = s->owner_upper = upper;
        s->from_eye = distance_from_eye(t, axis, s);
    }
    out[0].owner_lower = ang_vec3_at(box->owner_lower, axis);
    out[count - 1].owner_upper = ang_vec3_at(box->owner_upper, axis);
    qsort(out, (size_t)count, sizeof *out, nearer);
    return count;
}

/* Adds a box, cut at the margins, front to back; `polygons` becomes what its parts take. Nothing is added where
 * `counting`. */
static bool append_parts(traversal *t, const ang_slice_box *box, bool counting, double *polygons) {
    stretch stretches[3][3];
    int counts[3];
    *polygons = 0;
    for (int axis = 0; axis < 3; axis++) counts[axis] = cut_axis(t, box, axis, stretches[axis]);
    int parts = counts[0] * counts[1] * counts[2];
    for (int i = 0; i < parts; i++) {
        int index[3] = {i % counts[0], i / counts[0] % counts[1], i / counts[0] / counts[1]};
        ang_slice_box part = *box;
        part.faces = false;
        for (int axis = 0; axis < 3; axis++) {
            const stretch *s = &stretches[axis][index[axis]];
            set(&part.lower, axis, s->lower);
            set(&part.upper, axis, s->upper);
            set(&part.owner_lower, axis, s->owner_lower);
            set(&part.owner_upper, axis, s->owner_upper);
            part.faces = part.faces || s->faces;
        }
        part.samples = estimate_samples(t, &part);
        if (part.faces) {
            /* A ray's one sample may lie half a step off its plane. */
            part.lower = ang_vec3_along(part.lower, t->cut->margin, -0.5);
            part.upper = ang_vec3_along(part.upper, t->cut->margin, 0.5);
        }
        if (!find_planes(t, 0, &part)) continue;
        *polygons += ang_slice_groups(part.begin, part.end, t->cut->group);
        if (!counting && !append(t, &part)) return false;
    }
    return true;
}

static ang_minmax range_of(const ang_octree *octree, int level, const int node[3]) {
    const ang_octree_level *l = &octree->level[level];
    return l->nodes[(size_t)node[0] + (size_t)l->dims[0] * ((size_t)node[1] + (size_t)l->dims[1] * (size_t)node[2])];
}

/* Leaves below a node. */
static size_t count_leaves(const ang_octree *octree, int level, const int node[3]) {
    size_t count = 1;
    for (int axis = 0; axis < 3; axis++) {
        int first[3], end[3];
        ang_octree_cells(octree, level, node, first, end);
        count *= (size_t)((end[axis] - first[axis] + octree->leaf[axis] - 1) / octree->leaf[axis]);
    }
    return count;
}

/* Whether the lower of the two children along `axis` is nearer to the eye. In parallel projection that is the same
 * everywhere; in perspective it depends on the eye's side of the plane between them. */
static bool lower_first(const traversal *t, int level, const int node[3], int axis) {
    if (!t->frame->perspective) return ang_vec3_at(t->frame->axis, axis) >= 0;
    double side = (double)t->octree->leaf[axis] * (double)((int64_t)1 << (level - 1));
    double between = start_of(t->octree, axis) + (2.0 * node[axis] + 1) * side;
    return ang_vec3_at(t->frame->eye, axis) < between;
}

static cost visit(traversal *t, int level, const int node[3]);

static cost visit_children(traversal *t, int level, const int node[3]) {
    cost sum = {0};
    int flip = 0;
    for (int axis = 0; axis < 3; axis++) flip |= lower_first(t, level, node, axis) ? 0 : 1 << axis;
    for (int i = 0; i < 8 && !t->failed; i++) {
        int child[3];
        bool exists = true;
        for (int axis = 0; axis < 3; axis++) {
            child[axis] = 2 * node[axis] + ((i ^ flip) >> axis & 1);
            exists = exists && child[axis] < t->octree->level[level - 1].dims[axis];
        }
        if (!exists) continue;
        cost part = visit(t, level - 1, child);
        sum.polygons += part.polygons;
        sum.samples += part.samples;
        sum.leaves += part.leaves;
    }
    return sum;
}

/* Adds the boxes of a node and returns what they cost: its children's, or itself where that is cheaper. */
static cost visit(traversal *t, int level, const int node[3]) {
    const ang_slice_cut *cut = t->cut;
    if (cut->visibility && !ang_visibility_of(cut->visibility, range_of(t->octree, level, node))) return (cost){0};
    ang_slice_box box;
    if (!bound(t, level, node, &box)) return (cost){0};
    cost whole = {0, estimate_samples(t, &box), count_leaves(t->octree, level, node)};
    append_parts(t, &box, true, &whole.polygons);
    bool may_stop = level == 0 || (!cut->to_leaves && level <= cut->top_level);
    bool all = !cut->visibility || ang_visibility_of_all(cut->visibility, range_of(t->octree, level, node));
    if (level > 0 && !(may_stop && all)) {
        size_t before = t->boxes->count;
        cost parts = visit_children(t, level, node);
        if (!may_stop || weigh(t, &parts) < weigh(t, &whole)) return parts;
        t->boxes->count = before;
    }
    if (!append_parts(t, &box, false, &whole.polygons)) t->failed = true;
    return whole;
}

static bool same_node(const ang_slice_box *a, const ang_slice_box *b) {
    return a->level == b->level && memcmp(a->node, b->node, sizeof a->node) == 0;
}

bool ang_slice_boxes_make(ang_slice_boxes *boxes, const ang_octree *octree, const ang_ray_frame *frame,
                          const ang_slice_planes *planes, const ang_clip_space *space, const ang_slice_cut *cut,
                          ang_error *err) {
    traversal t = {
        .boxes = boxes, .octree = octree, .frame = frame, .planes = planes, .space = space, .cut = cut, .err = err};
    double pixel_mm2 = ang_vec3_length(frame->step_x_mm) * ang_vec3_length(frame->step_y_mm);
    t.cell_samples = fabs(ang_mat4_determinant(&frame->to_mm)) / (pixel_mm2 * fmax(planes->distance, 1e-300));
    boxes->count = 0;
    const ang_octree_level *leaves = &octree->level[0];
    boxes->leaves_total = (size_t)leaves->dims[0] * (size_t)leaves->dims[1] * (size_t)leaves->dims[2];
    cost all = {0};
    if (planes->count > 0) all = visit(&t, octree->levels - 1, (const int[3]){0, 0, 0});
    boxes->leaves_drawn = all.leaves;
    boxes->polygons = all.polygons;
    boxes->samples = all.samples;
    boxes->nodes = 0;
    for (size_t i = 0; i < boxes->count; i++) boxes->nodes += i == 0 || !same_node(&boxes->box[i], &boxes->box[i - 1]);
    return !t.failed;
}

void ang_slice_boxes_clear(ang_slice_boxes *boxes) {
    free(boxes->box);
    *boxes = (ang_slice_boxes){0};
}
