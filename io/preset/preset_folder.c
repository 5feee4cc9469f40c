#include "core/base/memory.h"
#include "io/json.h"
#include "io/preset/preset.h"
#include "io/preset/slicer/property.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool ends_in_json(const char *name) {
    size_t length = strlen(name);
    return length > 5 && strcmp(name + length - 5, ".json") == 0;
}

static bool is_listed(const ang_preset_names *names, const char *name) {
    for (size_t i = 0; i < names->count; i++)
        if (strcmp(names->names[i], name) == 0) return true;
    return false;
}

/* Takes over `name` and `path`. */
static bool append(ang_preset_names *names, char *name, char *path) {
    char **grown_names = realloc(names->names, (names->count + 2) * sizeof *grown_names);
    if (grown_names) names->names = grown_names;
    char **grown_paths = realloc(names->paths, (names->count + 2) * sizeof *grown_paths);
    if (grown_paths) names->paths = grown_paths;
    if (!grown_names || !grown_paths || !name || !path) {
        free(name);
        free(path);
        return false;
    }
    names->names[names->count] = name;
    names->paths[names->count++] = path;
    names->names[names->count] = names->paths[names->count] = NULL;
    return true;
}

static bool list_folder(const char *folder, ang_preset_names *names) {
    DIR *directory = opendir(folder);
    if (!directory) return true;
    bool listed = true;
    for (const struct dirent *entry = readdir(directory); entry && listed; entry = readdir(directory)) {
        if (!ends_in_json(entry->d_name) || entry->d_name[0] == '.') continue;
        char *name = strndup(entry->d_name, strlen(entry->d_name) - 5), *path = NULL;
        if (name && is_listed(names, name)) {
            free(name);
            continue;
        }
        if (asprintf(&path, "%s/%s", folder, entry->d_name) < 0) path = NULL;
        listed = append(names, name, path);
    }
    closedir(directory);
    return listed;
}

/* Insertion of paths along with their names; there are tens. */
static void sort_names(ang_preset_names *names) {
    for (size_t i = 1; i < names->count; i++) {
        char *name = names->names[i], *path = names->paths[i];
        size_t j = i;
        for (; j > 0 && strcmp(names->names[j - 1], name) > 0; j--) {
            names->names[j] = names->names[j - 1];
            names->paths[j] = names->paths[j - 1];
        }
        names->names[j] = name;
        names->paths[j] = path;
    }
}

bool ang_preset_list(const char *const *folders, ang_preset_names *names, ang_error *err) {
    *names = (ang_preset_names){0};
    names->names = ang_alloc(1, sizeof *names->names, "list of presets", err);
    names->paths = ang_alloc(1, sizeof *names->paths, "list of presets", err);
    bool listed = names->names && names->paths;
    if (listed)
        for (size_t i = 0; folders[i] && listed; i++)
            if (!list_folder(folders[i], names)) listed = ang_fail(err, ANG_LIMIT, "no memory to list the presets");
    if (listed)
        sort_names(names);
    else
        ang_preset_names_clear(names);
    return listed;
}

void ang_preset_names_clear(ang_preset_names *names) {
    for (size_t i = 0; i < names->count; i++) {
        free(names->names[i]);
        free(names->paths[i]);
    }
    free(names->names);
    free(names->paths);
    *names = (ang_preset_names){0};
}

static void fail_unknown(const char *wanted, const ang_preset_names *names, ang_error *err) {
    char all[600];
    size_t used = 0;
    all[0] = 0;
    for (size_t i = 0; i < names->count && used < sizeof all; i++)
        used += (size_t)snprintf(all + used, sizeof all - used, "%s%s", i ? ", " : "", names->names[i]);
    const char *nearest = ang_nearest_word(wanted, (const char *const *)names->names);
    if (names->count == 0)
        ang_fail(err, ANG_USAGE,
                 "there is no preset \"%.100s\", nor any other where presets are looked for; give a file", wanted);
    else if (nearest)
        ang_fail(err, ANG_USAGE, "there is no preset \"%.100s\"; did you mean %s? There are: %s", wanted, nearest, all);
    else
        ang_fail(err, ANG_USAGE, "there is no preset \"%.100s\"; there are: %s", wanted, all);
}

bool ang_preset_is_path(const char *name_or_path) {
    return strchr(name_or_path, '/') || (ends_in_json(name_or_path) && access(name_or_path, F_OK) == 0);
}

ang_preset *ang_preset_find(const char *name_or_path, const char *const *folders, ang_error *err) {
    if (ang_property_form_of(name_or_path) != ANG_PROPERTY_NONE && access(name_or_path, F_OK) == 0) {
        ang_fail(
            err, ANG_USAGE,
            "%s: is a volume property of 3D Slicer by its name; 'angioscope presets import FILE' makes presets of it",
            name_or_path);
        return NULL;
    }
    if (ang_preset_is_path(name_or_path)) return ang_preset_load(name_or_path, err);
    char *wanted = strndup(name_or_path, strlen(name_or_path) - (ends_in_json(name_or_path) ? 5 : 0));
    ang_preset_names names;
    if (!wanted || !ang_preset_list(folders, &names, err)) {
        if (!wanted) ang_fail(err, ANG_LIMIT, "no memory to find the preset");
        free(wanted);
        return NULL;
    }
    ang_preset *preset = NULL;
    size_t i = 0;
    while (i < names.count && strcmp(names.names[i], wanted) != 0) i++;
    if (i < names.count)
        preset = ang_preset_load(names.paths[i], err);
    else
        fail_unknown(wanted, &names, err);
    ang_preset_names_clear(&names);
    free(wanted);
    return preset;
}
