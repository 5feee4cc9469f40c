/* Where the files lie that come with the program: found from where the program is, so that what was installed may be
 * moved as a whole. */
#ifndef ANG_IO_PLACE_H
#define ANG_IO_PLACE_H

#include <stdbool.h>
#include <stddef.h>

/* `path` (of `size` bytes) becomes `relative` seen from the folder of the running program, links followed. Whether
 * something that may be read is there. Thread safe. */
bool ang_place_beside_program(const char *relative, char *path, size_t size);

#endif
