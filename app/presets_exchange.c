/* angioscope presets import, export: presets from and for 3D Slicer. */
#include "app/presets.h"
#include "app/verbs.h"
#include "io/preset/preset.h"
#include "io/preset/preset_own.h"
#include "io/preset/slicer/property.h"
#include "io/replace.h"
#include "io/text.h"

#include <stdlib.h>
#include <string.h>

/* The names of a file's properties, for messages. */
static void list_names(const ang_property_list *list, char *text, size_t size) {
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < list->count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", list->item[i].name);
}

/* A name that its file can have: what a file's name must not hold becomes '-'. */
static void own_name(const char *name, char out[ANG_PRESET_NAME_LENGTH + 1]) {
    size_t length = 0;
    for (; *name && length < ANG_PRESET_NAME_LENGTH; name++) {
        unsigned char c = (unsigned char)*name;
        bool edge = length == 0 && (c == ' ' || c == '.' || c == '-');
        if (!edge) out[length++] = c < ' ' || c == 127 || c == '/' ? '-' : (char)c;
    }
    if (*name) length = ang_text_cut(name - length, length);
    while (length > 0 && (out[length - 1] == ' ' || out[length - 1] == '.')) length--;
    out[length] = '\0';
}

static bool is_wanted(const ang_options *options, const char *name) {
    if (options->argument_count <= 2) return true;
    for (int i = 2; i < options->argument_count; i++)
        if (strcmp(options->arguments[i], name) == 0) return true;
    return false;
}

/* That every name which was asked for is there, and one alone where there is one output. */
static bool check_wanted(const ang_options *options, const ang_property_list *list, ang_error *err) {
    const char *file = options->arguments[1];
    char names[700];
    size_t wanted = 0;
    list_names(list, names, sizeof names);
    for (size_t i = 0; i < list->count; i++) wanted += is_wanted(options, list->item[i].name);
    for (int k = 2; k < options->argument_count; k++) {
        bool found = false;
        for (size_t i = 0; i < list->count && !found; i++)
            found = strcmp(list->item[i].name, options->arguments[k]) == 0;
        if (!found)
            return ang_fail(err, ANG_USAGE, "%s: holds no preset \"%.100s\"; it holds: %s", file, options->arguments[k],
                            names);
    }
    if (options->output && wanted != 1)
        return ang_fail(err, ANG_USAGE, "%s: holds %zu presets and -o takes one; name it behind the file: %s", file,
                        list->count, names);
    return true;
}

/* Nothing is written over one of the user's presets unless he says so. */
static bool check_free(const ang_options *options, const ang_property_list *list, ang_error *err) {
    char name[ANG_PRESET_NAME_LENGTH + 1];
    for (size_t i = 0; i < list->count && !options->output && !options->replace; i++) {
        own_name(list->item[i].name, name);
        if (is_wanted(options, list->item[i].name) && ang_preset_own_exists(name))
            return ang_fail(err, ANG_USAGE, "there is a preset \"%s\" of your own; --replace writes over it", name);
    }
    return true;
}

/* Nor one preset of the file over another. */
static bool check_distinct(const ang_options *options, const ang_property_list *list, ang_error *err) {
    char name[ANG_PRESET_NAME_LENGTH + 1], other[ANG_PRESET_NAME_LENGTH + 1];
    for (size_t i = 0; i < list->count; i++) {
        if (!is_wanted(options, list->item[i].name)) continue;
        own_name(list->item[i].name, name);
        for (size_t k = 0; k < i; k++) {
            own_name(list->item[k].name, other);
            if (strcmp(name, other) == 0 && is_wanted(options, list->item[k].name))
                return ang_fail(err, ANG_USAGE, "%s: two of its presets would be called \"%s\"; rename one in the file",
                                options->arguments[1], name);
        }
    }
    return true;
}

static bool write_one(const ang_options *options, const ang_preset *preset, char *path, size_t size, ang_error *err) {
    char *text = ang_preset_print(preset, err);
    bool written = false;
    if (text && options->output) {
        snprintf(path, size, "%s", options->output);
        written = ang_file_replace(path, text, strlen(text), err);
    } else if (text) {
        written = ang_preset_own_save(preset->name, text, path, size, err);
    }
    free(text);
    return written;
}

