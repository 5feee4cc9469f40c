/* angioscope presets: which there are, what is in one, and the way to other programs. */
#include "app/presets.h"

#include "app/unused.h"
#include "app/verbs.h"
#include "io/preset/preset.h"
#include "io/text.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

static void print_line(const char *name, const ang_preset *preset, int colours) {
    if (colours > 0) ang_app_swatch(preset, colours, stdout);
    printf("%-24s %-5s %-6s %s\n", name, preset->modality, ang_mode_name(preset->mode), preset->description);
}

static int list(const char *const *folders, ang_error *err) {
    ang_preset_names names;
    if (!ang_preset_list(folders, &names, err)) return (int)err->code;
    int code = ANG_OK, colours = ang_app_colours(stdout);
    printf("%*s%-24s %-5s %-6s %s\n", colours > 0 ? ANG_SWATCH_CELLS + 1 : 0, "", "NAME", "FOR", "MODE",
           "WHAT IT SHOWS");
    for (size_t i = 0; i < names.count; i++) {
        ang_error broken = {0};
        ang_preset *preset = ang_preset_load(names.paths[i], &broken);
        if (!preset) {
            /* One broken file does not hide the others. */
            ang_text_clean(broken.message);
            fprintf(stderr, "angioscope: %s\n", broken.message);
            code = (int)broken.code;
            continue;
        }
        print_line(names.names[i], preset, colours);
        ang_preset_free(preset);
    }
    ang_preset_names_clear(&names);
    return code;
}

static int list_folder(const char *folder, ang_error *err) {
    const char *const folders[2] = {folder, NULL};
    DIR *directory = opendir(folder);
    if (!directory) {
        ang_fail(err, ANG_USAGE, "%s: is no folder that can be read (%s)", folder, strerror(errno));
        return ANG_USAGE;
    }
    closedir(directory);
    return list(folders, err);
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
    int count = options->argument_count;
    static const char *const actions[] = {"list", "show", "import", "export", "sheet"};
    for (size_t i = 0; i < sizeof actions / sizeof *actions; i++)
        if (strcmp(action, actions[i]) == 0 && !ang_app_presets_options_check(action, options, err))
            return (int)err->code;
    if (strcmp(action, "list") == 0 && count == 1) return list(ang_app_preset_folders(), err);
    if (strcmp(action, "list") == 0 && count == 2) return list_folder(options->arguments[1], err);
    if (strcmp(action, "show") == 0 && count == 2) return show(options->arguments[1], err);
    if (strcmp(action, "import") == 0 && count >= 2) return ang_app_presets_import(options, err);
    if (strcmp(action, "export") == 0 && count >= 2) return ang_app_presets_export(options, err);
    if (strcmp(action, "sheet") == 0 && count == 2) return ang_app_presets_sheet(options, err);
    ang_fail(err, ANG_USAGE,
             "presets: say 'presets list [FOLDER]', 'presets show NAME|FILE', 'presets import FILE [NAME...]', "
             "'presets export NAME|FILE... -o OUT.vp|.vp.json|.xml' or 'presets sheet PATH -o OUT.png'");
    return ANG_USAGE;
}
