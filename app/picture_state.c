#include "app/picture_state.h"

#include "io/json.h"
#include "io/report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What of render's options belongs to a picture, beside the preset, which has mode, shading, shift and iso value in it:
 * nothing that names files, and so nothing that a state from elsewhere could have overwritten. */
static const char *const of_picture[] = {"size",
                                         "view",
                                         "pan",
                                         "zoom",
                                         "projection",
                                         "fov",
                                         "clip",
                                         "clip-plane",
                                         "axes",
                                         "cut-plane",
                                         "measure",
                                         "background",
                                         "mode",
                                         "method",
                                         "step",
                                         "termination",
                                         "proxy",
                                         "no-termination",
                                         "gradients",
                                         "skipping",
                                         "quads",
                                         "classification",
                                         "no-skip",
                                         "bricks",
                                         "passes-steps",
                                         "manual-filter",
                                         "count-shown",
                                         "separate-passes",
                                         "show-bricks",
                                         "every",
                                         "annotate",
                                         "gpu-memory",
                                         NULL};

static bool belongs(const char *name) {
    int i = 0;
    while (of_picture[i] && strcmp(of_picture[i], name) != 0) i++;
    return of_picture[i] != NULL;
}

bool ang_state_offer(const ang_state *state, const char *file, ang_options *options, ang_error *err) {
    for (size_t i = 0; i < state->option_count; i++) {
        const ang_state_option *option = &state->options[i];
        ang_error own = {0};
        if (!belongs(option->name))
            return ang_fail(err, ANG_USAGE, "%s: render.%s is no setting of a picture", file, option->name);
        if (!ang_options_offer(ANG_VERB_RENDER, options, option->name, option->value, &own))
            return ang_fail(err, own.code, "%s: render.%s: %s", file, option->name, own.message);
    }
    return true;
}

/* Where the data are and how to read them. */
static bool offer_input(ang_verb verb, const char *file, ang_stated *stated, ang_error *err) {
    const ang_state *state = &stated->state;
    ang_options *options = &stated->options;
    int series = ang_state_series(state);
    if (options->argument_count == 0 && !state->input_path)
        return ang_fail(err, ANG_USAGE, "%s: this state does not say where its data are: name them, too", file);
    if (options->argument_count == 0 && state->input_path) {
        if (access(state->input_path, F_OK) != 0)
            return ang_fail(err, ANG_INPUT, "%s: the data of this state, %s, are not there; name where they are now",
                            file, state->input_path);
        stated->arguments[0] = state->input_path;
        options->arguments = stated->arguments;
        options->argument_count = 1;
    }
    snprintf(stated->series, sizeof stated->series, "%d", series);
    bool phase = !options->series; /* the state's phase is one of the state's series */
    options->series_remembered = !options->series;
    options->phase_remembered = !ang_options_given(verb, options, "phase");
    options->raw_remembered = !options->raw_dims && !options->raw_type && !options->raw_spacing;
    snprintf(stated->phase, sizeof stated->phase, "%d", ang_state_phase(state));
    return (series == 0 || ang_options_offer(verb, options, "series", stated->series, err)) &&
           (!phase || ang_options_offer(verb, options, "phase", stated->phase, err)) &&
           (!state->raw_dims || ang_options_offer(verb, options, "raw-dims", state->raw_dims, err)) &&
           (!state->raw_type || ang_options_offer(verb, options, "raw-type", state->raw_type, err)) &&
           (!state->raw_spacing || ang_options_offer(verb, options, "raw-spacing", state->raw_spacing, err));
}

bool ang_stated_open(ang_verb verb, const ang_options *options, ang_stated *stated, ang_error *err) {
    *stated = (ang_stated){.options = *options, .state = ang_state_default};
    const char *file = options->state;
    if (!file) return true;
    const char *method = options->method;
    bool opened = ang_state_read(file, &stated->state, err) && offer_input(verb, file, stated, err) &&
                  ang_state_offer(&stated->state, file, &stated->options, err);
    if (verb == ANG_VERB_REPORT) stated->options.method = method;
    if (!opened) ang_stated_clear(stated);
    return opened;
}

