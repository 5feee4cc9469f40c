/* The viewer: a window with three slices and a volume rendering of one series. Reads and writes files only through its
 * host. */
#ifndef ANG_UI_VIEWER_H
#define ANG_UI_VIEWER_H

#include "core/base/error.h"
#include "core/base/facts.h"
#include "core/base/notes.h"
#include "core/base/progress.h"
#include "core/render/method.h"
#include "core/scene/image.h"
#include "core/transfer/preset.h"
#include "core/volume/raw_slice.h"
#include "core/volume/volume.h"
#include "ui/gui.h"
#include "ui/host/settings.h"
#include "ui/state/cine.h"
#include "ui/state/document.h"
#include "ui/state/editing.h"
#include "ui/state/file_list.h"
#include "ui/state/series_list.h"
#include "ui/state/session.h"
#include "ui/state/slice_geometry.h"
#include "ui/state/source.h"

/* What has been loaded. Owned by the host until `release`. */
typedef struct ang_study {
    ang_volume *volume;
    bool hounsfield;                     /* values are HU; else plain numbers */
    double window_centre, window_width;  /* the file's; NaN where it has none */
    char label[64];                      /* shown on the panes: modality, series */
    char description[260], patient[260]; /* the same; may identify the patient; empty: not known */
    ang_notes notes;                     /* warnings and assumptions, a sentence each */
    int warnings;                        /* how many of the notes, from the first, are warnings */
    int series, series_count; /* which of how many series of its source, from 1; the number also of what could
                                 not be loaded */
    int phase, phases;        /* which of how many of the series, from 1 */
    char phase_text[128];     /* what that phase is; "": one volume, or not known */
    ang_facts facts;          /* geometry and values, nothing that may identify a patient */
    char *report;             /* all that loading found, as text to be copied; NULL: none */
    void *handle;             /* the host's */
} ang_study;

/* What the viewer shows, for tests and for those who repeat a picture. Borrows. */
typedef struct ang_viewer_state {
    const char *phase; /* "empty", "loading", "ready", "failed" */
    const ang_study *study;
    const char *path; /* that the study was read from; "": no single one */
    const ang_document *document;
    struct {
        int index, count;
        ang_slice_axes axes;
        double mm_per_pixel;
    } slice[ANG_ORIENTATIONS];
    const ang_cine *cine;
    ang_pane hovered;                       /* ANG_PANES: none */
    double hovered_hu;                      /* NaN: none */
    int maximised;                          /* ang_pane; -1: none */
    ang_rect pane[ANG_PANES];               /* in the window; of no size: not shown */
    ang_rect editor;                        /* the transfer function's plot, in the window */
    double editor_low, editor_high;         /* HU at its sides */
    int point;                              /* chosen in the editor, of several the last; -1: none */
    const ang_region_values *region_values; /* of the document's measures, one each */
    int measure;                            /* the chosen one's index; -1: none */
    const ang_editing *editing;
    struct {
        const char *name, *problem;
        bool replaces; /* it asks whether to */
    } saving;          /* a preset: what the dialog holds; name NULL: it is not open */
    const char *tool;
    bool corner_text, crosshair_lines; /* are shown on the panes */
    bool names_hidden, voxels_shown, turns_about_crosshair;
    const char *choice; /* of method: "auto" or a name */
    const char *method; /* that draws; NULL: none yet */
    int size[2];        /* of the 3D picture, pixels */
    bool refined;
    int levels_shown;     /* of fine 3D pictures, before they were refined (core/render/progressive.h), so far */
    bool at_rest;         /* nothing is left to do until input comes */
    int presets_pictured; /* presets of which there is a small picture */
    bool judged;          /* its error is known, or that it cannot be: */
    double error;         /* levels; NAN: cannot be known */
    double latency_ms;    /* from the last event to the window that showed what came of it */
    double frame_ms;      /* the last 3D picture's */
    int undo, redo;       /* 1 where possible */
    const char *saved;    /* the last file written; NULL: none */
    const char *open;     /* "files", "series", "report": what is in front; "": nothing */
    struct {
        int listed, chosen; /* rows of the file browser; the one that is marked, from 0, -1: none */
    } files;
    struct {
        int listed, chosen; /* rows of the series browser; the one that is marked, from 0 */
        int looked_at;      /* of which everything is known */
        bool dates;         /* are shown */
    } series;
    int slices_previewed; /* pictures of slices that have been shown while loading, so far */
    int frames;           /* windows drawn so far */
    ang_pane focus;       /* the pane that keys apply to */
    bool widgets;         /* widgets have the keyboard instead */
    bool help, palette;   /* open */
    const char *theme;
    const ang_layout *layout;
    ang_rect grip[ANG_GRIPS];
    const ang_recent *recent;
} ang_viewer_state;

/* Where a preset of some name is kept. */
typedef enum ang_preset_place { ANG_PRESET_AT_NOWHERE, ANG_PRESET_AT_INSTALLED, ANG_PRESET_AT_OWN } ang_preset_place;

