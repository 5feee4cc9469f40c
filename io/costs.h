/* The cost models of this machine, measured once and kept in the user's cache. */
#ifndef ANG_IO_COSTS_H
#define ANG_IO_COSTS_H

#include "core/render/calibrate.h"

/* Where they come from, in words. Plain value. */
typedef struct ang_costs_origin {
    char path[512]; /* of the cache's file; empty where there is no place for it */
    char gl[256], processor[128];
    bool cached; /* read, not measured */
} ang_costs_origin;

/* Reads the models of this OpenGL (NULL: none), processor, number of threads and program from
 * $XDG_CACHE_HOME/angioscope or ~/.cache/angioscope; measures those that are not there, all where the file cannot be
 * read or is of something else, and writes them. A cache that cannot be written is done without. False with ANG_LIMIT,
 * ANG_INTERRUPTED. */
bool ang_costs_load(ang_gl *gl, ang_costs *costs, ang_costs_origin *origin, const ang_progress *progress,
                    ang_error *err);

/* Reads a cache's file. False, and no models, where it cannot be read, is damaged or is of another `key` than it was
 * written for. */
bool ang_costs_read(const char *path, const char *key, ang_costs *costs);

/* Drops a model that has proved wrong from the cache, so that the next ang_costs_load measures it anew. False where it
 * is not in there. */
bool ang_costs_forget(const ang_costs_origin *origin, const char *method);

#endif
