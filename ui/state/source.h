/* What is opened: files and folders that are read as one input, and which of its series. */
#ifndef ANG_UI_SOURCE_H
#define ANG_UI_SOURCE_H

#include <stdbool.h>
#include <stddef.h>

/* Owns its strings; zero: nothing. */
typedef struct ang_source {
    char **paths;
    size_t count;
    int series; /* 1, 2, ... as listed; 0: the reader chooses */
    int phase;  /* of a series of several, from 1; 0: the first */
} ang_source;

/* A copy of the paths; one of nothing where memory is out. */
ang_source ang_source_make(const char *const *paths, size_t count, int series);
/* The same files, another series, its first phase. */
ang_source ang_source_of_series(const ang_source *source, int series);
/* Lets go of what `to` was; `from` is nothing then. */
void ang_source_move(ang_source *to, ang_source *from);
void ang_source_clear(ang_source *source);
/* Whether both are of the same files, whatever the series. */
bool ang_source_same_files(const ang_source *a, const ang_source *b);

#endif
