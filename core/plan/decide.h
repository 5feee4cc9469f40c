/* Which parts of the drawing of a picture are used and which are left out, and why: one pure function from facts. What
 * draws obeys it; nothing here needs OpenGL. */
#ifndef ANG_PLAN_DECIDE_H
#define ANG_PLAN_DECIDE_H

#include "core/plan/plan.h"
#include "core/scene/scene.h"

/* What can be left out. Each is a bit of --force: forced parts are used although they could be left out, to prove that
 * the picture is the same without them and to measure what they cost. */
typedef enum ang_part {
    ANG_PART_GRADIENTS,           /* lookups of gradients */
    ANG_PART_EXPONENTIAL,         /* of opacity correction, beside the series for thin samples */
    ANG_PART_COLOUR,              /* lookups of colours */
    ANG_PART_ROUNDING,            /* to whole stored values, for what jumps with the value */
    ANG_PART_TERMINATION,         /* tests and passes that end opaque rays */
    ANG_PART_SKIPPING,            /* of invisible blocks */
    ANG_PART_DESCENT,             /* slicing: of the octree to its leaves */
    ANG_PART_NEAR_PLANE,          /* envelope: rays that start inside it */
    ANG_PART_DIRECTIONS,          /* raycast: directions of rays looked up from a texture */
    ANG_PART_BORDER,              /* border air: samples before the first and behind the last block that shows */
    ANG_PART_SLABS,               /* upload of slabs of the volume that cannot show */
    ANG_PART_CLIP_PLANE,          /* tests of what it cuts away */
    ANG_PART_REDRAW,              /* drawing again what has not changed */
    ANG_PART_GL,                  /* an OpenGL context where the method needs none */
    ANG_FORCIBLE,                 /* the parts below are switched by options of their own */
    ANG_PART_HULL = ANG_FORCIBLE, /* envelope: --skipping, --quads */
    ANG_PART_GRADIENT_TEXTURE,    /* envelope: --gradients */
    ANG_PART_JOINED,              /* raycast: empty space found by main passes, --separate-passes */
    ANG_PARTS
} ang_part;

/* Names as in --force; NULL or -1 where there is none. ang_parts_parse reads a list separated by commas, or "all";
 * false with ANG_USAGE. */
const char *ang_part_name(ang_part part);
int ang_part_from_name(const char *name);
bool ang_parts_parse(const char *list, unsigned *forced, ang_error *err);

/* Where the gradients of Phong shading come from. */
typedef enum ang_gradients { ANG_GRADIENTS_AUTO, ANG_GRADIENTS_LOOKUPS, ANG_GRADIENTS_TEXTURE } ang_gradients;

/* What envelope leaves out of rays: what lies outside the faces, what lies between visible blocks, or both. */
typedef enum ang_skipping { ANG_SKIP_BOTH, ANG_SKIP_OUTSIDE, ANG_SKIP_BETWEEN } ang_skipping;

/* How a picture is drawn, as far as decisions differ. */
typedef enum ang_drawing {
    ANG_DRAW_REFERENCE,
    ANG_DRAW_LANES, /* rays on the processor */
    ANG_DRAW_WHOLE_RAYS,
    ANG_DRAW_ENVELOPE,
    ANG_DRAW_PASSES,
    ANG_DRAW_SLICES
} ang_drawing;

/* What tells which way to draw a picture that may be drawn in any. */
typedef struct ang_drawing_facts {
    bool gl;          /* there is OpenGL */
    bool fits;        /* the volume does, into one texture and the memory that it may take */
    bool asks_slices; /* options are given that only slicing takes */
    bool asks_passes; /* or only rays in passes */
    bool software;    /* OpenGL runs on the processor */
    bool lanes;       /* the ray caster on the processor can hold the volume */
    bool lanes_do;    /* and takes all options that are given */
} ang_drawing_facts;

/* The way to draw, where neither an error nor a time is asked for; `why` becomes the reason. Pure. */
ang_drawing ang_plan_drawing(const ang_drawing_facts *facts, const char **why);

/* What is known of a picture before it is drawn. Plain value. What takes building to be known may be asked later: while
 * `blocks` is 0 it counts in favour of the part, so that a method first learns what it must build. */
typedef struct ang_plan_facts {
    ang_drawing drawing;
    /* scene */
    ang_mode mode;
    bool phong;    /* shading in mode dvr */
    bool parallel; /* projection */
    double pixels;
    /* transfer function, where the mode looks it up */
    bool jumps;        /* at some value */
    bool one_colour;   /* whatever shows has the same one */
    bool whole_steps;  /* dvr: steps are classified by all values between their ends */
    double extinction; /* the greatest, per mm */
    /* volume and camera */
    double longest_mm;   /* that any ray has in the clip box, at most */
    double sample_mm;    /* that a sample stands for, at most */
    bool ahead;          /* the volume lies before the eye as a whole */
    bool starts_inside;  /* rays may start inside the volume: the near plane reaches into the clip box */
    bool has_clip_plane; /* the scene has one... */
    bool plane_cuts;     /* ... which cuts something of the clip box away */
    double bytes;        /* of the values */
    bool texture_shared; /* every sample reads one texture of the whole volume, of which parts may stay empty */
    /* of what was built; 0: not known yet */
    size_t blocks, shown;  /* that could be skipped, and those of them that show something */
    double share_uploaded; /* of the volume: the box of what shows */
    bool hull_fits;        /* its faces keep to the budget */
    double fragments;      /* slicing: estimate */
    bool all_shows;        /* slicing: the root of the octree says so */
    int apron, most_apron; /* slicing: voxels around a leaf whose values count, and those with which it pays */
    /* OpenGL */
    bool gl, software;                     /* there is any; on the processor */
    bool gradients_fit;                    /* a texture of gradients does */
    bool gradients_refused;                /* there was no memory for one */
    double gradient_bytes, gradient_limit; /* of it; the most that nobody has asked for */
    double memory;                         /* bytes that textures may take; 0: any */
    /* options */
    double termination;
    bool no_skip, manual_filter, separate_passes, same_as_before;
    ang_gradients gradients;
    ang_skipping skipping;
    unsigned forced; /* bits 1 << ang_part */
} ang_plan_facts;

/* One part. `why` is a static string. */
typedef struct ang_decision {
    bool used;
    const char *why; /* it can be left out; NULL where the picture needs it, or where it has no place in this drawing */
    const char *gone; /* what leaving it out spares, in words; NULL where that is not known */
    double share;     /* of what `gone` names, 0..1; NaN: all of it */
} ang_decision;

typedef struct ang_plan_decisions {
    ang_decision part[ANG_PARTS];
} ang_plan_decisions;

/* Fragments of a pixel below which slicing does not look for finished pixels, which costs about four. */
extern const double ang_plan_least_fragments;

/* Pure; thread safe. */
ang_plan_decisions ang_plan_decide(const ang_plan_facts *facts);
static inline bool ang_plan_uses(const ang_plan_decisions *decisions, ang_part part) {
    return decisions->part[part].used;
}

/* Adds what is left out, why, and what that saves to the plan; what is used though it need not be is said as well. */
void ang_plan_explain(const ang_plan_decisions *decisions, ang_plan *plan);
void ang_plan_explain_part(const ang_plan_decisions *decisions, ang_part part, ang_plan *plan);

#endif
