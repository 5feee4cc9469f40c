#include "core/plan/decide.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* By name on the command line, and in words. */
static const struct {
    const char *name, *words, *gone;
} parts[ANG_PARTS] = {
    [ANG_PART_GRADIENTS] = {"gradients", "gradient lookups", "6 of 8 lookups of every sample"},
    [ANG_PART_EXPONENTIAL] = {"exponential", "exponential of opacity correction", "an exponential of every sample"},
    [ANG_PART_COLOUR] = {"colour", "colour lookups", "3 of 4 numbers looked up of every sample"},
    [ANG_PART_ROUNDING] = {"rounding", "rounding to stored values", "a comparison of every sample"},
    [ANG_PART_TERMINATION] = {"termination", "early termination", "its tests and passes"},
    [ANG_PART_SKIPPING] = {"skipping", "skipping of invisible blocks", "a test of every other sample"},
    [ANG_PART_DESCENT] = {"descent", "descent of the octree to its leaves", "most polygons"},
    [ANG_PART_NEAR_PLANE] = {"near-plane", "rays that start inside the envelope", "a comparison of every ray"},
    [ANG_PART_DIRECTIONS] = {"directions", "texture of directions", "1 of 2 lookups of every ray in every pass"},
    [ANG_PART_BORDER] = {"border", "border air", "samples before the first block that shows and behind the last"},
    [ANG_PART_SLABS] = {"slabs", "upload of slabs of the volume", "of the upload"},
    [ANG_PART_CLIP_PLANE] = {"clip-plane", "clip plane", "its intersection with every ray"},
    [ANG_PART_REDRAW] = {"redraw", "drawing again", "the whole picture"},
    [ANG_PART_GL] = {"gl", "OpenGL", "making a context"},
    [ANG_PART_HULL] = {NULL, "envelope of what shows", NULL},
    [ANG_PART_GRADIENT_TEXTURE] = {NULL, "texture of gradients", NULL},
    [ANG_PART_JOINED] = {NULL, "empty space found by the main passes", NULL},
};

const char *ang_part_name(ang_part part) { return part >= 0 && part < ANG_FORCIBLE ? parts[part].name : NULL; }

static int find_name(const char *name, size_t length) {
    for (int part = 0; part < ANG_FORCIBLE; part++)
        if (strlen(parts[part].name) == length && strncmp(parts[part].name, name, length) == 0) return part;
    return -1;
}

int ang_part_from_name(const char *name) { return find_name(name, strlen(name)); }

bool ang_parts_parse(const char *list, unsigned *forced, ang_error *err) {
    *forced = 0;
    if (strcmp(list, "all") == 0) {
        *forced = (1u << ANG_FORCIBLE) - 1;
        return true;
    }
    for (const char *at = list; at; at = strchr(at, ','), at = at ? at + 1 : NULL) {
        size_t length = strcspn(at, ",");
        int part = find_name(at, length);
        if (part >= 0) {
            *forced |= 1u << part;
            continue;
        }
        char names[256] = "";
        for (int i = 0; i < ANG_FORCIBLE; i++)
            snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i ? ", " : "", parts[i].name);
        return ang_fail(err, ANG_USAGE, "--force %s: \"%.*s\" is no part; give \"all\" or some of %s", list,
                        (int)length, at, names);
    }
    return true;
}

ang_drawing ang_plan_drawing(const ang_drawing_facts *facts, const char **why) {
    *why = "there is no OpenGL";
    if (!facts->gl) return facts->lanes ? ANG_DRAW_LANES : ANG_DRAW_REFERENCE;
    *why = "OpenGL is software here, and the processor is faster without it";
    if (facts->software && facts->lanes && facts->lanes_do) return ANG_DRAW_LANES;
    *why = "the volume does not fit into one texture";
    if (!facts->fits) return ANG_DRAW_SLICES;
    *why = "an option asks for slicing";
    if (facts->asks_slices) return ANG_DRAW_SLICES;
    *why = "an option asks for raycast";
    if (facts->asks_passes) return ANG_DRAW_PASSES;
    *why = "it takes the fewest samples: rays skip what shows nothing";
    return ANG_DRAW_ENVELOPE;
}

