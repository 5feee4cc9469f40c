#include "ui/state/source.h"

#include <stdlib.h>
#include <string.h>

ang_source ang_source_make(const char *const *paths, size_t count, int series) {
    ang_source source = {.paths = calloc(count ? count : 1, sizeof *source.paths), .series = series};
    bool ok = source.paths != NULL;
    for (size_t i = 0; i < count && ok; i++) {
        source.paths[i] = strdup(paths[i]);
        ok = source.paths[i] != NULL;
        source.count += ok;
    }
    if (!ok || count == 0) ang_source_clear(&source);
    return source;
}

ang_source ang_source_of_series(const ang_source *source, int series) {
    return ang_source_make((const char *const *)source->paths, source->count, series);
}

void ang_source_move(ang_source *to, ang_source *from) {
    ang_source_clear(to);
    *to = *from;
    *from = (ang_source){0};
}

void ang_source_clear(ang_source *source) {
    for (size_t i = 0; i < source->count; i++) free(source->paths[i]);
    free(source->paths);
    *source = (ang_source){0};
}

bool ang_source_same_files(const ang_source *a, const ang_source *b) {
    if (a->count != b->count) return false;
    for (size_t i = 0; i < a->count; i++)
        if (strcmp(a->paths[i], b->paths[i]) != 0) return false;
    return true;
}
