/* What raycast's files share; only raycast*.c include it. */
#ifndef ANG_RENDER_RAYCAST_PRIVATE_H
#define ANG_RENDER_RAYCAST_PRIVATE_H

#include "core/render/block_ranges.h"
#include "core/render/ray_pass.h"
#include "core/scene/clip_space.h"

/* The passes of a picture, by the names of Krueger & Westermann 2003, section 2.1. */
typedef enum ang_raycast_pass {
    ANG_RAYCAST_RAYS,    /* passes 1 and 2: where rays enter, and where they lead */
    ANG_RAYCAST_MAIN,    /* a stretch of every ray */
    ANG_RAYCAST_FINISH,  /* intermediate: stopping criterion */
    ANG_RAYCAST_EMPTY,   /* intermediate: empty space */
    ANG_RAYCAST_RESOLVE, /* from what was found to the picture; of surfaces: shading */
    ANG_RAYCAST_PASSES
} ang_raycast_pass;

/* Looks at how many pixels are finished wait for OpenGL: one after so many main passes. */
enum { ANG_RAYCAST_LOOK = 8 };

/* The 2D textures of the rays, and the framebuffer that fills them; its depth is that of the accumulated target. */
typedef struct ang_raycast_paths {
    unsigned framebuffer;
    unsigned entry, direction; /* RGBA32F: TMP and DIR of the paper */
    unsigned wake;             /* R32F: raycast_wake.glsl */
    int width, height;
} ang_raycast_paths;

struct ang_renderer {
    ang_ray_pass pass; /* its target is RES of the paper */
    ang_block_ranges blocks;
    ang_raycast_paths paths;
    ang_target resolved;
    unsigned entered;                    /* query: pixels whose ray meets the box */
    unsigned finished[ANG_RAYCAST_LOOK]; /* queries: pixels that a stopping pass has found */
};

/* All that is decided about one picture before anything is drawn. */
typedef struct ang_raycast {
    const ang_scene *scene;
    const ang_render_options *options;
    ang_ray_frame frame;
    ang_clip_space space;
    ang_visibility visibility;
    ang_vec3 cover_lower, cover_upper; /* the clip box, widened; index about its centre */
    bool covers;                       /* whether the box's faces cover its rays, not the whole picture */
    ang_plan_facts facts;
    ang_plan_decisions plan;
    bool skips, terminates, joined; /* what `plan` says, in short */
    int first[3], end[3];           /* voxels that may be sampled */
    double upload_ms;
    int steps;          /* lookups of a ray in a main pass */
    int passes;         /* main passes for the longest ray */
    char constants[96]; /* a part of the programs */
} ang_raycast;

/* Decides everything and brings tables and blocks up to date: what drawing and explaining share. False as ang_method's
 * `render`. */
bool ang_raycast_decide(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                        ang_raycast *r, ang_error *err);
/* Whether there is anything to find out between main passes, for which they have a depth test. */
static inline bool ang_raycast_tests(const ang_raycast *r) { return r->skips || r->terminates; }
/* Whether this picture has such a pass. */
bool ang_raycast_has(const ang_raycast *r, ang_raycast_pass pass);
/* ang_method's `explain`. */
bool ang_raycast_explain(ang_renderer *renderer, const ang_scene *scene, const ang_render_options *options,
                         ang_plan *plan, ang_error *err);

/* The program of a pass with all uniforms that are the same in all of its draws; 0 with ANG_GL or ANG_LIMIT. */
unsigned ang_raycast_program(ang_renderer *renderer, const ang_raycast *r, ang_raycast_pass pass, bool counting,
                             ang_error *err);
/* Binds the textures that the programs read. */
void ang_raycast_bind(const ang_renderer *renderer, const ang_raycast *r);
/* Adds the pass with its parts and lookups to the plan. */
void ang_raycast_explain_pass(const ang_renderer *renderer, const ang_raycast *r, ang_raycast_pass pass,
                              ang_plan *plan);

#endif