/* Used, and not to be left out. */
static ang_decision needed(void) { return (ang_decision){.used = true, .share = NAN}; }

/* Left out, whatever is forced: it has no place in this picture, or the user has said so. */
static ang_decision no_place(const char *why) { return (ang_decision){.why = why, .share = NAN}; }

/* Left out, but forced it changes nothing. */
static ang_decision spared(const ang_plan_facts *facts, ang_part part, const char *why) {
    bool forced = part < ANG_FORCIBLE && (facts->forced >> part & 1u);
    return (ang_decision){forced, why, parts[part].gone, NAN};
}

static bool is_surface(const ang_plan_facts *facts) { return facts->mode == ANG_MODE_ISO; }
static bool needs_gl(const ang_plan_facts *facts) {
    return facts->drawing != ANG_DRAW_REFERENCE && facts->drawing != ANG_DRAW_LANES;
}
static bool has_table(const ang_plan_facts *facts) { return facts->mode == ANG_MODE_DVR || is_surface(facts); }

static ang_decision decide_gradients(const ang_plan_facts *facts) {
    if (is_surface(facts) || (facts->mode == ANG_MODE_DVR && facts->phong)) return needed();
    if (facts->mode != ANG_MODE_DVR) return no_place("this mode shows values, not surfaces");
    return spared(facts, ANG_PART_GRADIENTS, "shading is none");
}

/* Below this optical depth the shaders' series is exact to float (opacity_series.glsl), with room for rounding. */
static const double thin = 0.49;

static ang_decision decide_exponential(const ang_plan_facts *facts) {
    if (facts->mode != ANG_MODE_DVR) return no_place("this mode has no opacity");
    if (!(facts->extinction * facts->sample_mm < thin)) return needed();
    return spared(facts, ANG_PART_EXPONENTIAL, "every sample is thin enough for a short series");
}

static ang_decision decide_colour(const ang_plan_facts *facts) {
    if (!has_table(facts)) return no_place("this mode shows values through the window");
    if (is_surface(facts) || !facts->one_colour) return needed();
    return spared(facts, ANG_PART_COLOUR, "all that shows has one colour");
}

static ang_decision decide_rounding(const ang_plan_facts *facts) {
    if (!has_table(facts)) return no_place("nothing jumps with the value");
    if (is_surface(facts) || facts->jumps) return needed();
    return spared(facts, ANG_PART_ROUNDING, "the transfer function has no step");
}

const double ang_plan_least_fragments = 8;

static ang_decision decide_termination(const ang_plan_facts *facts) {
    if (is_surface(facts) && facts->drawing == ANG_DRAW_SLICES)
        return no_place("the depth test itself keeps the nearest hit");
    if (is_surface(facts) && facts->drawing != ANG_DRAW_PASSES) return needed();
    if (!has_table(facts)) return no_place("every sample counts in this mode");
    if (!(facts->termination < 1)) return no_place("rays are not to end early");
    if (is_surface(facts)) return needed();
    /* In one pass it is one more comparison of a loop that ends by another: leaving it out gains nothing. */
    if (facts->drawing == ANG_DRAW_WHOLE_RAYS || facts->drawing == ANG_DRAW_ENVELOPE ||
        facts->drawing == ANG_DRAW_LANES)
        return needed();
    if (-expm1(-facts->extinction * facts->longest_mm) < facts->termination)
        return spared(facts, ANG_PART_TERMINATION, "no ray can reach the threshold");
    if (facts->drawing == ANG_DRAW_SLICES && facts->fragments < ang_plan_least_fragments * facts->pixels)
        return no_place("there are too few fragments to spare any");
    return needed();
}

/* Why blocks that show nothing cannot be left out of this drawing; NULL where they can. */
static const char *why_skip_nothing(const ang_plan_facts *facts) {
    if (facts->drawing == ANG_DRAW_WHOLE_RAYS) return "this method is the baseline and skips nothing";
    if (facts->drawing == ANG_DRAW_REFERENCE) return "this method integrates every cell";
    if (facts->no_skip) return "--no-skip";
    if (facts->mode == ANG_MODE_MEAN) return "every value counts in a mean";
    if (facts->drawing == ANG_DRAW_SLICES && is_surface(facts) && facts->apron > facts->most_apron)
        return "the planes are so far apart that a hit may lie blocks before its plane";
    if (facts->drawing == ANG_DRAW_SLICES && facts->whole_steps && facts->apron > facts->most_apron)
        return "the planes are so far apart that what they show may lie blocks away";
    return NULL;
}

