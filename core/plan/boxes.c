#include "core/plan/boxes.h"

#include "core/base/memory.h"

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
    double more; /* in samples: what those cost more that may be cut by the clip plane */
    size_t leaves;
} cost;

/* A sample that may be the first or the last of its ray costs as much more: measured on llvmpipe in mode mean. */
static const double cut_costs = 0.6;

static double weigh(const traversal *t, const cost *c) {
    return c->polygons * t->cut->polygon_cost + c->samples + c->more;
}

static void add_cost(cost *sum, const cost *more) {
    sum->polygons += more->polygons;
    sum->samples += more->samples;
    sum->more += more->more;
    sum->leaves += more->leaves;
}

static void set(ang_vec3 *v, int axis, double value) {
    if (axis == 0)
        v->x = value;
    else if (axis == 1)
        v->y = value;
    else
        v->z = value;
}

static double start_of(const ang_octree *octree, int axis) { return -0.5 * octree->cells[axis]; }

bool ang_slice_same_block(const ang_slice_box *a, const ang_slice_box *b) {
    return memcmp(&a->block, &b->block, sizeof a->block) == 0;
}

/* The cells [first, end) along each axis. */
static void block_cells(const ang_octree *octree, const ang_slice_block *block, int first[3], int end[3]) {
    int last[3], unused[3];
    for (int axis = 0; axis < 3; axis++) last[axis] = block->first[axis] + block->count[axis] - 1;
    ang_octree_cells(octree, block->level, block->first, first, unused);
    ang_octree_cells(octree, block->level, last, unused, end);
}

