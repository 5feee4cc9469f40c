/* The crop box: its faces, edges and handles, and what becomes of it when one of them is dragged. Its faces lie across
 * the volume's index axes, and are oblique in the patient where those are. Pure. */
#ifndef ANG_UI_CROP_GEOMETRY_H
#define ANG_UI_CROP_GEOMETRY_H

#include "ui/state/document.h"
#include "ui/state/pane_map.h"

/* Faces are numbered 2 * axis, and one more for the upper one of the axis; sets of them are 1 << face. */
enum { ANG_CROP_FACES = 6, ANG_CROP_EDGES = 12, ANG_CROP_CORNERS = 8 };

/* Voxel index space, within ang_volume_box, at least a voxel thick. */
typedef struct ang_crop_box {
    ang_vec3 lower, upper;
} ang_crop_box;

/* The document's; `volume` gives limits and place. */
ang_crop_box ang_crop_box_of(const ang_document *document);
void ang_crop_box_set(ang_document *document, const ang_crop_box *box);
bool ang_crop_box_whole(const ang_crop_box *box, const ang_volume *volume);

/* Index along its axis at which a face lies; and moved to one, as far as the volume and a voxel's thickness allow. */
double ang_crop_face_at(const ang_crop_box *box, int face);
void ang_crop_face_move(ang_crop_box *box, const ang_volume *volume, int face, double index);

/* LPS mm: the middle of a face, where its handle is. */
ang_vec3 ang_crop_face_middle(const ang_crop_box *box, const ang_volume *volume, int face);
/* Whether the eye sees a face from outside. */
bool ang_crop_face_seen(const ang_crop_box *box, const ang_volume *volume, int face, const ang_pane_map *map);

/* A corner, bit `axis` of its number set for the upper end of that axis: LPS mm, and the set of the faces that meet in
 * it. */
ang_vec3 ang_crop_corner(const ang_crop_box *box, const ang_volume *volume, int corner);
unsigned ang_crop_corner_faces(int corner);
/* Whether the eye sees one of them from outside. */
bool ang_crop_corner_seen(const ang_crop_box *box, const ang_volume *volume, int corner, const ang_pane_map *map);

typedef struct ang_crop_edge {
    ang_vec3 ends[2]; /* LPS mm */
    int faces[2];     /* that meet in it */
} ang_crop_edge;
ang_crop_edge ang_crop_edge_of(const ang_crop_box *box, const ang_volume *volume, int edge);

/* A side of the polygon in which a plane cuts the box. */
typedef struct ang_crop_side {
    ang_vec3 ends[2]; /* LPS mm */
    int face;
} ang_crop_side;
/* For the plane dot(normal, p) = offset_mm; how many there are: 0 where it misses the box, else 3 to 6. A plane in a
 * face cuts the box there. */
int ang_crop_outline(const ang_crop_box *box, const ang_volume *volume, ang_vec3 normal, double offset_mm,
                     ang_crop_side sides[ANG_CROP_FACES]);

/* The set of faces whose handle is at (x, y), at most `radius` pixels away: the nearest middle of a face, among those
 * as near one that is seen; else the nearest corner that is seen; 0: none. */
unsigned ang_crop_pick(const ang_crop_box *box, const ang_volume *volume, const ang_pane_map *map, double x, double y,
                       double radius);
/* The same for the sides in a slice pane: one, or two where they meet. */
unsigned ang_crop_pick_side(const ang_crop_side *sides, int count, const ang_pane_map *map, double x, double y,
                            double radius);

/* The box when the hand has taken `faces` of `before` and gone from one place of the pane to another. In a slice pane
 * faces go with the place under the pointer. In the 3D pane the handle of one face goes along its axis, and a corner,
 * which takes three, across the line of sight. */
ang_crop_box ang_crop_drag_slice(const ang_crop_box *before, const ang_volume *volume, unsigned faces, ang_vec3 from_mm,
                                 ang_vec3 to_mm);
ang_crop_box ang_crop_drag(const ang_crop_box *before, const ang_volume *volume, unsigned faces,
                           const ang_pane_map *map, double dx, double dy);

#endif
