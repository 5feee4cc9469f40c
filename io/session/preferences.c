#include "io/session/preferences.h"

#include "io/json.h"
#include "io/replace.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const ang_preferences ang_preferences_default = {
    .split_across = 0.5, .split_down = 0.5, .panel_width = 320, .corner_text = true, .crosshair = true};

static const double greatest_window = 16384, greatest_panel = 4096;

bool ang_preferences_path(char *path, size_t size) {
    const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");
    int used = -1;
    /* The specification of XDG wants a relative path to be passed over. */
    if (config && config[0] == '/')
        used = snprintf(path, size, "%s/angioscope/viewer.json", config);
    else if (home && home[0] == '/')
        used = snprintf(path, size, "%s/.config/angioscope/viewer.json", home);
    return used > 0 && (size_t)used < size;
}

static void take_flag(const cJSON *root, const char *name, bool *flag) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(root, name);
    if (cJSON_IsBool(item)) *flag = cJSON_IsTrue(item);
}

/* Within (low, high]. */
static void take_number(const cJSON *root, const char *name, double low, double high, double *value) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(root, name);
    if (cJSON_IsNumber(item) && item->valuedouble > low && item->valuedouble <= high) *value = item->valuedouble;
}

static void take_recent(const cJSON *root, ang_preferences *preferences) {
    const cJSON *item, *list = cJSON_GetObjectItemCaseSensitive(root, "recent");
    cJSON_ArrayForEach(item, list) {
        const char *text = cJSON_GetStringValue(item);
        if (!text || text[0] != '/' || strlen(text) >= ANG_RECENT_PATH) continue;
        if (preferences->recent_count < ANG_RECENT_FILES)
            strcpy(preferences->recent[preferences->recent_count++], text);
    }
}

bool ang_preferences_read(const char *path, ang_preferences *preferences, ang_error *err) {
    *preferences = ang_preferences_default;
    ang_json json;
    if (access(path, F_OK) != 0 && (errno == ENOENT || errno == ENOTDIR)) return true;
    if (!ang_json_open(path, &json, err)) return false;
    const cJSON *root = json.root, *theme = cJSON_GetObjectItemCaseSensitive(root, "theme");
    if (!cJSON_IsObject(root)) {
        ang_json_fail(&json, "", err, "these are no preferences of the viewer; delete the file");
        ang_json_close(&json);
        return false;
    }
    preferences->light_theme = cJSON_IsString(theme) && strcmp(theme->valuestring, "light") == 0;
    take_number(root, "split_across", 0, 1, &preferences->split_across);
    take_number(root, "split_down", 0, 1, &preferences->split_down);
    take_number(root, "panel_width", 0, greatest_panel, &preferences->panel_width);
    take_flag(root, "panel_hidden", &preferences->panel_hidden);
    take_flag(root, "corner_text", &preferences->corner_text);
    take_flag(root, "crosshair", &preferences->crosshair);
    double width = 0, height = 0;
    take_number(root, "window_width", 0, greatest_window, &width);
    take_number(root, "window_height", 0, greatest_window, &height);
    preferences->window_width = (int)width;
    preferences->window_height = (int)height;
    take_recent(root, preferences);
    ang_json_close(&json);
    return true;
}

static char *print(const ang_preferences *preferences) {
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "theme", preferences->light_theme ? "light" : "dark");
    ang_json_add_number(root, "split_across", preferences->split_across);
    ang_json_add_number(root, "split_down", preferences->split_down);
    ang_json_add_number(root, "panel_width", preferences->panel_width);
    cJSON_AddBoolToObject(root, "panel_hidden", preferences->panel_hidden);
    cJSON_AddBoolToObject(root, "corner_text", preferences->corner_text);
    cJSON_AddBoolToObject(root, "crosshair", preferences->crosshair);
    cJSON_AddNumberToObject(root, "window_width", preferences->window_width);
    cJSON_AddNumberToObject(root, "window_height", preferences->window_height);
    cJSON *list = cJSON_AddArrayToObject(root, "recent");
    for (int i = 0; i < preferences->recent_count; i++)
        cJSON_AddItemToArray(list, cJSON_CreateString(preferences->recent[i]));
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

bool ang_preferences_write(const char *path, const ang_preferences *preferences, ang_error *err) {
    const char *slash = strrchr(path, '/');
    char folder[4096];
    if (slash && (size_t)(slash - path) >= sizeof folder)
        return ang_fail(err, ANG_OUTPUT, "%s: is too long a name", path);
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path) : 1, slash ? path : ".");
    char *text = print(preferences);
    if (!text) return ang_fail(err, ANG_LIMIT, "no memory for the preferences");
    bool written = (!folder[0] || ang_folder_make(folder, err)) && ang_file_replace(path, text, strlen(text), err);
    free(text);
    return written;
}
