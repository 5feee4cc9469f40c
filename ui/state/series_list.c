#include "ui/state/series_list.h"

#include "core/base/notes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool ang_series_list_make(ang_series_list *list, size_t count) {
    ang_series_list_clear(list);
    list->entry = calloc(count ? count : 1, sizeof *list->entry);
    if (list->entry) list->count = count;
    return list->entry != NULL;
}

void ang_series_list_clear(ang_series_list *list) {
    free(list->entry);
    *list = (ang_series_list){0};
}

void ang_series_entry_picture(ang_series_entry *entry, const ang_raw_slice *slice) {
    ang_preview *preview = malloc(sizeof *preview);
    if (!preview) return;
    ang_preview_make(slice, ANG_SERIES_PICTURE, preview);
    entry->width = preview->width;
    entry->height = preview->height;
    memcpy(entry->grey, preview->grey, (size_t)preview->width * (size_t)preview->height);
    free(preview);
}

void ang_series_entry_title(const ang_series_entry *entry, bool described, char *text, size_t size) {
    bool named = strcmp(entry->modality, "?") != 0 && entry->modality[0];
    const char *description = described ? entry->description : "";
    snprintf(text, size, "%d  %s%s%s", entry->number, named ? entry->modality : "", named && description[0] ? "  " : "",
             description);
}

void ang_series_entry_verdict(const ang_series_entry *entry, char *text, size_t size) {
    if (!entry->loadable)
        snprintf(text, size, "not a volume: %s", entry->remark);
    else if (entry->warnings > 0)
        snprintf(text, size, "%d warning%s%s%s", entry->warnings, ang_plural(entry->warnings),
                 entry->remark[0] ? "; " : "", entry->remark);
    else
        snprintf(text, size, "%s", entry->remark[0] ? entry->remark : entry->looked_at ? "can be loaded" : "...");
}
