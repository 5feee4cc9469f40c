/* What the cases of the battery share: small volumes, a scene on a stage, and where measured values go. Only files of
 * core/selfcheck/ include it. */
#ifndef ANG_SELFCHECK_BENCH_H
#define ANG_SELFCHECK_BENCH_H

#include "core/selfcheck/selfcheck.h"

#include <math.h>

/* One run of one case. */
struct ang_bench {
    ang_gl *gl;               /* NULL: without OpenGL */
    const ang_method *method; /* NULL: the case needs none */
    int threads;
    const ang_progress *progress;
    ang_measure worst;
};

/* Notes a value that should lie in [low, high]; the words say which it is. */
void ang_bench_range(ang_bench *bench, double value, double low, double high, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
/* Notes an error that may be at most `tolerance`. */
#define ang_bench_error(bench, error, tolerance, ...) ang_bench_range(bench, error, 0, tolerance, __VA_ARGS__)

/* A volume with HU = stored - 1024 and the voxels hu(x, y, z); NULL with ANG_LIMIT. Free with ang_volume_free. */
typedef double ang_bench_field(int x, int y, int z);
ang_volume *ang_bench_volume(int nx, int ny, int nz, const double spacing[3], ang_bench_field *hu, ang_error *err);
/* 100 HU everywhere; 10 HU a voxel along y. */
ang_bench_field ang_field_flat, ang_field_ramp, ang_field_sparse;
/* Sparse structures, a third of it invisible to ang_stage_vessels, on a sheared anisotropic grid. */
ang_volume *ang_bench_sheared(ang_error *err);

extern const double ang_bench_unit[3];   /* spacing of 1 mm */
extern const double ang_bench_colour[3]; /* of homogeneous media */
enum { ANG_BENCH_WIDTH = 31, ANG_BENCH_HEIGHT = 24 };

/* A volume, the method's renderer of it, and the scene to draw. Zero-initialise; owns all of it. */
typedef struct ang_stage {
    ang_bench *bench;
    ang_volume *volume;
    ang_renderer *renderer;
    ang_transfer *transfer;
    ang_scene scene;            /* at first dvr, unshaded, anterior in parallel projection */
    ang_render_options options; /* the default, but rays do not end early */
    ang_image image;            /* the picture drawn last */
    ang_frame_stats stats;      /* of it */
} ang_stage;

/* Takes `volume` over; where that is NULL `err` says why. To be closed after failure too. */
bool ang_stage_open(ang_stage *stage, ang_bench *bench, ang_volume *volume, ang_error *err);
void ang_stage_close(ang_stage *stage);
/* Sets the transfer function: points per mm or of opacity per mm; a homogeneous medium of ang_bench_colour; one that
 * shows the structures of ang_bench_sheared. */
bool ang_stage_points(ang_stage *stage, const ang_transfer_point *points, size_t count, bool by_extinction,
                      ang_error *err);
bool ang_stage_medium(ang_stage *stage, double extinction, ang_error *err);
bool ang_stage_vessels(ang_stage *stage, ang_error *err);
/* A standard camera: `view` as on the command line. */
void ang_stage_look(ang_stage *stage, const char *view, ang_projection projection);
/* Draws the scene and notes values that are not numbers or negative. */
bool ang_stage_draw(ang_stage *stage, ang_error *err);
/* Draws and moves the picture to `image`, which the caller clears. */
bool ang_stage_keep(ang_stage *stage, ang_image *image, ang_error *err);
/* Draws under other options and returns the greatest difference of a channel to `image`. */
bool ang_stage_change(ang_stage *stage, const ang_image *image, double *change, ang_error *err);

static inline int ang_stage_pixels(const ang_stage *stage) { return stage->scene.width * stage->scene.height; }
/* Millimetres of a pixel's ray in the clip box. */
double ang_stage_length(const ang_stage *stage, double x, double y);
/* The greatest error of opacity and colour for a homogeneous medium. */
double ang_stage_homogeneous(const ang_stage *stage);
/* The greatest difference of a channel over all pixels to one colour, where rays meet the box. */
double ang_stage_constant(const ang_stage *stage, const double rgba[4]);
double ang_image_difference(const ang_image *a, const ang_image *b);

/* Error of the stage's picture. */
typedef double ang_stage_error(const ang_stage *stage, const void *context);
/* Draws at each of the steps (voxels) and notes the order at which the error falls between the first and the last,
 * which should lie in [low, high]. What is exact to `exact` at the first step already has no order: a method without
 * steps must be. */
bool ang_stage_order(ang_stage *stage, const double *steps, int count, ang_stage_error *error, const void *context,
                     double low, double high, double exact, const char *what, ang_error *err);

#endif