/* Why there is nothing to skip; NULL where there is, or it is not known yet. */
static const char *why_all_shows(const ang_plan_facts *facts) {
    if (facts->drawing == ANG_DRAW_SLICES) return facts->all_shows ? "nothing in the volume is invisible" : NULL;
    return facts->blocks && facts->shown == facts->blocks ? "no block of the volume is invisible" : NULL;
}

static ang_decision decide_skipping(const ang_plan_facts *facts) {
    const char *never = why_skip_nothing(facts), *idle = why_all_shows(facts);
    if (never) return no_place(never);
    if (facts->drawing == ANG_DRAW_ENVELOPE && facts->skipping == ANG_SKIP_OUTSIDE && !idle)
        return no_place("--skipping outside");
    return idle ? spared(facts, ANG_PART_SKIPPING, idle) : needed();
}

static ang_decision decide_hull(const ang_plan_facts *facts) {
    if (facts->drawing != ANG_DRAW_ENVELOPE) return no_place(NULL);
    const char *never = why_skip_nothing(facts), *idle = why_all_shows(facts);
    if (never || idle) return no_place(never ? never : idle);
    if (facts->skipping == ANG_SKIP_BETWEEN) return no_place("--skipping between");
    if (facts->forced >> ANG_PART_BORDER & 1u) return no_place("--force border");
    if (!facts->ahead) return no_place("the eye is in or beside the volume, where faces would be clipped");
    if (!facts->hull_fits) return no_place("its faces would be more than the budget allows");
    return needed();
}

static ang_decision decide_near_plane(const ang_plan_facts *facts, const ang_decision *hull) {
    if (!hull->used) return no_place(NULL);
    if (facts->starts_inside) return needed();
    return spared(facts, ANG_PART_NEAR_PLANE, "the near plane lies before the whole volume");
}

/* Where the blocks are known, what lies before the first that shows and behind the last is. */
static ang_decision decide_border(const ang_plan_facts *facts) {
    if (facts->drawing != ANG_DRAW_ENVELOPE) return no_place(NULL);
    if (why_skip_nothing(facts) || why_all_shows(facts) || facts->skipping == ANG_SKIP_BETWEEN) return needed();
    return spared(facts, ANG_PART_BORDER, "nothing shows there");
}

static ang_decision decide_slabs(const ang_plan_facts *facts, const ang_decision *skipping) {
    if (!needs_gl(facts)) return no_place("nothing is uploaded");
    bool skips = skipping->used && !skipping->why;
    /* A step is classified by the values at its ends, which may lie among what does not show. */
    if (!facts->texture_shared || facts->whole_steps || !skips || !(facts->share_uploaded < 1)) return needed();
    ang_decision slabs = spared(facts, ANG_PART_SLABS, "nothing in them shows");
    slabs.share = 1 - facts->share_uploaded;
    return slabs;
}

static ang_decision decide_clip_plane(const ang_plan_facts *facts) {
    if (facts->plane_cuts) return needed();
    const char *why = facts->has_clip_plane ? "it cuts nothing of the box" : "the scene has none";
    return facts->drawing == ANG_DRAW_REFERENCE ? no_place(why) : spared(facts, ANG_PART_CLIP_PLANE, why);
}

