/* Transfer function: HU to colour and extinction, piecewise linear in opacity and colour, exact in double. */
#ifndef ANG_TRANSFER_TRANSFER_H
#define ANG_TRANSFER_TRANSFER_H

#include "core/base/error.h"
#include "core/base/notes.h"

#include <stdbool.h>
#include <stddef.h>

/* Points beyond plus or minus this HU value are refused: no scanner or phantom has them, and sums stay finite. */
#define ANG_TRANSFER_HU_LIMIT 1e9
/* The greatest extinction per mm and the least unit distance in mm that are accepted, for the same reason. */
#define ANG_TRANSFER_EXTINCTION_LIMIT 1e20
#define ANG_TRANSFER_LEAST_UNIT       1e-12

/* A control point. */
typedef struct ang_transfer_point {
    double hu;
    double colour[3]; /* display-referred, 0..1 */
    double opacity;   /* per unit_distance, 0..1; or, where by_extinction is set, extinction per mm, >= 0 */
} ang_transfer_point;

/* Integrals over HU, in 1/mm * HU: of the extinction, and of each colour channel times the extinction. */
typedef struct ang_transfer_integral {
    double extinction;
    double colour[3];
} ang_transfer_integral;

/* Immutable after creation; safe to share between threads. Points are sorted by HU; two at one HU make a step, at which
 * the function has the right-hand value. Below the first and above the last point the end values hold. */
typedef struct ang_transfer {
    ang_transfer_point *points;
    size_t count;         /* >= 1 */
    double unit_distance; /* mm, > 0: the length to which the opacities refer */
    bool by_extinction;   /* points give extinction per mm instead of opacity */

    /* Made by ang_transfer_create for the queries below; of no use elsewhere. Region 0 lies before the first point,
     * region i between points i-1 and i, region `count` after the last. */
    ang_transfer_integral *region; /* count: over the whole of region i; [0] is zero */
    ang_transfer_integral *prefix; /* count: from the first point to point i */
    size_t *visible_before;        /* count + 2: visible regions of positive length among the first i */
    size_t *opaque_before;         /* count + 2: the same for plateaus at opacity 1 */
} ang_transfer;

/* Copies and sorts `points`. Refused with ANG_USAGE, naming the point (counted from 0): none, not finite or beyond the
 * limits above, opacity outside 0..1, negative extinction, colour outside 0..1. Unsorted points are sorted, of three or
 * more at one HU the first and last kept; both are said in `warnings` (may be NULL). Free with ang_transfer_free. */
ang_transfer *ang_transfer_create(const ang_transfer_point *points, size_t count, double unit_distance,
                                  bool by_extinction, ang_notes *warnings, ang_error *err);
void ang_transfer_free(ang_transfer *transfer);
/* A copy whose points are moved by `shift` HU. */
ang_transfer *ang_transfer_shifted(const ang_transfer *transfer, double shift, ang_error *err);
/* Whether both have the same points and unit. */
bool ang_transfer_same(const ang_transfer *a, const ang_transfer *b);

/* Opacity per unit_distance (0..1), colour and extinction per mm at a HU value. Extinction is
 * -log1p(-opacity)/unit_distance, infinity at opacity 1 (numerics.md). */
double ang_transfer_opacity(const ang_transfer *transfer, double hu);
double ang_transfer_extinction(const ang_transfer *transfer, double hu);
void ang_transfer_colour(const ang_transfer *transfer, double hu, double colour[3]);

/* Exact integrals over HU from the first point to `hu` (negative direction: before it, the end value holds):
 * K(hu) = int kappa, CK(hu) = int colour * kappa, in 1/mm * HU. Isolated peaks at opacity 1 contribute their finite
 * integral; plateaus at opacity 1 contribute nothing here: ask ang_transfer_opaque_between. O(log points). */
ang_transfer_integral ang_transfer_integrate(const ang_transfer *transfer, double hu);
/* The same from `low` to `high` without the cancellation of a difference; negative where high < low. O(points
 * between). */
ang_transfer_integral ang_transfer_integrate_between(const ang_transfer *transfer, double low, double high);
/* Whether the closed interval [low, high] of HU meets a plateau at opacity 1 (an interval of positive length, or an end
 * value), its ends included where the opacity there is 1. O(log points). */
bool ang_transfer_opaque_between(const ang_transfer *transfer, double low, double high);
/* Whether extinction or colour change at once somewhere: two points at one HU, or the end of a plateau at opacity 1. */
bool ang_transfer_jumps(const ang_transfer *transfer);
/* Exact: whether at any HU in the closed interval [low, high] the extinction is > 0. O(log points). */
bool ang_transfer_visible(const ang_transfer *transfer, double low, double high);

#endif
