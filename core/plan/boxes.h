/* The boxes that slicing draws: an octree's visible nodes in the order of view (Rezk-Salama & Kolb 2005, section 6). */
#ifndef ANG_PLAN_BOXES_H
#define ANG_PLAN_BOXES_H

#include "core/plan/planes.h"
#include "core/plan/visibility.h"
#include "core/scene/clip_space.h"
#include "core/volume/octree.h"

/* Nodes of an octree's level that are drawn as one box: one node, or up to eight that share their parent. */
typedef struct ang_slice_block {
    int level, first[3], count[3];
} ang_slice_block;

/* A block, or the part of one that lies near the faces of the clip box or away from them. Index space about the volume
 * box's centre. */
typedef struct ang_slice_box {
    ang_vec3 lower, upper;             /* what the polygons must cover */
    ang_vec3 owner_lower, owner_upper; /* it owns samples from lower up to, not at, upper; at the volume's faces
                                          infinite, so that each sample has exactly one owner */
    ang_slice_block block;
    bool faces; /* within a step of a face of the clip box, of the clip plane or of the last plane: rays may begin and
                   end here */
    int begin, end; /* the planes that meet it */
    double samples; /* estimate */
} ang_slice_box;

typedef struct ang_slice_boxes {
    ang_slice_box *box; /* front to back */
    size_t count, capacity;
    size_t blocks;       /* that the boxes are, or are parts of */
    size_t leaves_total; /* of the octree */
    size_t leaves_drawn; /* leaves inside the boxes */
    double polygons;     /* groups of planes summed over the boxes */
    double samples;      /* estimate of fragments within the picture and out of it */
} ang_slice_boxes;

/* How to choose among the octree's nodes. */
typedef struct ang_slice_cut {
    const ang_visibility *visibility; /* NULL: nothing is left out for its values */
    bool to_leaves;                   /* draw every visible leaf as a box of its own; default false: where it pays */
    int top_level;                    /* boxes are no larger than a node of this level; ANG_OCTREE_MAX_LEVELS: any */
    ang_vec3 margin;                  /* index units that a ray moves from one plane to the next, at most: boxes are cut
                                         this far from the faces of the clip box, so that few samples need what only
                                         those at faces do, and those near them reach half as far again */
    int group;                        /* planes that share a polygon; >= 1 */
    double polygon_cost;              /* what a polygon costs, in fragments: descent stops where boxes would cost more
                                         polygons than they spare fragments (sections 6 and 7) */
} ang_slice_cut;

/* Traverses the tree top-down, children in the order of view, and leaves out what is invisible, outside the clip box,
 * beyond the clip plane or outside the picture. Beyond the paper: where not all eight children are drawn, or not alike,
 * neighbours among them are joined to one box where that costs less. Adds to `boxes` after emptying it; zero-initialise
 * it first, free with ang_slice_boxes_clear. False with ANG_LIMIT. */
bool ang_slice_boxes_make(ang_slice_boxes *boxes, const ang_octree *octree, const ang_ray_frame *frame,
                          const ang_slice_planes *planes, const ang_clip_space *space, const ang_slice_cut *cut,
                          ang_error *err);
/* Whether two boxes are parts of the same block. */
bool ang_slice_same_block(const ang_slice_box *a, const ang_slice_box *b);
/* The part of a block within the clip box; false where there is none. */
bool ang_slice_block_bounds(const ang_octree *octree, const ang_ray_frame *frame, const ang_slice_block *block,
                            ang_vec3 *lower, ang_vec3 *upper);
void ang_slice_boxes_clear(ang_slice_boxes *boxes);

#endif