static ang_decision decide_gradient_texture(const ang_plan_facts *facts, const ang_decision *skipping) {
    if (facts->drawing != ANG_DRAW_ENVELOPE) return no_place(NULL);
    if (is_surface(facts)) return no_place("an iso-surface is shaded once a pixel");
    if (facts->mode != ANG_MODE_DVR || !facts->phong) return no_place("nothing is shaded");
    if (facts->manual_filter) return no_place("--manual-filter");
    if (facts->gradients == ANG_GRADIENTS_LOOKUPS) return no_place("--gradients lookups");
    if (facts->whole_steps)
        return no_place("it is made for visible blocks alone, and steps are classified by values beyond them");
    if (!skipping->used || skipping->why) return no_place("rays do not skip, and it is made for visible blocks alone");
    if (facts->memory > 0 && facts->gradient_bytes + facts->bytes > facts->memory)
        return no_place("--gpu-memory does not hold it");
    if (facts->gradients == ANG_GRADIENTS_AUTO && facts->gradient_bytes > facts->gradient_limit)
        return no_place("it would take more than 2 GB; --gradients texture makes it all the same");
    if (facts->gradients_refused) return no_place("there is no memory for it");
    if (!facts->gradients_fit) return no_place("it is larger than one texture of this OpenGL may be");
    return needed();
}

static ang_decision decide_joined(const ang_plan_facts *facts, const ang_decision *skipping) {
    if (facts->drawing != ANG_DRAW_PASSES) return no_place(NULL);
    if (!skipping->used) return no_place("nothing is skipped");
    return facts->separate_passes ? no_place("--separate-passes") : needed();
}

ang_plan_decisions ang_plan_decide(const ang_plan_facts *facts) {
    ang_plan_decisions d;
    ang_decision *to = d.part;
    to[ANG_PART_GRADIENTS] = decide_gradients(facts);
    to[ANG_PART_EXPONENTIAL] = decide_exponential(facts);
    to[ANG_PART_COLOUR] = decide_colour(facts);
    to[ANG_PART_ROUNDING] = decide_rounding(facts);
    to[ANG_PART_TERMINATION] = decide_termination(facts);
    to[ANG_PART_SKIPPING] = decide_skipping(facts);
    to[ANG_PART_DESCENT] =
        facts->drawing == ANG_DRAW_SLICES
            ? spared(facts, ANG_PART_DESCENT, "boxes are only as small as spares more than they cost")
            : no_place(NULL);
    to[ANG_PART_HULL] = decide_hull(facts);
    to[ANG_PART_NEAR_PLANE] = decide_near_plane(facts, &to[ANG_PART_HULL]);
    to[ANG_PART_DIRECTIONS] = facts->drawing != ANG_DRAW_PASSES ? no_place(NULL)
                              : facts->parallel ? spared(facts, ANG_PART_DIRECTIONS, "all rays have one direction")
                                                : needed();
    to[ANG_PART_BORDER] = decide_border(facts);
    to[ANG_PART_SLABS] = decide_slabs(facts, &to[ANG_PART_SKIPPING]);
    to[ANG_PART_CLIP_PLANE] = decide_clip_plane(facts);
    to[ANG_PART_REDRAW] = facts->same_as_before
                              ? spared(facts, ANG_PART_REDRAW, "nothing has changed since the picture before")
                              : needed();
    to[ANG_PART_GL] = !needs_gl(facts) ? spared(facts, ANG_PART_GL, "this method needs none") : needed();
    to[ANG_PART_GRADIENT_TEXTURE] = decide_gradient_texture(facts, &to[ANG_PART_SKIPPING]);
    to[ANG_PART_JOINED] = decide_joined(facts, &to[ANG_PART_SKIPPING]);
    return d;
}

void ang_plan_explain_part(const ang_plan_decisions *decisions, ang_part which, ang_plan *plan) {
    const ang_decision *part = &decisions->part[which];
    if (!part->why) return;
    if (part->used) {
        ang_plan_use(plan, "%s, by --force, though %s", parts[which].words, part->why);
        return;
    }
    char saves[96] = "";
    if (part->gone && isfinite(part->share))
        snprintf(saves, sizeof saves, "%.3g %% %s", 100 * part->share, part->gone);
    else if (part->gone)
        snprintf(saves, sizeof saves, "%s", part->gone);
    ang_plan_leave_out_saving(plan, parts[which].words, part->why, saves);
}

void ang_plan_explain(const ang_plan_decisions *decisions, ang_plan *plan) {
    for (int part = 0; part < ANG_PARTS; part++) ang_plan_explain_part(decisions, (ang_part)part, plan);
}
