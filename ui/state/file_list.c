#include "ui/state/file_list.h"

#include "core/base/name_order.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

void ang_file_list_add(ang_file_list *list, const char *name, bool folder, long long bytes) {
    if (list->count == list->room) {
        size_t room = list->room ? 2 * list->room : 64;
        ang_file_entry *grown = realloc(list->entry, room * sizeof *grown);
        if (!grown) return;
        list->entry = grown;
        list->room = room;
    }
    char *copy = strdup(name);
    if (!copy) return;
    bool image = !folder && ang_name_could_be_image(name);
    list->entry[list->count++] = (ang_file_entry){copy, folder, image, bytes};
}

void ang_file_list_clear(ang_file_list *list) {
    for (size_t i = 0; i < list->count; i++) free(list->entry[i].name);
    free(list->entry);
    *list = (ang_file_list){0};
}

static size_t digits(const char *text) { return strspn(text, "0123456789"); }

static int compare_entries(const void *left, const void *right) {
    const ang_file_entry *a = left, *b = right;
    if (a->folder != b->folder) return a->folder ? -1 : 1;
    return ang_name_compare(a->name, b->name);
}

void ang_file_list_sort(ang_file_list *list) {
    if (list->count > 1) qsort(list->entry, list->count, sizeof *list->entry, compare_entries);
}

/* A state or a picture that carries one. */
static bool is_own(const char *name) { return strncmp(name, "angioscope-", 11) == 0; }

bool ang_file_list_is_series(const ang_file_list *list) {
    bool images = false;
    for (size_t i = 0; i < list->count; i++) {
        const ang_file_entry *entry = &list->entry[i];
        if ((entry->folder && entry->name[0] != '.') || is_own(entry->name)) return false;
        images = images || (entry->image && entry->name[0] != '.');
    }
    return images;
}

static bool ends_in(const char *name, const char *ending) {
    size_t length = strlen(name), end = strlen(ending);
    return length > end && strcasecmp(name + length - end, ending) == 0;
}

bool ang_name_could_be_preset(const char *name) {
    return ends_in(name, ".vp") || ends_in(name, ".vp.json") || ends_in(name, ".xml");
}

bool ang_name_could_be_image(const char *name) {
    static const char *const endings[] = {".dcm",  ".dicom", ".ima", ".nii", ".nii.gz", ".hdr",  ".raw", ".raw.gz",
                                          ".nrrd", ".nhdr",  ".mha", ".mhd", ".tif",    ".tiff", ".png", ".zip"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (ends_in(name, endings[i])) return true;
    const char *dot = strrchr(name, '.');
    return !dot || (dot[1] && digits(dot + 1) == strlen(dot + 1));
}

static bool begins_with(const char *name, const char *typed) { return strncasecmp(name, typed, strlen(typed)) == 0; }

static bool is_listed(const ang_file_entry *entry, ang_file_filter filter, const char *typed) {
    if (entry->name[0] == '.' && !filter.hidden && typed[0] != '.') return false;
    return entry->folder || entry->image || is_own(entry->name) || ang_name_could_be_preset(entry->name) || filter.all;
}

size_t ang_file_list_show(const ang_file_list *list, ang_file_filter filter, const char *typed, size_t *shown) {
    size_t count = 0;
    for (int within = 0; within < 2 && count == 0; within++)
        for (size_t i = 0; i < list->count; i++) {
            const char *name = list->entry[i].name;
            bool fits = within ? strcasestr(name, typed) != NULL : begins_with(name, typed);
            if (fits && is_listed(&list->entry[i], filter, typed)) shown[count++] = i;
        }
    return count;
}

void ang_file_list_complete(const ang_file_list *list, ang_file_filter filter, const char *typed, char *out,
                            size_t size) {
    const ang_file_entry *first = NULL;
    size_t common = 0, found = 0;
    for (size_t i = 0; i < list->count; i++) {
        const ang_file_entry *entry = &list->entry[i];
        if (!begins_with(entry->name, typed) || !is_listed(entry, filter, typed)) continue;
        size_t same = 0;
        while (first && entry->name[same] && entry->name[same] == first->name[same]) same++;
        common = first ? (same < common ? same : common) : strlen(entry->name);
        if (!first) first = entry;
        found++;
    }
    if (!first || common < strlen(typed))
        snprintf(out, size, "%s", typed);
    else
        snprintf(out, size, "%.*s%s", (int)common, first->name, found == 1 && first->folder ? "/" : "");
}

size_t ang_path_name_at(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

void ang_path_up(char *path) {
    size_t length = strlen(path);
    while (length > 1 && path[length - 1] == '/') length--;
    while (length > 1 && path[length - 1] != '/') length--;
    if (length > 0) path[length] = '\0';
}

bool ang_path_restart(char *path) {
    const char *from = NULL;
    for (const char *p = path; *p; p++)
        if (p[0] == '/' && (p[1] == '/' || (p[1] == '~' && p[2] == '/'))) from = p + 1;
    if (from) memmove(path, from, strlen(from) + 1);
    return from != NULL;
}

void ang_path_expand(const char *typed, const char *home, char *out, size_t size) {
    bool tilde = typed[0] == '~' && (typed[1] == '/' || !typed[1]) && home;
    snprintf(out, size, "%s%s", tilde ? home : "", tilde ? typed + 1 : typed);
}
