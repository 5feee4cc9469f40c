/* From command-line options to the scene of a picture. */
#ifndef ANG_APP_PICTURE_H
#define ANG_APP_PICTURE_H

#include "app/options.h"
#include "app/verbs.h"
#include "core/base/notes.h"
#include "core/render/method.h"
#include "core/scene/objects.h"
#include "core/scene/scene.h"
#include "core/transfer/preset.h"
#include "io/load.h"

/* A scene with what it borrows. Zero-initialise; free with ang_picture_clear. */
typedef struct ang_picture {
    ang_preset *preset;
    ang_transfer *shifted; /* where --shift moved the preset's */
    double shift_hu;
    ang_view view;
    ang_objects objects; /* what the scene borrows */
    ang_scene scene;
    ang_render_options render;
    int every;    /* every so many pixels along each axis are drawn, those between interpolated; 1: all */
    bool lookups; /* not the picture is wanted but how many samples each of its pixels took */
} ang_picture;

/* Reads the preset that the user named, where there is one, so that a broken preset or option is refused before the
 * volume is read. False with what reading the preset gives. */
bool ang_picture_start(const ang_options *options, ang_picture *picture, ang_error *err);
/* Fills `picture`, after ang_picture_start, for this volume. Sentences about choices made for the user go to
 * `assumptions`. False with ANG_USAGE, naming the option, or what reading the preset gives. */
bool ang_picture_make(const ang_options *options, const ang_volume *volume, const ang_load_report *report,
                      ang_picture *picture, ang_notes *assumptions, ang_error *err);
/* Makes the scene, which is otherwise there, show picture->preset, as ang_picture_make does. */
bool ang_picture_use_preset(const ang_options *options, ang_picture *picture, ang_notes *assumptions, ang_error *err);
/* Both with the loading of options->arguments[0] between them, as every verb that draws begins. Tells the user, unless
 * quiet, what was chosen for him, which is added to the report's assumptions. `milliseconds` is that of loading. False
 * as these and ang_load; what has been made by then is the caller's to free. */
bool ang_picture_open(const ang_options *options, const ang_app_progress *progress, ang_volume **volume,
                      ang_load_report *report, ang_picture *picture, double *milliseconds, ang_error *err);
/* The preset where none is named: one that suits the values, said in `assumptions`. Free with ang_preset_free. */
ang_preset *ang_picture_choose_preset(const ang_options *options, const ang_volume *volume,
                                      const ang_load_report *report, ang_notes *assumptions, ang_error *err);
void ang_picture_clear(ang_picture *picture);

#endif
