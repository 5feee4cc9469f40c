/* angioscope presets: which there are, and what is in one. */
#include "app/verbs.h"
#include "io/preset.h"

#include <stdlib.h>
#include <string.h>

static int list(ang_error *err) {
    ang_preset_names names;
    if (!ang_preset_list(ang_app_preset_folders(), &names, err)) return (int)err->code;
    int code = ANG_OK;
    printf("%-24s %-5s %-6s %s\n", "NAME", "FOR", "MODE", "WHAT IT SHOWS");
    for (size_t i = 0; i < names.count; i++) {
        ang_error broken = {0};
        ang_preset *preset = ang_preset_load(names.paths[i], &broken);
        if (!preset) {
            /* One broken file does not hide the others. */
            fprintf(stderr, "angioscope: %s\n", broken.message);
            code = (int)broken.code;
            continue;
        }
        printf("%-24s %-5s %-6s %s\n", names.names[i], preset->modality, ang_mode_name(preset->mode),
               preset->description);
        ang_preset_free(preset);
    }
    ang_preset_names_clear(&names);
    return code;
}

static int show(const char *name, ang_error *err) {
    ang_preset *preset = ang_preset_find(name, ang_app_preset_folders(), err);
    if (!preset) return (int)err->code;
    char *text = ang_preset_print(preset, err);
    if (text) puts(text);
    free(text);
    ang_preset_free(preset);
    return text ? ANG_OK : (int)err->code;
}

int ang_app_presets(const ang_options *options, ang_error *err) {
    const char *action = options->argument_count > 0 ? options->arguments[0] : "";
    if (strcmp(action, "list") == 0 && options->argument_count == 1) return list(err);
    if (strcmp(action, "show") == 0 && options->argument_count == 2) return show(options->arguments[1], err);
    ang_fail(err, ANG_USAGE, "presets: say 'presets list' or 'presets show NAME|FILE'");
    return ANG_USAGE;
}
