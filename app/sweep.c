#include "app/sweep.h"

#include "app/verbs.h"
#include "core/transfer/preset_blend.h"
#include "io/preset/preset.h"

#include <stdlib.h>
#include <string.h>

static bool open_all(ang_sweep *sweep, char *names, const char *list, ang_error *err) {
    char *rest = names, *name;
    while ((name = strsep(&rest, ","))) {
        if (sweep->count == ANG_SWEEP_MOST)
            return ang_fail(err, ANG_USAGE, "--sweep %s: at most %d presets", list, (int)ANG_SWEEP_MOST);
        ang_preset *preset = ang_preset_find(name, ang_app_preset_folders(), err);
        if (!preset) return false;
        sweep->preset[sweep->count++] = preset;
        if (preset->mode != sweep->preset[0]->mode)
            return ang_fail(err, ANG_USAGE, "--sweep %s: %s is of mode %s and %s of mode %s; all must be of one", list,
                            sweep->preset[0]->name, ang_mode_name(sweep->preset[0]->mode), preset->name,
                            ang_mode_name(preset->mode));
    }
    return sweep->count >= 2 ||
           ang_fail(err, ANG_USAGE, "--sweep %s: give two presets or more, separated by commas", list);
}

bool ang_sweep_open(ang_sweep *sweep, const char *list, ang_error *err) {
    char *names = strdup(list);
    if (!names) return ang_fail(err, ANG_LIMIT, "no memory for presets");
    bool opened = open_all(sweep, names, list, err);
    free(names);
    return opened;
}

void ang_sweep_clear(ang_sweep *sweep) {
    for (int i = 0; i < sweep->count; i++) ang_preset_free(sweep->preset[i]);
    *sweep = (ang_sweep){0};
}

ang_preset *ang_sweep_at(const ang_sweep *sweep, int frame, int frames, ang_error *err) {
    int steps = frames > 1 ? frames - 1 : 1, pieces = sweep->count - 1;
    /* In whole numbers, so that presets are met exactly where frames allow it. */
    long long at = (long long)frame * pieces;
    int piece = (int)(at / steps);
    if (piece >= pieces) piece = pieces - 1;
    double t = (double)(at - (long long)piece * steps) / steps;
    return ang_preset_blend(sweep->preset[piece], sweep->preset[piece + 1], t, err);
}
