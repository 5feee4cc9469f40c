#include "core/render/slice_geometry.h"

#include "core/base/memory.h"
#include "core/render/pixel_pad.h"
#include "core/render/program.h"
#include "core/render/scene_parts.h"

#include <glad/gl.h>
#include <shaders.h>
#include <stdlib.h>
#include <string.h>

enum {
    POINTS = 6,          /* of a polygon: Rezk-Salama & Kolb, section 4 */
    FAN_INDICES = 12,    /* four triangles */
    STRETCH_GROUPS = 64, /* groups of planes of a stretch; boxes with more are several stretches */
    DRAW_POLYGONS = 16384,
    BUFFER_ITEMS = 1 << 18 /* instances or vertices in a buffer; a draw may go beyond */
};

typedef struct instance {
    float lower[3], upper[3], owner_lower[3], owner_upper[3];
    int32_t first, count;
} instance;

typedef struct vertex {
    float place[3];
    int32_t group;
    float owner_lower[3], owner_upper[3];
} vertex;

/* What grows while a buffer is filled. */
typedef struct filling {
    const ang_slice_geometry *geometry;
    ang_pixel_pad pad;
    char *items; /* instances or vertices */
    size_t count, capacity, size;
    ang_error *err;
} filling;

static void make_static(ang_slice_geometry *geometry) {
    uint8_t corners[STRETCH_GROUPS * POINTS][2];
    uint16_t indices[STRETCH_GROUPS * FAN_INDICES];
    for (int group = 0; group < STRETCH_GROUPS; group++) {
        for (int point = 0; point < POINTS; point++) {
            corners[group * POINTS + point][0] = (uint8_t)point;
            corners[group * POINTS + point][1] = (uint8_t)group;
        }
        for (int i = 0; i < FAN_INDICES; i++) {
            static const int fan[FAN_INDICES] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5};
            indices[group * FAN_INDICES + i] = (uint16_t)(group * POINTS + fan[i]);
        }
    }
    glGenVertexArrays(1, &geometry->box_vertices);
    glBindVertexArray(geometry->box_vertices);
    glGenBuffers(1, &geometry->corners);
    glBindBuffer(GL_ARRAY_BUFFER, geometry->corners);
    glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribIPointer(0, 2, GL_UNSIGNED_BYTE, 2, NULL);
    glGenBuffers(1, &geometry->indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, geometry->indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof indices, indices, GL_STATIC_DRAW);
}

static void float_attribute(GLuint index, GLsizei stride, size_t offset, GLuint divisor) {
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, stride, (const void *)offset);
    glVertexAttribDivisor(index, divisor);
}

static void int_attribute(GLuint index, GLint count, GLsizei stride, size_t offset, GLuint divisor) {
    glEnableVertexAttribArray(index);
    glVertexAttribIPointer(index, count, GL_INT, stride, (const void *)offset);
    glVertexAttribDivisor(index, divisor);
}

