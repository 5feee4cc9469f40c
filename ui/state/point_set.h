/* Several points of a transfer function at once: which are chosen, and moving, deleting and colouring them together.
 * Pure: no window. */
#ifndef ANG_UI_POINT_SET_H
#define ANG_UI_POINT_SET_H

#include "ui/state/document.h"

/* Chosen points of a document, by index. Zero-initialise: none. */
typedef struct ang_point_set {
    bool has[ANG_DOCUMENT_POINTS];
} ang_point_set;

/* How high an editor draws an opacity, both 0..1: opacities are mostly small, and the square root gives them room. */
double ang_height_of_opacity(double opacity);
double ang_opacity_of_height(double height);

int ang_point_set_count(const ang_point_set *set, const ang_document *document);
/* The first one; -1: none. */
int ang_point_set_first(const ang_point_set *set, const ang_document *document);
void ang_point_set_only(ang_point_set *set, int index); /* -1: none */
void ang_point_set_all(ang_point_set *set, const ang_document *document);
/* Adds those between two values and two heights, the ends included and in any order. */
void ang_point_set_add_box(ang_point_set *set, const ang_document *document, const double hu[2],
                           const double height[2]);

/* By how much points move: each by the same, in HU and either in opacity or in height. */
typedef struct ang_point_shift {
    double hu, opacity, height;
} ang_point_shift;

/* Puts the chosen points of `from` moved by `shift` into `document`, which has the same points otherwise. All move
 * by the same, so that their shape stays: by as much as lets none pass a point that is not chosen, leave the range of
 * HU or leave opacities of 0..1. */
void ang_points_move(ang_document *document, const ang_document *from, const ang_point_set *set, ang_point_shift shift);
/* The chosen ones, but never the last point of all; empties the set. */
void ang_points_delete(ang_document *document, ang_point_set *set);
void ang_points_colour(ang_document *document, const ang_point_set *set, const double colour[3]);

#endif
