#include "app/view_presets.h"

#include "app/presets.h"
#include "app/verbs.h"
#include "app/view_state.h"
#include "io/preset/preset.h"
#include "io/preset/preset_own.h"
#include "io/text.h"

#include <stdlib.h>
#include <string.h>

/* `must`: the one that was asked for has to be there. */
static bool read_all(ang_view_presets *presets, bool must, const char **chosen, ang_error *err) {
    ang_preset_names names;
    const char *wanted = presets->options->preset;
    ang_preset *asked = wanted ? ang_preset_find(wanted, ang_app_preset_folders(), err) : NULL;
    if (wanted && !asked && must) return false;
    if (asked) presets->list[presets->count++] = asked;
    snprintf(presets->asked, sizeof presets->asked, "%s", asked ? asked->name : "");
    *chosen = asked ? presets->asked : NULL;
    if (!ang_preset_list(ang_app_preset_folders(), &names, err)) return false;
    for (size_t i = 0; i < names.count && presets->count < ANG_VIEW_MOST_PRESETS; i++) {
        ang_error broken = {0};
        if (*chosen && strcmp(names.names[i], *chosen) == 0) continue;
        ang_preset *preset = ang_preset_load(names.paths[i], &broken);
        if (preset)
            presets->list[presets->count++] = preset;
        else
            fprintf(stderr, "warning: %s\n", broken.message);
    }
    ang_preset_names_clear(&names);
    return true;
}

bool ang_view_presets_read(ang_view_presets *presets, const char **chosen, ang_error *err) {
    return read_all(presets, true, chosen, err);
}

void ang_view_presets_clear(ang_view_presets *presets) {
    for (int i = 0; i < presets->count; i++) ang_preset_free(presets->list[i]);
    memset(presets->list, 0, sizeof presets->list);
    presets->count = 0;
}

/* After a change in the user's folder. */
static void read_again(ang_view_presets *presets) {
    const char *chosen;
    ang_error err = {0};
    ang_view_presets_clear(presets);
    if (!read_all(presets, false, &chosen, &err)) fprintf(stderr, "angioscope: %s\n", err.message);
}

ang_preset_place ang_view_preset_place(void *context, const char *name) {
    const ang_view_presets *presets = context;
    if (ang_preset_own_exists(name)) return ANG_PRESET_AT_OWN;
    for (int i = 0; i < presets->count; i++)
        if (strcmp(presets->list[i]->name, name) == 0) return ANG_PRESET_AT_INSTALLED;
    return ANG_PRESET_AT_NOWHERE;
}

bool ang_view_preset_save(void *context, const ang_document *document, const char *name, const char *description,
                          char *path, size_t size, ang_error *err) {
    char *text = ang_view_preset_print(document, name, description, err);
    bool saved = text && ang_preset_own_save(name, text, path, size, err);
    free(text);
    if (saved) read_again(context);
    return saved;
}

bool ang_view_preset_delete(void *context, const char *name, ang_error *err) {
    bool deleted = ang_preset_own_delete(name, err);
    if (deleted) read_again(context);
    return deleted;
}

bool ang_view_preset_is_file(const char *file) { return ang_property_form_of(file) != ANG_PROPERTY_NONE; }

/* A name that no preset of the user's own has: "CT-AAA", "CT-AAA 2", ... */
static bool free_name(const char *wanted, char *name, size_t size) {
    enum { most = ANG_PRESET_NAME_LENGTH - 4 };
    size_t length = strlen(wanted);
    snprintf(name, size, "%s", wanted);
    for (int i = 2; i < 1000 && ang_preset_own_exists(name); i++)
        snprintf(name, size, "%.*s %d", (int)ang_text_cut(wanted, length < most ? length : most), wanted, i);
    return !ang_preset_own_exists(name);
}

static bool import_one(const char *file, const ang_property *property, char *name, size_t size, ang_notes *notes,
                       ang_error *err) {
    ang_preset *preset;
    char path[4200];
    if (!ang_app_preset_import(file, property, &preset, notes, err)) return false;
    bool named = free_name(preset->name, name, size) ||
                 ang_fail(err, ANG_USAGE, "there are too many presets called %s", preset->name);
    free(preset->name);
    preset->name = strdup(name);
    char *text = named && preset->name ? ang_preset_print(preset, err) : NULL;
    bool saved = text && ang_preset_own_save(name, text, path, sizeof path, err);
    free(text);
    ang_preset_free(preset);
    return saved;
}

bool ang_view_preset_import(void *context, const char *file, char *first, size_t first_size, char *said,
                            size_t said_size, ang_error *err) {
    ang_property_list list;
    ang_notes notes = {0};
    size_t done = 0;
    if (!ang_property_read(file, &list, err)) return false;
    for (; done < list.count; done++) {
        char name[ANG_PRESET_NAME_LENGTH + 1];
        if (!import_one(file, &list.item[done], name, sizeof name, &notes, err)) break;
        if (done == 0) snprintf(first, first_size, "%s", name);
    }
    read_again(context);
    ang_app_say(&notes, "note: ", NULL);
    int used = snprintf(said, said_size, "Imported %zu preset%s", done, ang_plural((long long)done));
    /* What is said first is about a preset; what is assumed of all comes behind. */
    for (size_t i = 0; i < notes.count && (size_t)used < said_size; i++)
        used += snprintf(said + used, said_size - (size_t)used, "%s%s", i ? "; " : ": ", notes.text[i]);
    bool all = done == list.count;
    ang_notes_clear(&notes);
    ang_property_list_clear(&list);
    return all;
}
