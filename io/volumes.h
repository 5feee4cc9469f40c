/* Files of one volume each, several in one input, as a list of series. Private to io/. */
#ifndef ANG_IO_VOLUMES_H
#define ANG_IO_VOLUMES_H

#include "io/kind.h"

/* Which of them `options` ask for, by its number or by how the name of its file ends: the first, where they do not say.
 * False with ANG_INPUT. */
bool ang_volumes_choose(const ang_found *found, const ang_load_options *options, size_t *index, ang_error *err);

/* The report's list, without a voxel being read: size and phases where headers tell them, else 0 and 1. A header that
 * is wrong is an entry that cannot be loaded; where it is the only one, false with its error. Else false with
 * ANG_LIMIT. */
bool ang_volumes_list(const ang_found *found, ang_load_report *report, ang_error *err);

/* Puts the series of one volume, which a reader has listed, into the list of all, as that of `index`. */
bool ang_volumes_list_around(const ang_found *found, size_t index, ang_load_report *report, ang_error *err);

#endif
