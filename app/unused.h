/* Options that leave a picture as it is, beside those that a method does not take: to be said, not passed over. */
#ifndef ANG_APP_UNUSED_H
#define ANG_APP_UNUSED_H

#include "app/options.h"
#include "app/picture.h"
#include "core/base/notes.h"
#include "core/render/method.h"

/* A sentence for each option of render's command line that has no effect on this picture and its files. */
void ang_app_note_unused(const ang_options *options, const ang_picture *picture, const ang_method *method,
                         ang_notes *notes);

/* Whether an action of the verb presets takes every option that was given. False with ANG_USAGE. */
bool ang_app_presets_options_check(const char *action, const ang_options *options, ang_error *err);

#endif
