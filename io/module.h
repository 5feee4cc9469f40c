/* Parts of the program that lie in files of their own, opened when they are first needed, since the libraries that they
 * bring would cost every start. Private to io/. */
#ifndef ANG_IO_MODULE_H
#define ANG_IO_MODULE_H

#include "core/base/error.h"

/* What the module `file` (a plain name) exports as `symbol`. The module is looked for beside the program, above its
 * tests and where it is installed, and stays open. NULL with `code` and a message that names `what` the module is for.
 * Thread safe. */
const void *ang_module_symbol(const char *file, const char *symbol, const char *what, ang_code code, ang_error *err);

#endif
