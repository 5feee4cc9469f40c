/* How a step of a ray is classified in mode dvr: by the value at its middle, or by all values between those at its ends
 * (numerics.md, "Prefix integral"). */
#ifndef ANG_PLAN_CLASSIFICATION_H
#define ANG_PLAN_CLASSIFICATION_H

#include "core/plan/plan.h"
#include "core/transfer/transfer.h"
#include "core/volume/volume.h"

typedef enum ang_classify { ANG_CLASSIFY_AUTO, ANG_CLASSIFY_MIDPOINT, ANG_CLASSIFY_PREFIX } ang_classify;
/* As on the command line: "auto", "midpoint", "prefix"; -1 where there is no such name. */
const char *ang_classify_name(ang_classify classify);
int ang_classify_from_name(const char *name);

/* Where a transfer function changes within few HU. */
typedef enum ang_stiff_kind {
    ANG_STIFF_STEP, /* two points at one HU, or so close that data may pass them at once */
    ANG_STIFF_PEAK  /* rises and falls again, or falls and rises */
} ang_stiff_kind;

typedef struct ang_stiff_place {
    ang_stiff_kind kind;
    double low, high; /* HU: a peak's feet, where a tenth of its height is left; a step's points */
    double change;    /* HU per mm where the volume's values pass it: the median; 0: they do not */
} ang_stiff_place;

enum { ANG_STIFF_PLACES = 32 };
typedef struct ang_stiffness {
    ang_stiff_place place[ANG_STIFF_PLACES]; /* the narrowest ones, by HU */
    int count;
} ang_stiffness;

/* The steps and peaks of a transfer function, of opacity or of the colour of what shows; `change` is 0. Rises of less
 * than a tenth of opacity or colour are no steps; of less than a level, or than a quarter of what they lead to, no
 * peaks. Pure. */
ang_stiffness ang_stiffness_of(const ang_transfer *transfer);

/* Some hundred thousand voxels at most, spread over a volume, each with its neighbours: what is looked at again with
 * every transfer function. */
typedef struct ang_neighbours {
    size_t count;
    uint16_t (*stored)[4]; /* a voxel and its neighbour along each axis; at the border itself */
} ang_neighbours;
/* False with ANG_LIMIT. Free with ang_neighbours_clear. */
bool ang_neighbours_take(ang_neighbours *neighbours, const ang_volume *volume, ang_error *err);
void ang_neighbours_clear(ang_neighbours *neighbours);

/* Fills in `change` from the neighbours of the same volume. */
void ang_stiffness_measure_in(ang_stiffness *stiffness, const ang_neighbours *neighbours, const ang_volume *volume);
/* The same from neighbours taken for this once; where there is no memory for them, as if nothing were passed. */
void ang_stiffness_measure(ang_stiffness *stiffness, const ang_volume *volume);

/* Steps as wide as this share of what the data change from one sample to the next are as good as sudden. */
#define ANG_STIFF_STEP_SHARE 0.125

typedef struct ang_classification {
    bool prefix;
    bool may_miss;     /* mid-point samples may pass a peak without seeing it */
    char why[200];     /* why this one: part of a sentence */
    char warning[240]; /* for the user, where may_miss; else empty */
} ang_classification;

/* The classification for samples `step` mm apart. auto: prefix where the data pass a place of `stiffness` between two
 * samples, half of them or more; else mid-point, which costs less and follows smooth functions with the same order.
 * Pure.
 */
ang_classification ang_classification_choose(ang_classify wanted, const ang_stiffness *stiffness, double step);
/* Adds to `plan` how steps are classified and why; `plateaus`: the prefix integrals have some. */
void ang_classification_explain(const ang_classification *classification, bool plateaus, ang_plan *plan);

#endif
