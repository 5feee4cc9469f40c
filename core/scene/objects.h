/* Opaque geometry in a picture: axes, cut planes, measuring marks. Rays of the volume end at it (Haferburg names this
 * as what his text leaves out); in modes that show a projection of values, which has no depth, it lies over the
 * picture. */
#ifndef ANG_SCENE_OBJECTS_H
#define ANG_SCENE_OBJECTS_H

#include "core/scene/scene.h"

typedef enum ang_object_kind {
    ANG_OBJECT_TUBE, /* a tube with round ends, a ball where both ends are one, lit by the headlight */
    ANG_OBJECT_PLANE /* a plane of voxels of the whole box, showing its values through the scene's window */
} ang_object_kind;

typedef struct ang_object {
    ang_object_kind kind;
    ang_vec3 from, to; /* tube: LPS mm */
    double radius_mm;  /* tube: > 0 */
    double colour[3];  /* tube: 0..1 */
    int axis;          /* plane: index axis that it is perpendicular to */
    double index;      /* plane: voxel index along that axis, within the box */
} ang_object;

/* Words at a place, for who draws text over the picture. */
typedef struct ang_object_label {
    ang_vec3 at; /* LPS mm */
    bool below;  /* a line below that place, which it would hide */
    char text[24];
} ang_object_label;

/* Zero-initialise; owns its lists. */
struct ang_objects {
    ang_object *object;
    size_t count;
    ang_object_label *label;
    size_t label_count;
};

/* The patient's axes through the middle of the box and a little out of it: right-left red, anterior-posterior green,
 * foot-head blue, with the patient's letters at their ends. False with ANG_LIMIT. */
bool ang_objects_add_axes(ang_objects *objects, const ang_volume *volume, ang_error *err);
/* A measuring mark between two points (LPS mm): a tube with balls at its ends, labelled with its length in mm. False
 * with ANG_LIMIT, and ANG_USAGE where a number is not finite. */
bool ang_objects_add_mark(ang_objects *objects, const ang_volume *volume, ang_vec3 from, ang_vec3 to, ang_error *err);
/* "axial", "coronal" or "sagittal", each with :MM (from the first voxel) or :NN% (of the box; 50 % without), separated
 * by commas. The plane lies across the index axis that is nearest to the patient's axis. False with ANG_USAGE,
 * ANG_LIMIT. */
bool ang_objects_add_cut_planes(ang_objects *objects, const ang_volume *volume, const char *text, ang_error *err);
/* Frees what it holds and makes it empty. */
void ang_objects_clear(ang_objects *objects);

/* Whether rays of this scene end at objects: there are some, and the mode has a depth (dvr, iso). */
bool ang_scene_limits_rays(const ang_scene *scene);

/* Where the ray through picture coordinates (x, y) (ang_ray_through) first meets an object beyond the near plane: mm
 * along the ray, and its colour. False where it meets none. Pure, thread safe. */
bool ang_objects_hit(const ang_objects *objects, const ang_volume *volume, const ang_scene *scene,
                     const ang_ray_frame *frame, double x, double y, double *t, double colour[3]);
/* The same for the one object, nearer than *t. */
bool ang_object_hit(const ang_object *object, const ang_volume *volume, const ang_scene *scene,
                    const ang_ray_frame *frame, double x, double y, double *t, double colour[3]);

#endif
