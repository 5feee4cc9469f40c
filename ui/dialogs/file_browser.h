/* Choosing what to open: a folder's contents, driven by keys and mouse. The path is always being typed: the part behind
 * its last slash picks names out of the folder before it. */
#ifndef ANG_UI_FILE_BROWSER_H
#define ANG_UI_FILE_BROWSER_H

#include "ui/state/file_list.h"

typedef struct ang_viewer ang_viewer;

enum { ANG_PATH_SIZE = 4096 };

/* Zero-initialise; free with ang_file_browser_clear. */
typedef struct ang_file_browser {
    bool open;
    char path[ANG_PATH_SIZE];   /* as typed: a folder, a slash, and the beginning of a name */
    char listed[ANG_PATH_SIZE]; /* the folder that `list` is of, with a slash at its end; empty: none */
    ang_file_list list;
    size_t *shown; /* indices into `list`, as many as listed */
    size_t shown_count;
    int chosen; /* row; -1: none */
    ang_file_filter filter;
    char typed[ANG_PATH_SIZE]; /* the name's beginning that `shown` is of */
    char failure[512];         /* why the folder cannot be listed; empty: it can */
    bool anew;                 /* `path` has been changed by the program */
    bool was_folder;           /* `path` ended with a slash before this frame's keys */
    bool follow;               /* the list is to scroll to the chosen row */
} ang_file_browser;

void ang_file_browser_open(ang_viewer *viewer);
void ang_file_browser_show(ang_viewer *viewer);
void ang_file_browser_clear(ang_file_browser *files);

#endif
