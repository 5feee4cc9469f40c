/* One scene = one picture: camera, clip box, mode, shading, transfer function and size (DESIGN.md, "Scene
 * conventions"). */
#ifndef ANG_SCENE_SCENE_H
#define ANG_SCENE_SCENE_H

#include "core/base/error.h"
#include "core/math/linear_form.h"
#include "core/transfer/transfer.h"
#include "core/volume/volume.h"

typedef enum ang_mode { ANG_MODE_DVR, ANG_MODE_MIP, ANG_MODE_MINIP, ANG_MODE_MEAN, ANG_MODE_ISO } ang_mode;
typedef enum ang_shading { ANG_SHADING_NONE, ANG_SHADING_PHONG } ang_shading;
typedef enum ang_projection { ANG_PERSPECTIVE, ANG_PARALLEL } ang_projection;

/* Names as on the command line; NULL or -1 where there is no such value. */
const char *ang_mode_name(ang_mode mode);
int ang_mode_from_name(const char *name);
const char *ang_shading_name(ang_shading shading);
int ang_shading_from_name(const char *name);
const char *ang_projection_name(ang_projection projection);
int ang_projection_from_name(const char *name);

/* Headlight, two-sided: light and eye lie against the ray. shaded = colour * (ambient + diffuse |n.d|) + specular
 * |n.d|^power; the result is mix(colour, shaded, w) with w = g^2 / (g^2 + g0^2), g the gradient's length. */
typedef struct ang_phong {
    double ambient, diffuse, specular; /* 0..1; default 0.3, 0.6, 0.3 */
    double power;                      /* default 20 */
    double g0;                         /* HU/mm; default 1 */
} ang_phong;
extern const ang_phong ang_phong_default;

/* Positions in LPS mm. */
typedef struct ang_camera {
    ang_vec3 eye;
    ang_vec3 forward, right, up; /* orthonormal */
    ang_projection projection;
    double fov_deg;     /* perspective: vertical field of view, 0 < fov < 180 */
    double half_height; /* parallel: mm from the centre of the picture to its top */
    double near_mm;     /* rays start at this depth along `forward` */
    double focus_mm;    /* depth of the box's centre along `forward`: where annotations measure */
} ang_camera;

/* Parameters of a standard camera on a volume. */
typedef struct ang_view {
    double azimuth_deg;   /* 0 in front of the patient, +90 at the patient's left */
    double elevation_deg; /* lifts the camera; -90..90 */
    double roll_deg;      /* turns the camera clockwise about the line of sight, the picture counter-clockwise */
    double zoom;          /* > 0; default 1 */
    ang_projection projection;
    double fov_deg;   /* default 30 */
    double pan_mm[2]; /* moves the camera to the right and up, and so the picture the other way; default 0, 0 */
} ang_view;
extern const ang_view ang_view_default;
/* "anterior", "left", ... or "AZ,EL[,ROLL]" in degrees into azimuth, elevation and roll. False with ANG_USAGE. */
bool ang_view_parse(const char *text, ang_view *view, ang_error *err);
/* The camera of DESIGN.md for this view of this volume. */
ang_camera ang_camera_for(const ang_volume *volume, const ang_view *view);

/* Turns the camera about the volume as a trackball under the hand would: by `right_deg` about the picture's vertical
 * (what is in front moves to the right) and by `down_deg` about its horizontal (what is in front moves down). Angles
 * come out in (-180, 180], elevation in [-90, 90]. Pure. */
void ang_view_turn(ang_view *view, double right_deg, double down_deg);

typedef struct ang_objects ang_objects; /* core/scene/objects.h */

/* Which pixels of a larger picture are drawn: its columns first_x + i * stride and rows first_y + j * stride. */
typedef struct ang_sampling {
    int stride;           /* pixels, >= 1; default 0: the picture is drawn as a whole and the rest means nothing */
    int first_x, first_y; /* pixels from the larger picture's left top */
    int width, height;    /* pixels: the larger picture's size */
} ang_sampling;

/* A half-space that the picture does without: what lies at dot(normal, p) > offset_mm is cut away. */
typedef struct ang_clip_plane {
    ang_vec3 normal;  /* unit, LPS; zero: there is no plane */
    double offset_mm; /* along the normal from the origin of LPS */
} ang_clip_plane;