void ang_stated_hand_preset(ang_stated *stated, ang_picture *picture) {
    if (stated->options.preset || !stated->state.preset) return;
    picture->preset = stated->state.preset;
    stated->state.preset = NULL;
}

void ang_stated_clear(ang_stated *stated) { ang_state_clear(&stated->state); }

bool ang_state_matches(const ang_state *state, const ang_load_report *report, ang_notes *warnings) {
    char name[32];
    ang_load_report_name(report, name);
    /* The hash: the series' number is another where the folder holds more than before. */
    if (!state->input_name || strncmp(state->input_name, name, strcspn(name, "-") + 1) == 0) return true;
    ang_notes_add(warnings, "the data are not those that the state was saved of: %s, not %s", name, state->input_name);
    return false;
}

/* A state that is being filled. */
typedef struct filling {
    ang_state state;
    const ang_picture *picture;
    const ang_method *method;
    bool done;
    ang_error *err;
} filling;

/* The value of an option as it came to be, where that is not what was asked for. */
static void effective(const filling *filling, const char *name, char *value, size_t size) {
    const ang_picture *picture = filling->picture;
    const ang_view *view = &picture->view;
    if (strcmp(name, "method") == 0) snprintf(value, size, "%s", filling->method->name);
    char number[3][40];
    if (strcmp(name, "step") == 0)
        snprintf(value, size, "%s", ang_json_number_text(picture->render.step_voxels, number[0]));
    if (strcmp(name, "every") == 0) snprintf(value, size, "%d", picture->every);
    if (strcmp(name, "mode") == 0) snprintf(value, size, "%s", picture->lookups ? "lookups" : "");
    if (strcmp(name, "view") == 0)
        snprintf(value, size, "%s,%s,%s", ang_json_number_text(view->azimuth_deg, number[0]),
                 ang_json_number_text(view->elevation_deg, number[1]), ang_json_number_text(view->roll_deg, number[2]));
}

static void take(void *context, const char *name, const char *given) {
    filling *filling = context;
    char value[ANG_LONGEST_OPTION];
    snprintf(value, sizeof value, "%s", given);
    if (!belongs(name)) return;
    effective(filling, name, value, sizeof value);
    if (!value[0] || strcmp(value, "nan") == 0) return;
    bool flag = strcmp(value, "yes") == 0;
    filling->done = filling->done && ang_state_add_option(&filling->state, name, flag ? "" : value, filling->err);
}

char *ang_picture_state_print(const ang_options *options, const ang_picture *picture, const ang_method *method,
                              const ang_load_report *report, ang_error *err) {
    const ang_scene *scene = &picture->scene;
    char name[32];
    ang_load_report_name(report, name);
    ang_preset preset = *picture->preset;
    preset.description = "as shown";
    preset.mode = scene->mode;
    preset.shading = scene->shading;
    preset.iso_hu = scene->iso_hu;
    preset.window_centre = scene->window_centre;
    preset.window_width = scene->window_width;
    preset.transfer = (ang_transfer *)scene->transfer;
    filling filling = {.state = ang_state_default, .picture = picture, .method = method, .done = true, .err = err};
    ang_options_each(ANG_VERB_RENDER, options, take, &filling);
    filling.state.preset = &preset; /* this and the texts are lent */
    filling.state.input_name = name;
    filling.state.raw_dims = (char *)options->raw_dims;
    filling.state.raw_type = (char *)options->raw_type;
    filling.state.raw_spacing = (char *)options->raw_spacing;
    char *text = filling.done ? ang_state_print(&filling.state, ANG_VERSION, err) : NULL;
    filling.state.preset = NULL;
    filling.state.input_name = NULL;
    filling.state.raw_dims = filling.state.raw_type = filling.state.raw_spacing = NULL;
    ang_state_clear(&filling.state);
    return text;
}
