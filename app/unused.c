#include "app/unused.h"

#include "app/render_output.h"
#include "io/movie/movie.h"

#include <stdio.h>
#include <string.h>

static void note(const ang_options *options, const char *name, bool unused, const char *why, ang_notes *notes) {
    if (unused && ang_options_given(ANG_VERB_RENDER, options, name))
        ang_notes_add(notes, "--%s has no effect %s", name, why);
}

void ang_app_note_unused(const ang_options *options, const ang_picture *picture, const ang_method *method,
                         ang_notes *notes) {
    const ang_scene *scene = &picture->scene;
    bool values = scene->mode != ANG_MODE_DVR && scene->mode != ANG_MODE_ISO;
    char mode[64];
    snprintf(mode, sizeof mode, "in mode %s", ang_mode_name(scene->mode));
    note(options, "shading", values, mode, notes);
    note(options, "classification", scene->mode != ANG_MODE_DVR, mode, notes);
    note(options, "termination", scene->mode != ANG_MODE_DVR, mode, notes);
    note(options, "termination", scene->mode == ANG_MODE_DVR && options->no_termination, "beside --no-termination",
         notes);
    note(options, "fov", scene->camera.projection == ANG_PARALLEL, "with --projection parallel", notes);
    note(options, "step", method->exact, "with --method reference, which takes no steps", notes);
    note(options, "fps", !ang_movie_is(options->output), "but in films (.mp4, .avi)", notes);
    note(options, "keep-phi", !options->json && !ang_render_output_is_capture(options->output),
         "but in DICOM (.dcm) and --json: other files never say who the patient is", notes);
}

bool ang_app_presets_options_check(const char *action, const ang_options *options, ang_error *err) {
    static const struct {
        const char *option, *actions;
    } table[] = {{"output", "import export sheet"},
                 {"replace", "import"},
                 {"series", "sheet"},
                 {"size", "sheet"},
                 {"view", "sheet"},
                 {"zoom", "sheet"},
                 {"strict", "sheet"},
                 {"no-sandbox", "sheet"},
                 {"raw-dims", "sheet"},
                 {"raw-type", "sheet"},
                 {"raw-spacing", "sheet"}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (ang_options_given(ANG_VERB_PRESETS, options, table[i].option) && !strstr(table[i].actions, action))
            return ang_fail(err, ANG_USAGE, "presets %s: takes no --%s, which is for: presets %s", action,
                            table[i].option, table[i].actions);
    return true;
}
