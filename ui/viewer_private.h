/* The viewer's state; only ui/ includes it. Each part of it is declared by its module. */
#ifndef ANG_UI_VIEWER_PRIVATE_H
#define ANG_UI_VIEWER_PRIVATE_H

#include "core/volume/histogram.h"
#include "ui/actions/palette.h"
#include "ui/dialogs/file_browser.h"
#include "ui/dialogs/preset_dialog.h"
#include "ui/host/loading.h"
#include "ui/host/opening.h"
#include "ui/host/saving.h"
#include "ui/panels/series_browser.h"
#include "ui/panels/thumbnails.h"
#include "ui/panes/cutting.h"
#include "ui/panes/focus.h"
#include "ui/panes/gesture.h"
#include "ui/panes/grips.h"
#include "ui/panes/measuring.h"
#include "ui/panes/slice_pane.h"
#include "ui/panes/volume_picture.h"
#include "ui/state/tool.h"
#include "ui/viewer.h"

struct ang_viewer {
    const ang_viewer_host *host;
    ang_window *window;
    ang_painter *painter;
    ang_gui *gui;
    const ang_theme *theme; /* of all but pictures */
    ang_input input;
    ang_loading loading;
    ang_slice_preview preview;
    ang_source shown;  /* what `study` was read from */
    ang_source failed; /* what `failure` is about */
    ang_source next;   /* to be opened once loading has stopped; of no paths: none */
    ang_file_browser files;
    ang_series_browser series;
    double report_scroll; /* pixels that the loader's report is still to be scrolled */
    ang_study study;
    bool ready;         /* there is a study */
    char path[1024];    /* that it was read from */
    char asked[1024];   /* that is being read */
    char failure[1100]; /* what is shown instead of a study or of what was asked for; empty: nothing */

    ang_document document;
    ang_history history;
    ang_document chosen;    /* as the preset was when it was chosen, to compare with */
    ang_preset *own_preset; /* of the host for this study; NULL: none */
    ang_turn turn;          /* the document's when `range` and the slices' views were last brought up to it */
    ang_slice_range range[ANG_ORIENTATIONS];
    ang_slice_picture slice[ANG_ORIENTATIONS];
    ang_volume_picture volume;
    ang_cine cine;
    ang_tool tool;
    int maximised; /* ang_pane, -1: none */
    ang_rect pane[ANG_PANES];
    ang_grips grips;
    ang_focus focus;
    ang_palette palette;
    ang_recent recent;
    ang_viewer_settings remembered; /* what the host has been told */
    ang_pane hovered;
    double hovered_hu; /* NaN: none */
    ang_vec3 hovered_mm;
    ang_gesture gesture;
    ang_cutting cutting;
    bool turns_about_crosshair; /* the hand on the 3D picture, else about the volume's centre */
    ang_measuring measuring;

    bool help, notes, browsing, corner_text, crosshair_shown, names_hidden;
    bool voxels_shown; /* slices without interpolation */
    ang_thumbnails thumbnails;
    ang_preset_dialog preset_dialog;
    bool comparing;        /* the 3D pane shows the preset as it is saved: */
    ang_document compared; /* what it then shows */
    unsigned save_wanted;  /* pictures of panes, a bit for each ang_pane; as DICOM ANG_PANES bits above that */
    ang_shot shot;
    char saved[1024];
    char message[1100]; /* on the status line */
    bool message_bad;
    double message_until; /* seconds */
    ang_rect editor;      /* where the transfer function was plotted */
    int point;            /* chosen in the editor, of several the last; -1: none */
    ang_editing editing;
    double editor_low, editor_high; /* HU shown */
    ang_histogram *histogram;       /* NULL: none */
    bool typing;                    /* a text field has the keyboard */
    int redraws;                    /* frames still to draw before sleeping */
    int frames;
    double latency_ms;
};

void ang_viewer_say(ang_viewer *viewer, bool bad, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* What is shown; borrows from the viewer. */
void ang_viewer_describe(const ang_viewer *viewer, ang_viewer_state *state);

#endif
