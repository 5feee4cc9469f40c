#include "io/preset/preset_own.h"

#include "io/replace.h"
#include "io/text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *ang_preset_own_folder(void) {
    static char folder[4096];
    if (folder[0]) return folder;
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    int used = -1;
    /* As the XDG base directory specification has it, a path that is not absolute is none. */
    if (config && config[0] == '/')
        used = snprintf(folder, sizeof folder, "%s/angioscope/presets", config);
    else if (home && home[0] == '/')
        used = snprintf(folder, sizeof folder, "%s/.config/angioscope/presets", home);
    if (used < 0 || (size_t)used >= sizeof folder) folder[0] = '\0';
    return folder[0] ? folder : NULL;
}

static bool edge_sign(char c) { return c == ' ' || c == '.'; }

bool ang_preset_name_check(const char *name, ang_error *err) {
    size_t length = strlen(name);
    if (length == 0) return ang_fail(err, ANG_USAGE, "A preset needs a name.");
    if (length > ANG_PRESET_NAME_LENGTH)
        return ang_fail(err, ANG_USAGE, "The name is too long: %zu bytes of at most %d.", length,
                        ANG_PRESET_NAME_LENGTH);
    for (size_t i = 0, step; i < length; i += step) {
        if ((unsigned char)name[i] < ' ' || name[i] == 127)
            return ang_fail(err, ANG_USAGE, "The name holds a control character.");
        step = ang_text_character(name + i);
        if (step == 0) return ang_fail(err, ANG_USAGE, "The name is not text in UTF-8.");
        if (name[i] == '/') return ang_fail(err, ANG_USAGE, "A name must not hold a slash: it becomes a file's.");
    }
    if (edge_sign(name[0]) || edge_sign(name[length - 1]))
        return ang_fail(err, ANG_USAGE, "A name must neither begin nor end with a space or a dot.");
    if (name[0] == '-') return ang_fail(err, ANG_USAGE, "A name must not begin with a hyphen, as options do.");
    if (length > 5 && strcmp(name + length - 5, ".json") == 0)
        return ang_fail(err, ANG_USAGE, "Leave out \".json\": the file gets it by itself.");
    return true;
}

static bool path_of(const char *name, char *path, size_t size, ang_error *err) {
    const char *folder = ang_preset_own_folder();
    if (!ang_preset_name_check(name, err)) return false;
    if (!folder)
        return ang_fail(err, ANG_OUTPUT, "there is no folder for presets: neither XDG_CONFIG_HOME nor HOME is set");
    int used = snprintf(path, size, "%s/%s.json", folder, name);
    return (used > 0 && (size_t)used < size) || ang_fail(err, ANG_OUTPUT, "%s: is too long a name", folder);
}

bool ang_preset_own_exists(const char *name) {
    char path[4200];
    return path_of(name, path, sizeof path, NULL) && access(path, F_OK) == 0;
}

bool ang_preset_own_save(const char *name, const char *text, char *path, size_t size, ang_error *err) {
    return path_of(name, path, size, err) && ang_folder_make(ang_preset_own_folder(), err) &&
           ang_file_replace(path, text, strlen(text), err);
}

bool ang_preset_own_delete(const char *name, ang_error *err) {
    char path[4200];
    if (!path_of(name, path, sizeof path, err)) return false;
    return unlink(path) == 0 || ang_fail(err, ANG_OUTPUT, "%s: cannot be deleted: %s", path, strerror(errno));
}
