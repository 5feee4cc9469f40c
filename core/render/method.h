/* What every rendering method is: one interface, so that programs, tests and reports go over all of them alike. */
#ifndef ANG_RENDER_METHOD_H
#define ANG_RENDER_METHOD_H

#include "core/base/progress.h"
#include "core/plan/classification.h"
#include "core/plan/decide.h"
#include "core/proxy/proxy.h"
#include "core/scene/image.h"
#include "core/scene/scene.h"

#include <stdint.h>

/* How a picture is made, as far as it does not change what it shows. */
typedef struct ang_render_options {
    double step_voxels; /* sampling distance as a multiple of the smallest spacing; default 0.5 */
    double termination; /* stop a ray at this accumulated opacity, 0 < a <= 1; 1: never; default 0.999 */
    bool manual_filter; /* interpolate by eight fetches instead of the texture unit, to verify filtering; default false
                         */
    bool no_skip;       /* draw what is invisible too; default false */
    ang_proxy proxy;    /* slicing: how polygons are cut; default the vertex program */
    int bricks[3];  /* slicing: bricks along each axis, all visible ones drawn; 0: octree leaves, drawn where it pays */
    int pass_steps; /* slicing: planes that a fragment composites before it blends, 1, 2 or 4; raycast: samples of a
                       ray in a pass, 1..64; default 0: as many as pay */
    bool separate_passes; /* raycast: passes of their own find empty space, as in the paper; default false: main passes
                             do */
    bool show_bricks;     /* slicing: draw the edges of the boxes onto the picture; default false */
    size_t gpu_memory;    /* bytes of textures that the volume may take; default 0: what OpenGL gives */
    ang_gradients gradients;     /* envelope: where Phong's come from; default: as it pays */
    ang_skipping skipping;       /* envelope; default both */
    int quads;                   /* envelope: most faces; default 0: as many as pay */
    bool count_shown;            /* singlepass, envelope in mode dvr without shading by lookups: count only samples that
                                    show, the fewest that any method could take; default false */
    unsigned forced;             /* bits 1 << ang_part: used although the plan would leave them out; default 0 */
    int threads;                 /* 0: all */
    ang_classify classification; /* dvr: of a step by its middle or by all values between its ends; default: as the data
                                    need it */
} ang_render_options;
extern const ang_render_options ang_render_options_default;

/* What one frame did. */
typedef struct ang_frame_stats {
    float *counts;    /* set by the caller: room for the samples of each pixel, width * height; NULL: not wanted */
    uint64_t samples; /* field evaluations along rays, shading left out; slicing an iso-surface: those that were hits */
    uint64_t fragments; /* rays shaded; slicing: fragments, those that hold no sample included; 0: not known */
    double step_mm;     /* sampling distance used, greater than asked for where the method has a limit; 0: exact */
    uint64_t bricks_drawn,
        bricks_total;            /* the smallest blocks that can be skipped, and those of them drawn; 1 without any */
    uint64_t boxes;              /* slicing: what those drawn are joined to */
    uint64_t polygons;           /* slicing: polygons sent to OpenGL */
    int passes;                  /* times that the picture's pixels were gone over */
    ang_classify classification; /* dvr: what was taken; else auto */
    uint64_t bricks_uploaded;    /* textures filled for this frame */
    double octree_ms, upload_ms; /* part of the frame's time that went into these */
    const char *note;            /* a sentence for the user, or NULL; valid until the renderer\'s next call */
} ang_frame_stats;

/* Which of the options a method takes; step_voxels and threads go without saying. */
typedef enum ang_method_takes {
    ANG_TAKES_TERMINATION = 1,
    ANG_TAKES_MANUAL_FILTER = 2,
    ANG_TAKES_NO_SKIP = 4,
    ANG_TAKES_PROXY = 8,
    ANG_TAKES_BRICKS = 16,
    ANG_TAKES_PASS_STEPS = 32,
    ANG_TAKES_SHOW_BRICKS = 64,
    ANG_TAKES_GPU_MEMORY = 128,
    ANG_TAKES_GRADIENTS = 256,
    ANG_TAKES_ENVELOPE = 512, /* skipping and quads */
    ANG_TAKES_SEPARATE_PASSES = 1024,
    ANG_TAKES_COUNT_SHOWN = 2048,
    ANG_TAKES_CLASSIFICATION = 4096
} ang_method_takes;

typedef struct ang_gl ang_gl;             /* core/render/context.h */
typedef struct ang_renderer ang_renderer; /* opaque, one per method and volume */

/* A method. All functions of one renderer are called from one thread, for GL methods the one where the context is
 * current. */
typedef struct ang_method {
    const char *name;   /* as in --method */
    const char *title;  /* one line */
    const char *source; /* paper */
    bool needs_gl;
    bool exact;           /* takes no steps: neither the step nor an error estimate means anything to it */
    unsigned takes;       /* ang_method_takes */
    double coarsest_step; /* voxels: a greater one gives the same picture; 0: there is none */
    bool splits; /* a subset of a picture (ang_scene_subset) is its pixels to the bit and takes but their share of its
                    time */
    /* A renderer of this volume, which must outlive it; `gl` is NULL where needs_gl is false. Of `options`, gpu_memory
     * holds for the renderer's life. NULL with ANG_GL, ANG_LIMIT. */
    ang_renderer *(*create)(ang_gl *gl, const ang_volume *volume, const ang_render_options *options, ang_error *err);
    /* Renders into `image` (created by the caller with the scene's size). False with ANG_USAGE (ang_scene_check),
     * ANG_GEOMETRY, ANG_LIMIT, ANG_GL, or ANG_INTERRUPTED where `progress` asked for it. `stats` may be NULL. */
    bool (*render)(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_image *image,
                   ang_frame_stats *stats, const ang_progress *progress, ang_error *err);
    /* Adds to `plan` what drawing this scene takes and what is left out and why, as `render` would do it. False as
     * `render`. */
    bool (*explain)(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options, ang_plan *plan,
                    ang_error *err);
    void (*destroy)(ang_renderer *renderer);
} ang_method;

/* The options that differ from the default but that `method` does not take, as a set of ang_method_takes. */
unsigned ang_method_ignores(const ang_method *method, const ang_render_options *options);

/* All methods, NULL at the end; and the one of a name or NULL. */
const ang_method *const *ang_methods(void);
const ang_method *ang_method_find(const char *name);

/* The method for --method auto: cpu where there is no OpenGL or it is software, as long as its options ask
 * for nothing else; slicing where the volume does not fit into one texture or the
 * budget; slicing or raycast where an option asks for them; else envelope, which takes the fewest samples. `why`
 * becomes the reason. */
const ang_method *ang_method_choose(ang_gl *gl, const ang_volume *volume, const ang_scene *scene,
                                    const ang_render_options *options, const char **why);
/* The same before there is a context, where no GPU answers: NULL where OpenGL in software is wanted. */
const ang_method *ang_method_choose_without_gl(const ang_volume *volume, const ang_render_options *options,
                                               const char **why);

extern const ang_method ang_method_cpu;
extern const ang_method ang_method_adaptive;
extern const ang_method ang_method_reference;
extern const ang_method ang_method_singlepass;
extern const ang_method ang_method_slicing;
extern const ang_method ang_method_envelope;
extern const ang_method ang_method_raycast;

#endif
