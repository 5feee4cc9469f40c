/* What a range of values can show in a scene: the question that octree, envelope and ray casters ask of every block. */
#ifndef ANG_PLAN_VISIBILITY_H
#define ANG_PLAN_VISIBILITY_H

#include "core/scene/scene.h"
#include "core/transfer/tables.h"
#include "core/volume/octree.h"

/* Plain value; borrows `tables`. */
typedef struct ang_visibility {
    ang_mode mode;
    const ang_transfer_tables *tables; /* dvr */
    double threshold;                  /* stored value: iso, or the end of the window that decides; may be infinite */
} ang_visibility;

/* `tables` are those of the scene's transfer function; needed for dvr only, NULL otherwise. */
ang_visibility ang_visibility_make(const ang_volume *volume, const ang_scene *scene, const ang_transfer_tables *tables);

/* Whether values in the range can change a pixel. dvr: any has extinction. mip: any is brighter than the window's black
 * end, to which a ray of nothing falls back; minip: any is darker than its white end. iso: any reaches the iso value.
 * mean: always. Exact and O(1), thread safe. */
bool ang_visibility_of(const ang_visibility *visibility, ang_minmax range);

/* The answers for all ranges within one, looked up by their ends. Zero-initialise; free with
 * ang_visibility_lookup_clear. */
typedef struct ang_visibility_lookup {
    uint16_t first;  /* the least value */
    uint32_t *lower; /* of values from `first` on: [min, max] with min < max shows where upper[max] > lower[min] */
    uint32_t *upper;
    uint8_t *single; /* and one value by itself where this is 1 */
} ang_visibility_lookup;

/* The answers of ang_visibility_of for ranges within `whole`. `rounding`: [min, max] with min < max answers for one
 * value more on each side. False with ANG_LIMIT. */
bool ang_visibility_lookup_make(const ang_visibility *visibility, ang_minmax whole, bool rounding,
                                ang_visibility_lookup *lookup, ang_error *err);
void ang_visibility_lookup_clear(ang_visibility_lookup *lookup);

/* Whether looking closer at a block of this range is idle because hardly any part of it can be invisible. A hint. */
bool ang_visibility_of_all(const ang_visibility *visibility, ang_minmax range);

/* Why a block is left out, for the plan: "all its values are transparent", ... */
const char *ang_visibility_reason(ang_mode mode);

#endif
