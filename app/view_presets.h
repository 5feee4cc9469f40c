/* The presets that the viewer offers: those of the folders, and the user's own that it saves and deletes. */
#ifndef ANG_APP_VIEW_PRESETS_H
#define ANG_APP_VIEW_PRESETS_H

#include "app/options.h"
#include "ui/viewer.h"

enum { ANG_VIEW_MOST_PRESETS = 126 };

/* Zero-initialise but for `options`. */
typedef struct ang_view_presets {
    const ang_options *options;
    ang_preset *list[ANG_VIEW_MOST_PRESETS + 2]; /* NULL at the end */
    int count;
    char asked[256]; /* the name of the one that was asked for; empty: none */
} ang_view_presets;

/* Reads the folders' presets; one that cannot be read is said and left out. The one that was asked for comes first, and
 * `*chosen` (of `presets`) is its name, else NULL. False with what ang_preset_find gives where that one is not found.
 */
bool ang_view_presets_read(ang_view_presets *presets, const char **chosen, ang_error *err);
void ang_view_presets_clear(ang_view_presets *presets);

/* ang_viewer_host's, with an ang_view_presets as context. */
ang_preset_place ang_view_preset_place(void *context, const char *name);
bool ang_view_preset_save(void *context, const ang_document *document, const char *name, const char *description,
                          char *path, size_t size, ang_error *err);
bool ang_view_preset_is_file(const char *file);
bool ang_view_preset_import(void *context, const char *file, char *first, size_t first_size, char *said,
                            size_t said_size, ang_error *err);
bool ang_view_preset_delete(void *context, const char *name, ang_error *err);

#endif