static void make_arrays(ang_slice_geometry *geometry) {
    make_static(geometry);
    glGenBuffers(1, &geometry->boxes);
    glBindBuffer(GL_ARRAY_BUFFER, geometry->boxes);
    float_attribute(1, sizeof(instance), offsetof(instance, lower), 1);
    float_attribute(2, sizeof(instance), offsetof(instance, upper), 1);
    float_attribute(3, sizeof(instance), offsetof(instance, owner_lower), 1);
    float_attribute(4, sizeof(instance), offsetof(instance, owner_upper), 1);
    int_attribute(5, 2, sizeof(instance), offsetof(instance, first), 1);

    glGenVertexArrays(1, &geometry->poly_vertices);
    glBindVertexArray(geometry->poly_vertices);
    glGenBuffers(1, &geometry->polygons);
    glBindBuffer(GL_ARRAY_BUFFER, geometry->polygons);
    float_attribute(0, sizeof(vertex), offsetof(vertex, place), 0);
    int_attribute(1, 1, sizeof(vertex), offsetof(vertex, group), 0);
    float_attribute(2, sizeof(vertex), offsetof(vertex, owner_lower), 0);
    float_attribute(3, sizeof(vertex), offsetof(vertex, owner_upper), 0);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

/* Room for `more` items beyond `count`; NULL with ANG_LIMIT. */
static void *room(void *items, size_t size, size_t count, size_t more, size_t *capacity, ang_error *err) {
    if (count + more <= *capacity) return items;
    size_t wanted = *capacity ? 2 * *capacity : 1024;
    while (wanted < count + more) wanted *= 2;
    void *grown = realloc(items, wanted * size);
    if (!grown) {
        ang_fail(err, ANG_LIMIT, "no memory for the polygons of the slices; use a larger --step or fewer --bricks");
        return NULL;
    }
    *capacity = wanted;
    return grown;
}

static void *add_items(filling *f, size_t more) {
    char *items = room(f->items, f->size, f->count, more, &f->capacity, f->err);
    if (!items) return NULL;
    f->items = items;
    f->count += more;
    return f->items + (f->count - more) * f->size;
}

/* The samples that a box owns, in float: within the clip box, whose upper faces belong to it. */
static void store_owner(const ang_ray_frame *frame, const ang_slice_box *box, float lower[3], float upper[3]) {
    for (int axis = 0; axis < 3; axis++) {
        float clip_lower = (float)ang_vec3_at(frame->lower, axis), clip_upper = (float)ang_vec3_at(frame->upper, axis);
        float from = (float)ang_vec3_at(box->owner_lower, axis), to = (float)ang_vec3_at(box->owner_upper, axis);
        lower[axis] = fmaxf(from, clip_lower);
        upper[axis] = to > clip_upper ? nextafterf(clip_upper, INFINITY) : to;
    }
}

static void store(float out[3], ang_vec3 v) {
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

/* Stretches of 5 to 8 groups share draws, of 9 to 16, ...: fewer vertices are wasted than draws are saved. */
static int size_class(int groups) {
    int size = 4;
    while (size < groups) size *= 2;
    return size;
}

/* The draw to which the next stretch of this box belongs: the last one, or a new one. */
static ang_slice_draw *open_draw(ang_slice_geometry *g, const ang_slice_box *box, const ang_slice_box *before,
                                 int groups, bool faces, ang_error *err) {
    ang_slice_draw *last = g->draws ? &g->draw[g->draws - 1] : NULL;
    if (last && last->faces == faces && last->samples < g->order->most_samples && last->polygons < DRAW_POLYGONS &&
        size_class(last->groups) == size_class(groups) &&
        (before == box || g->order->same_texture(g->order->context, before, box)))
        return last;
    ang_slice_draw *draw = room(g->draw, sizeof *g->draw, g->draws, 1, &g->draw_capacity, err);
    if (!draw) return NULL;
    g->draw = draw;
    draw += g->draws++;
    *draw = (ang_slice_draw){.block = box->block, .begin = g->stretches, .faces = faces};
    return draw;
}

static bool add_box(ang_slice_geometry *g, const ang_slice_box *box, const ang_slice_box *before, ang_error *err) {
    const ang_slice_order *order = g->order;
    int group = order->group, first = box->begin / group, groups = ang_slice_groups(box->begin, box->end, group);
    int last = (g->planes->count - 1) / group;
    /* A stretch is one draw's at least: in large pictures it must be short. */
    double fit = order->most_samples / fmax(box->samples / groups, 1);
    int length = (int)fmin(fmax(fit, 1), STRETCH_GROUPS), stretches = (groups + length - 1) / length;
    for (int i = 0; i < stretches; i++) {
        int stretch = order->back_to_front ? stretches - 1 - i : i;
        int begin = first + stretch * length;
        int end = begin + length < first + groups ? begin + length : first + groups;
        /* The first and the last plane have a neighbour on one side only. */
        bool faces = box->faces || begin == 0 || end > last;
        ang_slice_draw *draw = open_draw(g, box, i > 0 ? box : before, end - begin, faces, err);
        ang_slice_stretch *list = room(g->stretch, sizeof *list, g->stretches, 1, &g->stretch_capacity, err);
        if (!draw || !list) return false;
        g->stretch = list;
        g->stretch[g->stretches++] = (ang_slice_stretch){(size_t)(box - g->list->box), begin, end};
        draw->end = g->stretches;
        if (end - begin > draw->groups) draw->groups = end - begin;
        draw->samples += box->samples * (end - begin) / groups;
        draw->polygons += (uint64_t)(end - begin);
    }
    return true;
}

bool ang_slice_geometry_make(ang_slice_geometry *geometry, const ang_slice_boxes *boxes, const ang_slice_planes *planes,
                             const ang_ray_frame *frame, const ang_slice_order *order, ang_error *err) {
    if (!geometry->tables_made) {
        ang_proxy_tables_make(&geometry->tables);
        make_arrays(geometry);
        geometry->tables_made = true;
    }
    geometry->list = boxes;
    geometry->planes = planes;
    geometry->frame = frame;
    geometry->order = order;
    geometry->draws = geometry->stretches = geometry->filled_begin = geometry->filled_end = 0;
    const ang_slice_box *before = NULL;
    for (size_t i = 0; i < boxes->count; i++) {
        const ang_slice_box *box = &boxes->box[order->back_to_front ? boxes->count - 1 - i : i];
        if (!add_box(geometry, box, before ? before : box, err)) return false;
        before = box;
    }
    return true;
}

/* Index units by which a polygon in the middle of its group must reach beyond the box to cover its other planes. */
static ang_vec3 widening(const ang_slice_order *order) {
    return ang_vec3_scale(order->margin, 0.5 * (order->group - 1));
}

/* mm, at a depth from the plane of p. */
static double pad_at(const ang_pixel_pad *pad, double depth) {
    return pad->pixel + pad->rounding + pad->growth * depth;
}

static bool add_instance(filling *f, const ang_slice_stretch *stretch) {
    const ang_slice_box *box = &f->geometry->list->box[stretch->box];
    instance *out = add_items(f, 1);
    if (!out) return false;
    store(out->lower, box->lower);
    store(out->upper, box->upper);
    store_owner(f->geometry->frame, box, out->owner_lower, out->owner_upper);
    out->first = stretch->begin;
    out->count = stretch->end - stretch->begin;
    return true;
}

/* The polygons of a stretch, cut here. */
static bool add_polygons(filling *f, const ang_slice_stretch *stretch) {
    const ang_slice_geometry *g = f->geometry;
    const ang_slice_box *box = &g->list->box[stretch->box];
    const ang_slice_planes *planes = g->planes;
    double least, greatest;
    ang_slice_depths(planes, box->lower, box->upper, &least, &greatest);
    double pad = fmax(pad_at(&f->pad, least), pad_at(&f->pad, greatest));
    ang_vec3 wider = ang_vec3_scale(f->pad.index, pad);
    wider = ang_vec3_add(wider, widening(g->order));
    ang_slicer slicer;
    ang_slicer_make(&slicer, ang_vec3_sub(box->lower, wider), ang_vec3_add(box->upper, wider), planes->gradient);
    float owner_lower[3], owner_upper[3];
    store_owner(g->frame, box, owner_lower, owner_upper);
    for (int i = stretch->begin; i < stretch->end; i++) {
        int group = g->order->back_to_front ? stretch->end - 1 - (i - stretch->begin) : i;
        ang_vec3 triangles[ANG_PROXY_MOST_TRIANGLES][3];
        double middle = group * g->order->group + 0.5 * (g->order->group - 1);
        double depth = planes->first + middle * planes->distance - planes->offset;
        int count = ang_proxy_slice(&g->tables, g->order->proxy, &slicer, depth, triangles);
        if (count == 0) continue;
        vertex *out = add_items(f, 3 * (size_t)count);
        if (!out) return false;
        for (int v = 0; v < 3 * count; v++) {
            store(out[v].place, triangles[v / 3][v % 3]);
            out[v].group = group;
            memcpy(out[v].owner_lower, owner_lower, sizeof owner_lower);
            memcpy(out[v].owner_upper, owner_upper, sizeof owner_upper);
        }
    }
    return true;
}

/* Fills the buffer with draw `first` and as many after it as there is room for. */
static bool fill(ang_slice_geometry *g, ang_gl *gl, size_t first, ang_error *err) {
    bool instanced = g->order->proxy == ANG_PROXY_VERTEX_PROGRAM, ok = true;
    filling f = {.geometry = g,
                 .pad = ang_pixel_pad_make(g->frame),
                 .size = instanced ? sizeof(instance) : sizeof(vertex),
                 .err = err};
    size_t draw = first;
    for (; draw < g->draws && f.count < BUFFER_ITEMS && ok; draw++) {
        ang_slice_draw *now = &g->draw[draw];
        now->first = (int)f.count;
        for (size_t i = now->begin; i < now->end && ok; i++)
            ok = instanced ? add_instance(&f, &g->stretch[i]) : add_polygons(&f, &g->stretch[i]);
        now->count = (int)f.count - now->first;
    }
    if (ok) {
        glBindBuffer(GL_ARRAY_BUFFER, instanced ? g->boxes : g->polygons);
        glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(f.count * f.size), f.items, GL_STREAM_DRAW);
        glBindBuffer(GL_ARRAY_BUFFER, 0);
        g->filled_begin = first;
        g->filled_end = draw;
        ok = ang_gl_check(gl, err);
    }
    free(f.items);
    return ok;
}

bool ang_slice_geometry_draw(ang_slice_geometry *geometry, ang_gl *gl, size_t which, ang_error *err) {
    bool there = which >= geometry->filled_begin && which < geometry->filled_end;
    if (!there && !fill(geometry, gl, which, err)) return false;
    const ang_slice_draw *draw = &geometry->draw[which];
    if (geometry->order->proxy == ANG_PROXY_VERTEX_PROGRAM) {
        glBindVertexArray(geometry->box_vertices);
        glDrawElementsInstancedBaseInstance(GL_TRIANGLES, FAN_INDICES * draw->groups, GL_UNSIGNED_SHORT, NULL,
                                            draw->count, (GLuint)draw->first);
    } else {
        glBindVertexArray(geometry->poly_vertices);
        glDrawArrays(GL_TRIANGLES, draw->first, draw->count);
    }
    glBindVertexArray(0);
    return true;
}

void ang_slice_geometry_destroy(ang_slice_geometry *geometry) {
    GLuint buffers[] = {geometry->corners, geometry->indices, geometry->boxes, geometry->polygons};
    GLuint arrays[] = {geometry->box_vertices, geometry->poly_vertices};
    glDeleteBuffers(4, buffers);
    glDeleteVertexArrays(2, arrays);
    free(geometry->stretch);
    free(geometry->draw);
    *geometry = (ang_slice_geometry){0};
}

void ang_slice_planes_parts(int group, ang_shader_source *source) {
    if (group == 4)
        ANG_SHADER_ADD(source, slice_group_4);
    else if (group == 2)
        ANG_SHADER_ADD(source, slice_group_2);
    else
        ANG_SHADER_ADD(source, slice_group_1);
    ANG_SHADER_ADD(source, slice_planes);
}

void ang_slice_geometry_parts(ang_proxy proxy, int group, ang_shader_source *vertex) {
    ang_slice_planes_parts(group, vertex);
    ANG_SHADER_ADD(vertex, slice_project);
    if (proxy == ANG_PROXY_VERTEX_PROGRAM)
        ANG_SHADER_ADD(vertex, slice_box);
    else
        ANG_SHADER_ADD(vertex, slice_polygon);
}

void ang_slice_geometry_uniforms(const ang_slice_geometry *geometry, unsigned program, const ang_slice_planes *planes,
                                 const ang_ray_frame *frame, const ang_clip_space *space,
                                 const ang_slice_order *order) {
    ang_pixel_pad pad = ang_pixel_pad_make(frame);
    ang_uniforms_clip_space(program, space);
    ang_uniform_vec4(program, "slice_gradient", planes->gradient, planes->offset);
    int front = 0;
    for (int axis = 0; axis < 3; axis++) front |= ang_vec3_at(planes->gradient, axis) < 0 ? 1 << axis : 0;
    ang_uniform_int(program, "slice_front", front);
    ang_uniform_vec3(program, "slice_pad_index", pad.index);
    glProgramUniform2f(program, glGetUniformLocation(program, "slice_pad"), (float)pad_at(&pad, 0), (float)pad.growth);
    ang_uniform_vec3(program, "slice_widen", widening(order));
    ang_uniform_int(program, "slice_reverse", order->back_to_front);
    ang_uniform_ints(program, "vertex_sequence", &geometry->tables.sequence[0][0], 64);
    ang_uniform_ints(program, "edge_from", geometry->tables.v1, 24);
    ang_uniform_ints(program, "edge_to", geometry->tables.v2, 24);
}

bool ang_slice_geometry_draw_edges(const ang_slice_boxes *boxes, const ang_octree *octree, const ang_ray_frame *frame,
                                   ang_error *err) {
    float *corners = ang_alloc(boxes->blocks, 6 * sizeof *corners, "edges of boxes", err);
    if (!corners) return false;
    size_t blocks = 0;
    for (size_t i = 0; i < boxes->count; i++) {
        const ang_slice_box *box = &boxes->box[i];
        ang_vec3 lower, upper;
        bool again = i > 0 && ang_slice_same_block(box, box - 1);
        if (again || !ang_slice_block_bounds(octree, frame, &box->block, &lower, &upper)) continue;
        store(corners + 6 * blocks, lower);
        store(corners + 6 * blocks++ + 3, upper);
    }
    GLuint array, buffer;
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(blocks * 6 * sizeof *corners), corners, GL_STREAM_DRAW);
    float_attribute(0, 6 * sizeof *corners, 0, 1);
    float_attribute(1, 6 * sizeof *corners, 3 * sizeof *corners, 1);
    glDrawArraysInstanced(GL_LINES, 0, 24, (GLsizei)blocks);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glDeleteBuffers(1, &buffer);
    glDeleteVertexArrays(1, &array);
    free(corners);
    return true;
}