bool ang_slice_block_bounds(const ang_octree *octree, const ang_ray_frame *frame, const ang_slice_block *block,
                            ang_vec3 *lower, ang_vec3 *upper) {
    int first[3], end[3];
    block_cells(octree, block, first, end);
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

/* Whether the clip plane cuts all of the box away. */
static bool is_cut_away(const traversal *t, const ang_slice_box *box) {
    return t->frame->cuts && ang_linear_form_least(&t->frame->beyond, box->lower, box->upper) > t->planes->rounding;
}

/* The box of a block; false where nothing of it can be seen. */
static bool bound(const traversal *t, const ang_slice_block *block, ang_slice_box *box) {
    int first[3], end[3];
    *box = (ang_slice_box){.block = *block};
    if (!ang_slice_block_bounds(t->octree, t->frame, block, &box->lower, &box->upper)) return false;
    block_cells(t->octree, block, first, end);
    for (int axis = 0; axis < 3; axis++) {
        bool bottom = first[axis] == 0, top = end[axis] == t->octree->cells[axis];
        set(&box->owner_lower, axis, bottom ? -INFINITY : start_of(t->octree, axis) + first[axis]);
        set(&box->owner_upper, axis, top ? INFINITY : start_of(t->octree, axis) + end[axis]);
    }
    return !is_cut_away(t, box) && find_planes(t, t->planes->distance / 2, box);
}

/* Whether a ray that crosses the box may begin or end at the clip plane within a step. */
static bool is_near_plane(const traversal *t, const ang_slice_box *box) {
    if (!t->frame->cuts) return false;
    ang_vec3 g = t->frame->beyond.gradient, margin = t->cut->margin;
    double step = fabs(g.x) * margin.x + fabs(g.y) * margin.y + fabs(g.z) * margin.z;
    return ang_linear_form_greatest(&t->frame->beyond, box->lower, box->upper) > -step - t->planes->rounding;
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
        if (is_cut_away(t, &part)) continue;
        part.faces = part.faces || is_near_plane(t, &part);
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

static size_t count_leaves(const ang_octree *octree, const ang_slice_block *block) {
    size_t count = 1;
    int first[3], end[3];
    block_cells(octree, block, first, end);
    for (int axis = 0; axis < 3; axis++) {
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

/* A node's children, and their joins: along each axis the lower, the upper, or both. */
enum { LOWER, UPPER, BOTH, CHOICES };

/* What has been chosen for a join: 0 to 2: to cut it in two across that axis, or one of these. */
enum { NOTHING = 3, AS_VISITED, ONE_BOX };

typedef struct join {
    cost cost;
    int choice;
    bool cut;          /* one of its children has been cut into its own: hardly cheaper as one box */
    size_t begin, end; /* AS_VISITED: its boxes among those of the node */
} join;

/* The children of one node. */
typedef struct family {
    join joins[CHOICES][CHOICES][CHOICES]; /* z, y, x */
    int level, node[3];                    /* of the parent */
    bool lower_first[3];
    const ang_slice_box *box; /* what has been visited */
} family;

static join *join_of(family *f, const int which[3]) { return &f->joins[which[2]][which[1]][which[0]]; }

/* The block of a join: of all children the parent itself. False where the octree ends before its upper half, so that it
 * is its lower half. */
static bool block_of(const traversal *t, const family *f, const int which[3], ang_slice_block *block) {
    if (which[0] == BOTH && which[1] == BOTH && which[2] == BOTH) {
        *block = (ang_slice_block){f->level, {f->node[0], f->node[1], f->node[2]}, {1, 1, 1}};
        return true;
    }
    const ang_octree_level *children = &t->octree->level[f->level - 1];
    *block = (ang_slice_block){.level = f->level - 1};
    for (int axis = 0; axis < 3; axis++) {
        block->first[axis] = 2 * f->node[axis] + (which[axis] == UPPER);
        block->count[axis] = which[axis] == BOTH ? 2 : 1;
        if (block->first[axis] + block->count[axis] > children->dims[axis]) return false;
    }
    return true;
}

static cost cost_of(traversal *t, const ang_slice_block *block, const ang_slice_box *box) {
    cost whole = {.samples = estimate_samples(t, box), .leaves = count_leaves(t->octree, block)};
    if (is_near_plane(t, box)) whole.more = cut_costs * whole.samples;
    append_parts(t, box, true, &whole.polygons);
    return whole;
}

/* Chooses the cheapest for a join of two or more children, whose parts have been chosen. */
static void choose(traversal *t, family *f, const int which[3]) {
    join *here = join_of(f, which);
    *here = (join){.choice = NOTHING};
    bool all = true;
    for (int axis = 0; axis < 3; axis++) {
        all = all && which[axis] == BOTH;
        if (which[axis] != BOTH) continue;
        int half[3] = {which[0], which[1], which[2]};
        half[axis] = LOWER;
        const join *a = join_of(f, half);
        half[axis] = UPPER;
        const join *b = join_of(f, half);
        cost sum = a->cost;
        add_cost(&sum, &b->cost);
        if (a->choice == NOTHING && b->choice == NOTHING) return;
        if (here->choice == NOTHING || weigh(t, &sum) < weigh(t, &here->cost))
            *here = (join){.cost = sum, .choice = axis, .cut = a->cut || b->cut};
    }
    ang_slice_block block;
    ang_slice_box box;
    if ((here->cut && !all) || !block_of(t, f, which, &block) || !bound(t, &block, &box)) return;
    cost whole = cost_of(t, &block, &box);
    if (weigh(t, &whole) <= weigh(t, &here->cost)) *here = (join){.cost = whole, .choice = ONE_BOX};
}

/* Adds what has been chosen, front to back. */
static void emit(traversal *t, family *f, const int which[3]) {
    const join *here = join_of(f, which);
    ang_slice_block block;
    ang_slice_box box;
    double unused;
    if (t->failed || here->choice == NOTHING) return;
    if (here->choice == ONE_BOX) {
        if (block_of(t, f, which, &block) && bound(t, &block, &box) && !append_parts(t, &box, false, &unused))
            t->failed = true;
    } else if (here->choice == AS_VISITED) {
        for (size_t i = here->begin; i < here->end && !t->failed; i++) t->failed = !append(t, &f->box[i]);
    } else {
        int axis = here->choice, half[3] = {which[0], which[1], which[2]};
        half[axis] = f->lower_first[axis] ? LOWER : UPPER;
        emit(t, f, half);
        half[axis] = f->lower_first[axis] ? UPPER : LOWER;
        emit(t, f, half);
    }
}

static join visit(traversal *t, int level, const int node[3]);

/* Visits the children of a node in the order of view: adds their boxes, and returns what all cost. */
static cost visit_children(traversal *t, family *f) {
    cost sum = {0};
    int flip = 0;
    for (int axis = 0; axis < 3; axis++) flip |= f->lower_first[axis] ? 0 : 1 << axis;
    for (int i = 0; i < 8 && !t->failed; i++) {
        int which[3] = {(i ^ flip) & 1, (i ^ flip) >> 1 & 1, (i ^ flip) >> 2 & 1};
        ang_slice_block child;
        join *here = join_of(f, which);
        *here = (join){.choice = NOTHING};
        if (!block_of(t, f, which, &child)) continue;
        size_t begin = t->boxes->count;
        *here = visit(t, child.level, child.first);
        here->begin = begin;
        here->end = t->boxes->count;
        add_cost(&sum, &here->cost);
    }
    return sum;
}

/* Replaces what has been added since `before` by the cheapest joins. */
static join join_children(traversal *t, family *f, size_t before) {
    for (int i = 0; i < CHOICES * CHOICES * CHOICES; i++) {
        int which[3] = {i % CHOICES, i / CHOICES % CHOICES, i / CHOICES / CHOICES};
        if (which[0] == BOTH || which[1] == BOTH || which[2] == BOTH) choose(t, f, which);
    }
    static const int all[3] = {BOTH, BOTH, BOTH};
    size_t count = t->boxes->count - before;
    ang_slice_box *visited = ang_alloc(count ? count : 1, sizeof *visited, "boxes to slice", t->err);
    if (!visited) {
        t->failed = true;
        return (join){0};
    }
    memcpy(visited, t->boxes->box + before, count * sizeof *visited);
    for (int i = 0; i < 8; i++) {
        join *here = join_of(f, (const int[3]){i & 1, i >> 1 & 1, i >> 2 & 1});
        here->begin -= before;
        here->end -= before;
    }
    f->box = visited;
    t->boxes->count = before;
    emit(t, f, all);
    free(visited);
    join chosen = *join_of(f, all);
    chosen.cut = chosen.choice != ONE_BOX;
    if (chosen.choice != NOTHING) chosen.choice = AS_VISITED;
    return chosen;
}

/* Adds the boxes of a node and returns what they cost: its children's, joined or not, or itself. */
static join visit(traversal *t, int level, const int node[3]) {
    const ang_slice_cut *cut = t->cut;
    const ang_slice_block block = {level, {node[0], node[1], node[2]}, {1, 1, 1}};
    ang_slice_box box;
    if ((cut->visibility && !ang_visibility_of(cut->visibility, range_of(t->octree, level, node))) ||
        !bound(t, &block, &box))
        return (join){.choice = NOTHING};
    bool may_join = !cut->to_leaves && level <= cut->top_level;
    bool all = !cut->visibility || ang_visibility_of_all(cut->visibility, range_of(t->octree, level, node));
    /* What the clip plane crosses may have parts that it leaves whole, and others of which it leaves nothing. */
    all = all && !is_near_plane(t, &box);
    if (level == 0 || (may_join && all)) {
        join whole = {.cost = cost_of(t, &block, &box), .choice = AS_VISITED};
        double unused;
        if (!append_parts(t, &box, false, &unused)) t->failed = true;
        return whole;
    }
    family f = {.level = level, .node = {node[0], node[1], node[2]}};
    for (int axis = 0; axis < 3; axis++) f.lower_first[axis] = lower_first(t, level, node, axis);
    size_t before = t->boxes->count;
    cost children = visit_children(t, &f);
    if (t->failed || !may_join) return (join){.cost = children, .choice = AS_VISITED, .cut = true};
    return join_children(t, &f, before);
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
    if (planes->count > 0) all = visit(&t, octree->levels - 1, (const int[3]){0, 0, 0}).cost;
    boxes->leaves_drawn = all.leaves;
    boxes->polygons = all.polygons;
    boxes->samples = all.samples;
    boxes->blocks = 0;
    for (size_t i = 0; i < boxes->count; i++)
        boxes->blocks += i == 0 || !ang_slice_same_block(&boxes->box[i], &boxes->box[i - 1]);
    return !t.failed;
}

void ang_slice_boxes_clear(ang_slice_boxes *boxes) {
    free(boxes->box);
    *boxes = (ang_slice_boxes){0};
}
