#include "app/view_waiting.h"

#include "app/picture_state.h"
#include "app/view_state.h"
#include "io/preset/preset.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool ang_waiting_read(ang_waiting *waiting, const char *file, ang_error *err) {
    char *copy = strdup(file);
    ang_waiting_clear(waiting);
    waiting->file = copy;
    return (copy || ang_fail(err, ANG_LIMIT, "no memory for a path")) && ang_state_read(file, &waiting->state, err);
}

void ang_waiting_clear(ang_waiting *waiting) {
    free(waiting->file);
    waiting->file = NULL;
    waiting->over = false;
    ang_state_clear(&waiting->state);
}

bool ang_waiting_data(const ang_waiting *waiting, char *path, size_t size, ang_error *err) {
    const char *file = waiting->file, *data = waiting->state.input_path;
    if (!data)
        return ang_fail(err, ANG_INPUT, "%s: does not say where its data are. Open them, and they are shown like that.",
                        file);
    if (access(data, F_OK) != 0)
        return ang_fail(err, ANG_INPUT, "%s: its data, %s, are not there. Open them where they are now.", file, data);
    return snprintf(path, size, "%s", data) < (int)size ||
           ang_fail(err, ANG_INPUT, "%s: the path of its data is too long", file);
}

ang_load_options ang_waiting_load_options(ang_waiting *waiting, const char *path) {
    const ang_options *options = waiting->options;
    const ang_state *state = &waiting->state;
    ang_load_options how = ang_app_load_options(options);
    bool named = options->state && options->argument_count > 0 && strcmp(waiting->file, options->state) == 0 &&
                 strcmp(path, options->arguments[0]) == 0;
    if (!state->preset) return how;
    waiting->over = named || (state->input_path && strcmp(path, state->input_path) == 0);
    how.series_remembered = !how.series;
    how.phase_remembered = how.phase == 0;
    how.raw_remembered = !how.raw_dims && !how.raw_type && !how.raw_spacing;
    snprintf(waiting->series, sizeof waiting->series, "%d", ang_state_series(state));
    if (how.phase == 0 && !how.series) how.phase = ang_state_phase(state);
    if (ang_state_series(state) > 0 && !how.series) how.series = waiting->series;
    if (!how.raw_dims) how.raw_dims = state->raw_dims;
    if (!how.raw_type) how.raw_type = state->raw_type;
    if (!how.raw_spacing) how.raw_spacing = state->raw_spacing;
    return how;
}

/* --preset goes before the preset of --state. */
static bool prefer_option(ang_waiting *waiting, ang_error *err) {
    const ang_options *options = waiting->options;
    ang_state *state = &waiting->state;
    if (!options->preset || !options->state || strcmp(waiting->file, options->state) != 0) return true;
    ang_preset *preset = ang_preset_find(options->preset, ang_app_preset_folders(), err);
    if (!preset) return false;
    ang_preset_free(state->preset);
    state->preset = preset;
    state->preset_changed = false;
    state->shift_hu = 0;
    state->stretch = 1;
    return true;
}

bool ang_waiting_session(ang_waiting *waiting, const ang_study *study, ang_session *session, ang_error *err) {
    ang_notes warnings = {0};
    *err = (ang_error){0};
    if (!waiting->state.preset) return false;
    bool same = ang_state_matches(&waiting->state, study->handle, &warnings), found = false;
    const char *told = warnings.count > 0 ? warnings.text[0] : "";
    if (!same && !waiting->over)
        ang_fail(err, ANG_INPUT, "%s: is not shown of these data: %s", waiting->file, told);
    else
        found = prefer_option(waiting, err) && ang_view_session_of(&waiting->state, waiting->file, study, session, err);
    if (found && !same) ang_fail(err, ANG_INPUT, "%s: %s", waiting->file, told);
    ang_notes_clear(&warnings);
    ang_waiting_clear(waiting);
    return found;
}
