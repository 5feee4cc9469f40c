#include "core/plan/visibility.h"

#include "core/base/memory.h"

#include <stdlib.h>

ang_visibility ang_visibility_make(const ang_volume *volume, const ang_scene *scene,
                                   const ang_transfer_tables *tables) {
    ang_visibility visibility = {.mode = scene->mode, .tables = tables};
    double half = fmax(scene->window_width, 0) / 2;
    switch (scene->mode) {
    case ANG_MODE_MIP:
        visibility.threshold = ang_volume_stored(volume, scene->window_centre - half);
        break;
    case ANG_MODE_MINIP:
        visibility.threshold = ang_volume_stored(volume, scene->window_centre + half);
        break;
    case ANG_MODE_ISO:
        visibility.threshold = ang_volume_stored(volume, scene->iso_hu);
        break;
    case ANG_MODE_DVR:
    case ANG_MODE_MEAN:
        break;
    }
    return visibility;
}

/* The shaders compare in float with values that were interpolated in float: within this of a threshold they may decide
 * either way. */
static const double rounding_error = 0.05;

bool ang_visibility_of(const ang_visibility *visibility, ang_minmax range) {
    switch (visibility->mode) {
    case ANG_MODE_DVR:
        return ang_tables_shows(visibility->tables, range.min, range.max);
    case ANG_MODE_MIP:
        return range.max > visibility->threshold - rounding_error;
    case ANG_MODE_MINIP:
        return range.min < visibility->threshold + rounding_error;
    case ANG_MODE_ISO:
        return range.max >= visibility->threshold - rounding_error;
    case ANG_MODE_MEAN:
        break;
    }
    return true;
}

/* What is below the lower end and up to the upper end of a range; it shows where they differ. */
static void count_ends(const ang_visibility *visibility, ang_minmax range, uint32_t *lower, uint32_t *upper) {
    if (visibility->mode == ANG_MODE_DVR) {
        ang_tables_widen(visibility->tables, &range.min, &range.max);
        *lower = visibility->tables->visible[range.min];
        *upper = visibility->tables->visible[range.max];
        return;
    }
    /* By one end alone; the other is chosen so that it decides nothing. */
    bool low = visibility->mode != ANG_MODE_MINIP || ang_visibility_of(visibility, range);
    bool high = visibility->mode == ANG_MODE_MINIP || ang_visibility_of(visibility, range);
    *lower = !low;
    *upper = high;
}

bool ang_visibility_lookup_make(const ang_visibility *visibility, ang_minmax whole, bool rounding,
                                ang_visibility_lookup *lookup, ang_error *err) {
    size_t count = (size_t)(whole.max - whole.min) + 1;
    *lookup = (ang_visibility_lookup){.first = whole.min};
    lookup->lower = ang_alloc(count, 2 * sizeof *lookup->lower + 1, "table of visible ranges", err);
    if (!lookup->lower) return false;
    lookup->upper = lookup->lower + count;
    lookup->single = (uint8_t *)(lookup->upper + count);
    for (size_t i = 0; i < count; i++) {
        uint16_t value = (uint16_t)(whole.min + i);
        lookup->single[i] = ang_visibility_of(visibility, (ang_minmax){value, value});
        ang_minmax range = {value, value};
        if (rounding && range.min > 0) range.min--;
        if (rounding && range.max < UINT16_MAX) range.max++;
        count_ends(visibility, range, &lookup->lower[i], &lookup->upper[i]);
    }
    return true;
}

void ang_visibility_lookup_clear(ang_visibility_lookup *lookup) {
    free(lookup->lower);
    *lookup = (ang_visibility_lookup){0};
}

bool ang_visibility_of_all(const ang_visibility *visibility, ang_minmax range) {
    const ang_transfer_tables *tables = visibility->tables;
    switch (visibility->mode) {
    case ANG_MODE_DVR:
        /* Every interval between two stored values has something visible. */
        return tables->point_visible[range.min] && tables->point_visible[range.max] &&
               tables->visible[range.max] - tables->visible[range.min] == (uint32_t)(range.max - range.min);
    case ANG_MODE_MIP:
    case ANG_MODE_ISO:
        return range.min >= visibility->threshold;
    case ANG_MODE_MINIP:
        return range.max <= visibility->threshold;
    case ANG_MODE_MEAN:
        break;
    }
    return true;
}

const char *ang_visibility_reason(ang_mode mode) {
    switch (mode) {
    case ANG_MODE_DVR:
        return "all their values are transparent";
    case ANG_MODE_MIP:
        return "all their values are black under the window";
    case ANG_MODE_MINIP:
        return "all their values are white under the window";
    case ANG_MODE_ISO:
        return "none of their values reaches the iso value";
    case ANG_MODE_MEAN:
        break;
    }
    return "";
}
