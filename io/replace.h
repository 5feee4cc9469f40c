/* Files appear whole or not at all. */
#ifndef ANG_IO_REPLACE_H
#define ANG_IO_REPLACE_H

#include "core/base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Writes `size` bytes to `path`: into a temporary file of the same folder, flushed to the disk (fsync), then renamed
 * over `path` (POSIX rename: readers see the old file or the new one, whatever else writes there or is killed). A
 * symbolic link stays one and what it leads to is replaced; permissions, owner and group of an existing file stay as
 * far as we may set them; other names of it (hard links) keep the old bytes. False with ANG_OUTPUT, naming `path` and
 * the system's reason; the temporary file is removed and an existing `path` left as it was. A `path` that exists and is
 * no regular file (a folder, a device) or may not be written to is refused. Thread safe. */
bool ang_file_replace(const char *path, const void *data, size_t size, ang_error *err);

/* The same to a `path` that is not there: where it is, or comes to be meanwhile, *taken becomes true and what is there
 * stays. False with ANG_OUTPUT. Thread safe. */
bool ang_file_create(const char *path, const void *data, size_t size, bool *taken, ang_error *err);

/* Whether ang_file_replace could write to `path` as things stand: to be asked before long work. False with ANG_OUTPUT.
 * Thread safe. */
bool ang_file_replaceable(const char *path, ang_error *err);

/* The same in two steps, for files that belong together or that others write. First a temporary file is made in the
 * folder of `path`, with these bytes, or empty with `ending` (such as ".mp4") behind its name; false with ANG_OUTPUT,
 * and then there is none and `temporary` is empty. Once all is written, ang_file_rename flushes it to the disk and
 * renames it over `path`; false with ANG_OUTPUT, and then the temporary file is the caller's to remove. */
bool ang_file_prepare(const char *path, const void *data, size_t size, char *temporary, size_t room, ang_error *err);
bool ang_file_temporary(const char *path, const char *ending, char *temporary, size_t size, ang_error *err);
bool ang_file_rename(const char *temporary, const char *path, ang_error *err);

/* Whether a file of this name (without folder) is a temporary one of the above: left where a process was killed in the
 * middle, and never to be read. */
bool ang_file_leftover(const char *name);

/* Whether two paths, however spelt, name one file: by device and inode, or by folder and name where there is no file
 * yet. Thread safe. */
bool ang_file_same(const char *a, const char *b);

/* Makes the folder `path` and its parents where they do not exist. False with ANG_OUTPUT. Thread safe. */
bool ang_folder_make(const char *path, ang_error *err);

#endif
