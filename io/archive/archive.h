/* Archives among the inputs, unpacked while they are read. Private to io/. */
#ifndef ANG_ARCHIVE_ARCHIVE_H
#define ANG_ARCHIVE_ARCHIVE_H

#include "core/base/notes.h"
#include "core/base/progress.h"
#include "io/archive/scratch.h"

#include <stddef.h>

/* The paths of an input with the folders of their files in the place of archives. Borrows the other paths. */
typedef struct ang_unpacked {
    const char **path;
    size_t count;
    char **folder; /* the path where it is our folder, named as the archive; NULL: `path` is as it was */
    ang_scratch scratch;
} ang_unpacked;

/* Unpacks those of `paths` that begin like zip archives; files in them that are damaged cost a line in `warnings`.
 * False with ANG_INPUT (damaged, encrypted, larger than an archive of its size should be), ANG_OUTPUT and ANG_LIMIT (no
 * room for the files), ANG_INTERRUPTED. To be cleared in any case. */
bool ang_unpack(const char *const *paths, size_t count, ang_unpacked *unpacked, ang_notes *warnings,
                const ang_progress *progress, ang_error *err);
/* Takes the folder's place out of an error's message: who reads it knows the archive alone. */
void ang_unpacked_name(const ang_unpacked *unpacked, ang_error *err);
/* Removes the files. */
void ang_unpacked_clear(ang_unpacked *unpacked);

#endif