/* Everything that decides what the picture shows. Borrows `transfer` and `objects`. */
typedef struct ang_scene {
    int width, height; /* pixels that are drawn */
    ang_sampling sampling;
    ang_camera camera;
    ang_vec3 clip_lower, clip_upper; /* voxel index space; within ang_volume_box */
    ang_clip_plane clip_plane;       /* none by default */
    ang_mode mode;
    ang_shading shading;
    ang_phong phong;
    double iso_hu;
    double window_centre, window_width; /* HU */
    const ang_transfer *transfer;
    const ang_objects *objects; /* opaque geometry; NULL: none */
    double background[4];       /* r, g, b, a in 0..1, not premultiplied; default 0,0,0,1 */
} ang_scene;
/* 512x512, anterior, whole box, dvr, no shading, window 400/40 (width/centre), no transfer function, black background.
 */
ang_scene ang_scene_default(const ang_volume *volume);
/* Whether the scene can be drawn: dvr and iso need a transfer function, iso a finite value, and the size must be
 * positive. False with ANG_USAGE. Every method asks this first. */
bool ang_scene_check(const ang_scene *scene, ang_error *err);
/* The scene whose pixel (i, j) is the scene's pixel (first_x + i * stride, first_y + j * stride): the same ray through
 * the same centre, whatever the method, and slicing's planes are the same. As many pixels as there are; a stride below
 * 1 counts as 1, a first pixel outside the picture leaves none, which ang_scene_check refuses. Subsets of subsets are
 * subsets. Pure. */
ang_scene ang_scene_subset(const ang_scene *scene, int stride, int first_x, int first_y);
/* "x0,x1,y0,y1,z0,z1" in mm from the first voxel, or each with % of the box. Refused with ANG_USAGE where empty or not
 * numbers; limited to the box. */
bool ang_scene_clip_parse(const char *text, const ang_volume *volume, ang_scene *scene, ang_error *err);
/* "NX,NY,NZ,OFFSET_MM" in LPS; the normal may have any length, the plane gets a unit one, and the offset is along that.
 * Refused with ANG_USAGE where these are not four finite numbers or the normal is zero. */
bool ang_clip_plane_parse(const char *text, ang_clip_plane *plane, ang_error *err);
/* Whether there is one. */
static inline bool ang_clip_plane_given(const ang_clip_plane *plane) { return ang_vec3_length(plane->normal) > 0; }
/* Grey 0..1 of a HU value under the scene's window, linear (DICOM PS3.3 C.11.2.1.3.2 LINEAR_EXACT). */
double ang_scene_grey(const ang_scene *scene, double hu);

/* The rays of a picture in index space, well conditioned: a pixel's ray passes the point
 *   p(x, y) = origin + x step_x + y step_y      (x, y in pixels from the left top corner; pixel centres at +0.5)
 * of a plane near the box, relative to the box's centre; its direction is p - eye (perspective) or `axis` (parallel).
 * All ray parameters t are in mm along the ray, 0 at p. Everything exists in index space (about the box's centre) and
 * in mm. */
typedef struct ang_ray_frame {
    ang_vec3 centre;                                           /* the box's centre, voxel index */
    ang_vec3 origin, step_x, step_y, eye, axis;                /* index space, about `centre`; axis per mm */
    ang_vec3 origin_mm, step_x_mm, step_y_mm, eye_mm, axis_mm; /* mm LPS, about the box's centre; axis unit */
    bool perspective;
    double near_depth;        /* mm from the plane of p along the axis to the near plane (negative: towards the eye) */
    ang_vec3 lower, upper;    /* the clip box, index space about `centre` */
    ang_linear_form beyond;   /* mm beyond the clip plane, of a place in index space about `centre`: what is positive is
                                 cut away; zero where nothing of the clip box is */
    bool cuts;                /* whether something of the clip box is; to less than 1e-9 of its diagonal nothing */
    ang_mat4 to_mm, to_index; /* the affine and its inverse */
} ang_ray_frame;
/* False with ANG_GEOMETRY where the affine is singular. */
bool ang_ray_frame_make(const ang_volume *volume, const ang_scene *scene, ang_ray_frame *frame, ang_error *err);

typedef struct ang_ray {
    ang_vec3 origin;       /* index space about the box's centre, at t = 0 */
    ang_vec3 direction;    /* index units per mm */
    ang_vec3 direction_mm; /* unit, LPS */
    double enter, leave; /* mm; in what the clip plane leaves of the clip box and beyond the near plane for enter < t <
                            leave; none where enter >= leave */
} ang_ray;
/* The ray through picture coordinates (x, y); pixel (i, j) has x = i + 0.5, y = j + 0.5, j from the top. */
ang_ray ang_ray_through(const ang_ray_frame *frame, double x, double y);

#endif
