#include "io/dicom/disc.h"

#include "io/dicom/slice.h"

#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { most_parts = 16, longest_part = 64 };

/* A name in a folder; `below` is what is in it, once that has been asked for. */
typedef struct entry {
    char *name;
    struct ang_dicom_disc *below;
} entry;

/* One folder; the disc is its outermost. */
struct ang_dicom_disc {
    char *path;
    entry *entries; /* in the order of `compare` */
    size_t count;
};

/* Spellings of one name lie side by side. */
static int compare(const void *left, const void *right) {
    const char *a = ((const entry *)left)->name, *b = ((const entry *)right)->name;
    int order = strcasecmp(a, b);
    return order ? order : strcmp(a, b);
}

static void read_names(ang_dicom_disc *folder) {
    size_t room = 0;
    DIR *directory = opendir(folder->path);
    for (struct dirent *found; directory && (found = readdir(directory));) {
        if (folder->count == room) {
            size_t wanted = room ? 2 * room : 64;
            entry *grown = realloc(folder->entries, wanted * sizeof *grown);
            if (!grown) break;
            folder->entries = grown;
            room = wanted;
        }
        char *name = strdup(found->d_name);
        if (!name) break;
        folder->entries[folder->count++] = (entry){.name = name};
    }
    if (directory) closedir(directory);
    if (folder->count) qsort(folder->entries, folder->count, sizeof *folder->entries, compare);
}

ang_dicom_disc *ang_dicom_disc_open(const char *path) {
    ang_dicom_disc *folder = calloc(1, sizeof *folder);
    if (!folder || !(folder->path = strdup(path))) {
        free(folder);
        return NULL;
    }
    read_names(folder);
    return folder;
}

void ang_dicom_disc_close(ang_dicom_disc *folder) {
    if (!folder) return;
    for (size_t i = 0; i < folder->count; i++) {
        free(folder->entries[i].name);
        ang_dicom_disc_close(folder->entries[i].below); /* most_parts deep at most */
    }
    free(folder->entries);
    free(folder->path);
    free(folder);
}

/* The entry of this name in any case, the same case rather than another; NULL where there is none. */
static entry *find_spelt(ang_dicom_disc *folder, const char *name) {
    size_t low = 0, high = folder->count;
    const entry wanted = {.name = (char *)name};
    entry *exact =
        folder->count ? bsearch(&wanted, folder->entries, folder->count, sizeof *folder->entries, compare) : NULL;
    if (exact) return exact;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (strcasecmp(folder->entries[middle].name, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < folder->count && strcasecmp(folder->entries[low].name, name) == 0 ? &folder->entries[low] : NULL;
}

/* The entry that a name in the index stands for: upper case there, often lower here; ISO 9660 adds a version. */
static entry *find_entry(ang_dicom_disc *folder, const char *name) {
    static const char *const endings[] = {"", ".", ";1", ".;1"};
    char lower[longest_part + 1] = "", spelt[longest_part + 4];
    for (size_t i = 0; name[i] && i < longest_part; i++) lower[i] = (char)tolower((unsigned char)name[i]);
    entry *found = find_spelt(folder, name), *usual;
    if (found && strcmp(found->name, name) != 0 && (usual = find_spelt(folder, lower))) found = usual;
    for (size_t i = 1; !found && i < sizeof endings / sizeof *endings; i++) {
        snprintf(spelt, sizeof spelt, "%s%s", name, endings[i]);
        found = find_spelt(folder, spelt);
    }
    return found;
}

/* The path of an entry, to be freed, where it is what `type` (S_IFREG, S_IFDIR) says; NULL where not. */
static char *path_of(const ang_dicom_disc *folder, const entry *entry, mode_t type) {
    struct stat status;
    char *path = NULL;
    if (asprintf(&path, "%s/%s", folder->path, entry->name) < 0) return NULL;
    /* A link to a folder may lead back here. */
    int failed = type == S_IFDIR ? lstat(path, &status) : stat(path, &status);
    if (!failed && (status.st_mode & S_IFMT) == type) return path;
    free(path);
    return NULL;
}

/* The folder of an entry; NULL where it is none. */
static ang_dicom_disc *enter(const ang_dicom_disc *folder, entry *entry) {
    char *path = entry->below ? NULL : path_of(folder, entry, S_IFDIR);
    if (path) entry->below = ang_dicom_disc_open(path);
    free(path);
    return entry->below;
}

char *ang_dicom_disc_find(ang_dicom_disc *folder, const char *id) {
    entry *found = NULL;
    for (int i = 0; i < most_parts; i++) {
        char part[longest_part + 1];
        ang_dicom_value(id, i, part, sizeof part);
        if (!part[0]) break;
        if (found) folder = enter(folder, found);
        bool leads_away = strchr(part, '/') || strcmp(part, ".") == 0 || strcmp(part, "..") == 0;
        found = folder && !leads_away ? find_entry(folder, part) : NULL;
        if (!found) return NULL;
    }
    return found ? path_of(folder, found, S_IFREG) : NULL;
}
