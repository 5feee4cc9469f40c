/* Files and folders as the file browser lists them, and paths as text. Pure: nothing here looks at a disk. */
#ifndef ANG_UI_FILE_LIST_H
#define ANG_UI_FILE_LIST_H

#include <stdbool.h>
#include <stddef.h>

typedef struct ang_file_entry {
    char *name; /* without folder */
    bool folder;
    bool image;      /* by its name it could be one */
    long long bytes; /* of a file */
} ang_file_entry;

/* What a folder holds. Owns its entries; zero-initialise. */
typedef struct ang_file_list {
    ang_file_entry *entry;
    size_t count, room;
} ang_file_list;

/* Appends; where memory is out nothing is appended. */
void ang_file_list_add(ang_file_list *list, const char *name, bool folder, long long bytes);
void ang_file_list_clear(ang_file_list *list);
/* Folders first, each by ang_name_compare. */
void ang_file_list_sort(ang_file_list *list);
/* Whether it is a folder to be opened as a whole: it holds what could be images, no folder to go into and no file of
 * this program's own. */
bool ang_file_list_is_series(const ang_file_list *list);

/* Whether a file of this name could be an image: it has the ending of a format that is read, none, or one of digits, as
 * files named by a UID have. */
bool ang_name_could_be_image(const char *name);

/* Whether a file of this name could hold presets of 3D Slicer. */
bool ang_name_could_be_preset(const char *name);

/* What is listed. */
typedef struct ang_file_filter {
    bool hidden; /* names that begin with a dot too */
    bool all;    /* files that cannot be images too */
} ang_file_filter;
/* Indices of the entries that are listed and whose names begin with `typed`, without regard to case; where there is
 * none, of those that hold it. `shown` has room for list->count. Hidden names are listed too where `typed` begins with
 * a dot. Returns their number. */
size_t ang_file_list_show(const ang_file_list *list, ang_file_filter filter, const char *typed, size_t *shown);
/* As much as the names that begin with `typed` have in common, `typed` itself where none does; with a slash at its end
 * where it is one folder. */
void ang_file_list_complete(const ang_file_list *list, ang_file_filter filter, const char *typed, char *out,
                            size_t size);

/* Where the name begins in a path: behind its last slash. */
size_t ang_path_name_at(const char *path);
/* Takes the last name off a path that ends in a slash, which stays at the end: "/a/b/" becomes "/a/"; "/" stays. */
void ang_path_up(char *path);
/* A whole path typed or pasted behind a folder takes its place: "/a/b//c" becomes "/c", "/a/~/c" becomes "~/c". False
 * where there is none. */
bool ang_path_restart(char *path);
/* "~" and "~/..." with the home folder for the tilde, other text as it is. */
void ang_path_expand(const char *typed, const char *home, char *out, size_t size);

#endif
