/* Parts of the program that lie in files of their own, opened when they are first needed, since the libraries that they
 * bring would cost every start. Private to io/. */
#ifndef ANG_IO_MODULE_H
#define ANG_IO_MODULE_H

#include "core/base/error.h"

#include <stddef.h>

/* Where the file `file` (a plain name) of the program lies: beside it, above its tests or where modules are installed.
 * False where it is in none of these, or the path is longer than `size`. Thread safe. */
bool ang_module_path(const char *file, char *path, size_t size);

/* What the module `file` (a plain name) exports as `symbol`. It stays open. NULL with `code` and a message that names
 * `what` the module is for. Thread safe. */
const void *ang_module_symbol(const char *file, const char *symbol, const char *what, ang_code code, ang_error *err);

#endif