bool ang_app_preset_import(const char *file, const ang_property *property, ang_preset **preset, ang_notes *notes,
                           ang_error *err) {
    ang_error own = {0};
    char name[ANG_PRESET_NAME_LENGTH + 1];
    *preset = ang_property_to_preset(property, notes, &own);
    if (!*preset) return ang_fail(err, own.code, "%s: %s", file, own.message);
    own_name((*preset)->name, name);
    char *copy = strdup(name);
    if (!copy || !ang_preset_name_check(name, &own)) {
        free(copy);
        ang_preset_free(*preset);
        *preset = NULL;
        return copy ? ang_fail(err, own.code, "%s: %s", file, own.message) : ang_fail(err, ANG_LIMIT, "no memory");
    }
    free((*preset)->name);
    (*preset)->name = copy;
    return true;
}

static bool import_all(const ang_options *options, const ang_property_list *list, ang_notes *notes, ang_error *err) {
    char path[4200];
    for (size_t i = 0; i < list->count; i++) {
        if (!is_wanted(options, list->item[i].name)) continue;
        ang_preset *preset;
        bool done = ang_app_preset_import(options->arguments[1], &list->item[i], &preset, notes, err) &&
                    write_one(options, preset, path, sizeof path, err);
        if (done && !options->quiet) fprintf(stderr, "%s: %s\n", preset->name, path);
        ang_preset_free(preset);
        if (!done) return false;
    }
    return true;
}

int ang_app_presets_import(const ang_options *options, ang_error *err) {
    ang_property_list list;
    ang_notes notes = {0};
    if (options->output && !ang_file_replaceable(options->output, err)) return (int)err->code;
    if (!ang_property_read(options->arguments[1], &list, err)) return (int)err->code;
    bool done = check_wanted(options, &list, err) && check_free(options, &list, err) &&
                check_distinct(options, &list, err) && import_all(options, &list, &notes, err);
    if (!options->quiet) ang_app_say(&notes, "note: ", NULL);
    ang_notes_clear(&notes);
    ang_property_list_clear(&list);
    return done ? ANG_OK : (int)err->code;
}

static bool gather(const ang_options *options, ang_property_form form, ang_property_list *list, ang_notes *notes,
                   ang_error *err) {
    size_t count = (size_t)options->argument_count - 1;
    list->item = calloc(count, sizeof *list->item);
    if (!list->item) return ang_fail(err, ANG_LIMIT, "no memory for presets");
    for (size_t i = 0; i < count; i++) {
        const char *name = options->arguments[i + 1];
        ang_preset *preset = ang_preset_find(name, ang_app_preset_folders(), err);
        if (!preset) return false;
        if (ang_preset_is_path(name) && ang_file_same(name, options->output)) {
            ang_preset_free(preset);
            return ang_fail(err, ANG_USAGE, "-o %s: is read as preset; give the output another name", options->output);
        }
        bool made = ang_property_from_preset(preset, form == ANG_PROPERTY_JSON, &list->item[i], notes, err);
        ang_preset_free(preset);
        if (!made) return false;
        list->count++;
    }
    return true;
}

int ang_app_presets_export(const ang_options *options, ang_error *err) {
    ang_property_form form = options->output ? ang_property_form_of(options->output) : ANG_PROPERTY_NONE;
    if (form == ANG_PROPERTY_NONE) {
        ang_fail(err, ANG_USAGE, "presets export: give a file to write with -o X.vp, X.vp.json or X.xml");
        return ANG_USAGE;
    }
    ang_property_list list = {0};
    ang_notes notes = {0};
    bool done = ang_file_replaceable(options->output, err) && gather(options, form, &list, &notes, err);
    char *text = done ? ang_property_print(form, &list, &notes, err) : NULL;
    done = text && ang_file_replace(options->output, text, strlen(text), err);
    if (!options->quiet) ang_app_say(&notes, "note: ", NULL);
    free(text);
    ang_notes_clear(&notes);
    ang_property_list_clear(&list);
    return done ? ANG_OK : (int)err->code;
}