/* Is told what a survey finds; from the thread of the survey. Borrows for the call. */
typedef struct ang_series_sink {
    /* The entries, of which the loader's look is still to come. Once, first. */
    void (*listed)(void *context, const ang_series_list *list);
    /* Entry `index` anew, with its picture and verdict. */
    void (*looked_at)(void *context, size_t index, const ang_series_entry *entry);
    void *context;
} ang_series_sink;

/* What the viewer asks of the program. */
typedef struct ang_viewer_host {
    void *context;
    /* Reads `source`; on a thread of its own. `slices` is given slices meanwhile. False as ang_load_all. */
    bool (*load)(void *context, const ang_source *source, const ang_slice_sink *slices, ang_study *study,
                 const ang_progress *progress, ang_error *err);
    void (*release)(void *context, ang_study *study);
    /* Finds out what `source` holds and tells `sink`; on a thread of its own. False as ang_survey. */
    bool (*survey)(void *context, const ang_source *source, const ang_series_sink *sink, const ang_progress *progress,
                   ang_error *err);
    /* Adds what a folder holds; false with ANG_INPUT where it cannot be read. */
    bool (*list_folder)(void *context, const char *path, ang_file_list *list, ang_error *err);
    /* A preset for a study whose values are no Hounsfield units, which the viewer frees; or NULL and an error. */
    ang_preset *(*preset_for)(void *context, const ang_study *study, ang_error *err);
    /* Writes a picture to a new file, whose path goes to `path`. With `state`, which repeats it; NULL: none does. */
    bool (*save_picture)(void *context, const char *what, const ang_image *image, const ang_viewer_state *state,
                         char *path, size_t size, ang_error *err);
    /* The same as a DICOM secondary capture of `study`. `right`, `down`: where in the patient its edges point, as
     * ang_letters_make says. */
    bool (*save_capture)(void *context, const char *what, const ang_image *image, const ang_study *study,
                         const char *right, const char *down, char *path, size_t size, ang_error *err);
    /* The same of the state alone. */
    bool (*save_state)(void *context, const ang_viewer_state *state, char *path, size_t size, ang_error *err);
    /* Whether a file is a saved state, or a picture that carries one, and no data. */
    bool (*is_state)(void *context, const char *file);
    /* Reads a saved state: where its data are goes to `path`. False where it is broken or they are not there; they may
     * be opened from elsewhere then. */
    bool (*open_state)(void *context, const char *file, char *path, size_t size, ang_error *err);
    /* What the state that was opened says of a study: once, for the study that comes after it. A window of NaN means as
     * suits. Where it was saved of other data `err` says so, though this returns true. False where there is no state
     * or, with a message in `err`, it cannot be shown. */
    bool (*session)(void *context, const ang_study *study, ang_session *session, ang_error *err);
    ang_preset_place (*preset_place)(void *context, const char *name);
    /* Writes what is shown as one of the user's own presets, over one of the same name; its file's path goes to `path`.
     * Saving and deleting free all `presets` and read them again. */
    bool (*save_preset)(void *context, const ang_document *document, const char *name, const char *description,
                        char *path, size_t size, ang_error *err);
    /* One of the user's own. */
    bool (*delete_preset)(void *context, const char *name, ang_error *err);
    /* Whether a file holds presets of another program, by its name. */
    bool (*is_preset_file)(void *context, const char *file);
    /* Makes its presets the user's own, none written over, and reads all `presets` again. The name of the first goes to
     * `first`; how many they are and what was lost on the way, in a sentence or two, to `said`. */
    bool (*import_presets)(void *context, const char *file, char *first, size_t first_size, char *said,
                           size_t said_size, ang_error *err);
    /* Told after each frame after which something differs; NULL: not wanted. */
    void (*shown)(void *context, const ang_viewer_state *state);
    /* Keeps settings for the next run; NULL: not wanted. */
    void (*remember)(void *context, const ang_viewer_settings *settings);
    /* The absolute path of a file or folder into `full`; false where it is too long. NULL: none are remembered. */
    bool (*full_path)(void *context, const char *path, char *full, size_t size);
    const ang_viewer_settings *settings; /* to begin with; NULL: defaults; outlives the viewer */
    const ang_preset *const *presets;    /* NULL at the end; stay until one is saved or deleted */
    const char *home;                    /* the user's folder; NULL: not known */
    const char *folder;                  /* where the file browser begins */
    const char *font;                    /* TrueType file; NULL: none found */
    const char *version;
    int threads;   /* 0: all */
    bool keep_phi; /* what may identify the patient may stand in saved pictures of the window */
} ang_viewer_host;

typedef struct ang_viewer_options {
    const char *const *paths; /* to open as one input */
    size_t path_count;        /* 0: the file browser opens */
    const char *preset;       /* name of the one to begin with; NULL: as suits */
    int width, height;        /* of the window, pixels; 0: as suits the screen */
    double scale;             /* of texts and controls; NaN: as suits the screen */
} ang_viewer_options;

/* Opens the window, works until it is closed. False with ANG_GL where no window can be opened, or what went wrong in it
 * and could not be shown. From the program's first thread. */
bool ang_viewer_run(const ang_viewer_host *host, const ang_viewer_options *options, ang_error *err);

#endif
