#include "core/plan/visibility.h"

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

bool ang_visibility_of(const ang_visibility *visibility, ang_minmax range) {
    /* The shaders compare in float with values that were interpolated in float: within this of a threshold they may
     * decide either way. */
    const double rounding = 0.05;
    switch (visibility->mode) {
    case ANG_MODE_DVR:
        return ang_tables_shows(visibility->tables, range.min, range.max);
    case ANG_MODE_MIP:
        return range.max > visibility->threshold - rounding;
    case ANG_MODE_MINIP:
        return range.min < visibility->threshold + rounding;
    case ANG_MODE_ISO:
        return range.max >= visibility->threshold - rounding;
    case ANG_MODE_MEAN:
        break;
    }
    return true;
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
