/* The polygons of slicing on the GL side. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_SLICE_GEOMETRY_H
#define ANG_RENDER_SLICE_GEOMETRY_H

#include "core/plan/boxes.h"
#include "core/proxy/proxy.h"
#include "core/render/context.h"
#include "core/render/program.h"
#include "core/scene/clip_space.h"

/* How the polygons are to be made. */
typedef struct ang_slice_order {
    ang_proxy proxy;
    bool back_to_front;
    int group;           /* planes that share a polygon */
    ang_vec3 margin;     /* index units that a ray moves from one plane to the next, at most */
    double most_samples; /* a draw takes no more than about this many, so that it can be interrupted or followed by a
                            pass that finishes pixels */
    /* Whether two boxes lie in one texture. */
    bool (*same_texture)(const void *context, const ang_slice_box *a, const ang_slice_box *b);
    const void *context;
} ang_slice_order;

/* Groups of planes of one box: an instance of the vertex program, or what the CPU cuts at a time. */
typedef struct ang_slice_stretch {
    size_t box;     /* of the list of boxes */
    int begin, end; /* groups */
} ang_slice_stretch;

/* What one draw call takes, all of boxes in one texture. */
typedef struct ang_slice_draw {
    ang_slice_block block; /* of the first of its boxes: which texture */
    size_t begin, end;     /* stretches */
    int groups;            /* of the stretch that has the most */
    bool faces;     /* a box is so near to a face of the clip box that a sample may be the first or last of its ray */
    double samples; /* estimate: fragments */
    uint64_t polygons;
    int first, count; /* instances, or vertices where the CPU cuts the polygons: once they are in the buffer */
} ang_slice_draw;

/* Zero-initialise; owns its GL objects. */
typedef struct ang_slice_geometry {
    unsigned corners, indices;            /* static: the six points of each plane, and the triangles between them */
    unsigned boxes, polygons;             /* instances; vertices cut on the CPU */
    unsigned box_vertices, poly_vertices; /* vertex arrays */
    ang_slice_stretch *stretch;
    size_t stretches, stretch_capacity;
    ang_slice_draw *draw; /* in the order in which they blend */
    size_t draws, draw_capacity;
    size_t filled_begin, filled_end; /* the draws that are in the buffer */
    ang_proxy_tables tables;
    bool tables_made;
    /* of the frame; borrowed until the next one */
    const ang_slice_boxes *list;
    const ang_slice_planes *planes;
    const ang_ray_frame *frame;
    const ang_slice_order *order;
} ang_slice_geometry;

/* Lists the draws for these boxes; all four are borrowed until the last of them is drawn. Boxes are widened by `pad` so
 * that rounding never loses a pixel at their rims; the fragments decide what is theirs. False with ANG_LIMIT. */
bool ang_slice_geometry_make(ang_slice_geometry *geometry, const ang_slice_boxes *boxes, const ang_slice_planes *planes,
                             const ang_ray_frame *frame, const ang_slice_order *order, ang_error *err);
void ang_slice_geometry_destroy(ang_slice_geometry *geometry);

/* slice_planes.glsl for groups of 1, 2 or 4 planes. */
void ang_slice_planes_parts(int group, ang_shader_source *source);
/* The vertex shader's parts of this proxy, and the uniforms of a program with them. */
void ang_slice_geometry_parts(ang_proxy proxy, int group, ang_shader_source *vertex);
void ang_slice_geometry_uniforms(const ang_slice_geometry *geometry, unsigned program, const ang_slice_planes *planes,
                                 const ang_ray_frame *frame, const ang_clip_space *space, const ang_slice_order *order);

/* Draws one of the draws with the program in use. The buffers hold some tens of megabytes at most: what lies beyond is
 * filled in, and where the CPU cuts the polygons cut, when its turn comes. False with ANG_LIMIT or ANG_GL. */
bool ang_slice_geometry_draw(ang_slice_geometry *geometry, ang_gl *gl, size_t draw, ang_error *err);
/* The twelve edges of every block that boxes are parts of, as lines, with a program of edge.glsl in use. False with
 * ANG_LIMIT. */
bool ang_slice_geometry_draw_edges(const ang_slice_boxes *boxes, const ang_octree *octree, const ang_ray_frame *frame,
                                   ang_error *err);

#endif
