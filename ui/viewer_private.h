/* The viewer's state and its parts; only ui/ includes it. */
#ifndef ANG_UI_VIEWER_PRIVATE_H
#define ANG_UI_VIEWER_PRIVATE_H

#include "core/scene/objects.h"
#include "core/volume/histogram.h"
#include "ui/actions/palette.h"
#include "ui/dialogs/file_browser.h"
#include "ui/host/loading.h"
#include "ui/panels/series_browser.h"
#include "ui/panes/cutting.h"
#include "ui/panes/focus.h"
#include "ui/panes/grips.h"
#include "ui/panes/measuring.h"
#include "ui/state/cine.h"
#include "ui/toolkit/gui.h"
#include "ui/viewer.h"

/* Colours of the panes (3D Slicer's). */
ang_ink ang_pane_ink(ang_pane pane, unsigned alpha);

enum { ANG_THUMBNAILS = 128 }; /* the most presets that are shown */

typedef enum ang_tool {
    ANG_TOOL_WINDOW,
    ANG_TOOL_CROSSHAIR,
    ANG_TOOL_SCROLL,
    ANG_TOOL_PAN,
    ANG_TOOL_CROP,
    ANG_TOOL_MEASURE,
    ANG_TOOLS
} ang_tool;
const char *ang_tool_name(ang_tool tool);

/* What a range of HU selects of a slice, as a picture to lie over it. */
typedef struct ang_slice_mark {
    float low, high;  /* HU that it marks */
    unsigned version; /* of the slice; 0: none */
    ang_paint_texture texture;
} ang_slice_mark;

/* A slice's picture, kept until what it shows changes. */
typedef struct ang_slice_picture {
    ang_slice_view view;
    ang_reslice_plane plane; /* of `hu` */
    double centre, width;    /* of the texture */
    float *hu;
    uint8_t *rgba;
    size_t room; /* pixels */
    bool filled;
    unsigned version; /* counts what `hu` has been */
    ang_paint_texture texture;
    ang_slice_mark mark;
} ang_slice_picture;

/* How far a picture may be off, in levels of 255 (core/error/estimate.h); NAN: not known. */
typedef struct ang_picture_error {
    unsigned version; /* of the picture; of another one it says nothing */
    double levels, rms;
    double not_before; /* seconds: when to try again after an interruption */
} ang_picture_error;

/* A fine picture that is not shown now. */
typedef struct ang_kept_picture {
    bool filled;
    ang_image image;
    ang_scene scene;
    ang_transfer *transfer;
    ang_document document;
    int size[2];
    double frame_ms;
    ang_paint_texture texture;
    bool judged;
    ang_picture_error error; /* where judged */
} ang_kept_picture;

/* The volume rendering's. */
typedef struct ang_volume_picture {
    const ang_method *method; /* of `renderer` */
    ang_renderer *renderer;
    int choice; /* 0: auto, else 1 + index into ang_methods */
    ang_image image;
    ang_scene scene;        /* that `image` shows, without what it borrows */
    ang_transfer *transfer; /* of `scene` */
    ang_objects objects;    /* the lengths that `image` shows */
    ang_document document;  /* that `image` shows */
    int size[2];            /* of the pane that `image` was made for */
    bool shown, refined;    /* there is an image; it is as fine as the pane */
    unsigned version;       /* counts the images */
    ang_picture_error error;
    ang_kept_picture kept;
    bool compared;        /* it shows, or is to show, the preset as it is saved */
    double coarse_pixels; /* as many as the budget of time allows; 0: not known yet */
    bool warm;            /* a picture has been made by `renderer` */
    double frame_ms;      /* of the last picture */
    double asked_seconds; /* when what it shows last changed */
    uint8_t *rgba;
    ang_paint_texture texture;
    char failure[1024]; /* why there is no picture; empty: there is */
    bool software;
} ang_volume_picture;

/* What a drag began with. */
typedef struct ang_gesture {
    int pane; /* ang_pane, -1: none */
    ang_document before;
    ang_vec3 crosshair;
    ang_slice_view view;
    bool bends;        /* the preset is shifted and stretched */
    bool strengthens;  /* its opacity is */
    bool turns;        /* the slice planes are turned */
    double turned_deg; /* so far */
    double slices;     /* scrolled so far */
    bool cancelled;
} ang_gesture;

/* A picture of the window or of a pane as it is seen. */
typedef struct ang_shot {
    bool wanted;
    int pane;   /* ang_pane; -1: the whole window */
    int frame;  /* that was drawn when it was asked for: the menu may still be in it */
    bool posed; /* it is taken of this frame, which names neither folders nor people */
} ang_shot;

/* Small pictures of the presets, in the panel's order. */
typedef struct ang_thumbnails {
    ang_paint_texture texture[ANG_THUMBNAILS];
    bool made[ANG_THUMBNAILS]; /* or tried in vain */
    double scroll;             /* of the strip, pixels */
    int first, last;           /* seen in the strip */
    char shown[64];            /* the preset that the strip was last scrolled to */
} ang_thumbnails;

/* Saving or deleting a preset. */
typedef struct ang_preset_dialog {
    bool open, deletes;
    bool asked; /* whether what has this name may be replaced */
    char name[64], description[240];
    char problem[1024]; /* why it could not be done; empty: nothing */
} ang_preset_dialog;

/* The slice that has been read last while loading. */
typedef struct ang_slice_preview {
    ang_paint_texture texture;
    size_t index, count; /* its place from 0, of how many; count 0: none yet */
    int pictures;        /* made since the window opened */
} ang_slice_preview;

typedef struct ang_viewer {
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
    ang_vec3 crosshair;
    ang_turn
        turn; /* of the planes in `range` and of the slices' views: the document's when they were last brought up */
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
    bool save_wanted;      /* a picture of the pane, when refined */
    ang_pane save_pane;
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
} ang_viewer;

/* viewer.c */
void ang_viewer_say(ang_viewer *viewer, bool bad, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* What is shown; borrows from the viewer. */
void ang_viewer_describe(const ang_viewer *viewer, ang_viewer_state *state);

/* study.c */
extern const ang_view ang_viewer_first_view;
/* Shows a study, which is taken, instead of the one before. */
void ang_study_show(ang_viewer *viewer, const ang_study *study, const char *wanted_preset);
void ang_study_close(ang_viewer *viewer);
const ang_preset *ang_preset_named(const ang_viewer *viewer, const char *name); /* NULL: there is none */
void ang_viewer_choose_preset(ang_viewer *viewer, const ang_preset *preset);
/* The crosshair to a place, kept within the volume and on slices. */
void ang_viewer_point_at(ang_viewer *viewer, ang_vec3 mm);
/* The window that the file asks for, else one that suits. */
void ang_viewer_file_window(const ang_viewer *viewer, double *centre, double *width);
double ang_viewer_hu_at(const ang_viewer *viewer, ang_vec3 mm); /* NaN outside */

/* session.c */
/* What is to be read where `path` is opened: itself or, where it is a saved state, the state's data, in `room`. NULL
 * where the state says why not, which is then the viewer's failure. */
const char *ang_session_data(ang_viewer *viewer, const char *path, char *room, size_t size);
/* Shows the study that has just been loaded as the state says that it was opened by; nothing where there is none. */
void ang_session_apply(ang_viewer *viewer);
void ang_session_save(ang_viewer *viewer);
const char *ang_volume_method_choice(const ang_viewer *viewer); /* "auto" or a name */

/* opening.c */
void ang_viewer_open(ang_viewer *viewer, const char *path);
/* The same for any source, which is taken. What is being loaded is stopped; what is shown stays until this is there. */
void ang_viewer_open_source(ang_viewer *viewer, ang_source *source);
/* Shows what has been loaded meanwhile. */
void ang_viewer_take_loaded(ang_viewer *viewer, const char *wanted_preset);
/* Makes the slice that was read last the one that is shown while loading. */
void ang_viewer_take_preview(ang_viewer *viewer);
/* What the series browser is about: what is shown, or what could not be. */
const ang_source *ang_viewer_subject(const ang_viewer *viewer);
/* Greys, rows from the top, as a texture; it stays as it is where that fails or there are none. */
void ang_viewer_paint_grey(ang_viewer *viewer, const uint8_t *grey, int width, int height, ang_paint_texture *texture);
void ang_viewer_opening_clear(ang_viewer *viewer);

/* saving.c */
/* A picture of the window (-1) or of a pane as it is seen, writing included: of the next frame without a menu, the 3D
 * pane's once it is refined. */
void ang_shot_ask(ang_viewer *viewer, int pane);
void ang_shot_pose(ang_viewer *viewer); /* before a frame is drawn */
void ang_shot_take(ang_viewer *viewer); /* after it has been painted */
/* The 3D pane's picture only once it is refined. */
void ang_save_pane(ang_viewer *viewer);

/* slice_pane.c */
void ang_slice_pane(ang_viewer *viewer, ang_pane pane, ang_rect rect);
void ang_slice_scroll(ang_viewer *viewer, ang_orientation orientation, int slices);
void ang_slice_picture_clear(ang_viewer *viewer, ang_slice_picture *picture);
/* Where a slice pane's pixels lie while it is at `rect`. */
ang_slice_frame ang_slice_frame_of(const ang_viewer *viewer, ang_orientation orientation, ang_rect rect);
/* 100: a pixel of the screen for each of the volume's smallest voxel spacing. */
double ang_slice_zoom_percent(const ang_viewer *viewer, ang_pane pane);
/* The slice as a picture to be written. */
bool ang_slice_image(ang_viewer *viewer, ang_orientation orientation, ang_image *image, ang_error *err);

/* slice_mark.c */
/* Draws over the slice's picture what the transfer-function editor selects, and says what it is; where nothing is to be
 * shown it costs nothing. */
void ang_slice_mark_show(ang_viewer *viewer, ang_slice_picture *picture, ang_rect rect);

/* volume_pane.c, volume_picture.c */
void ang_volume_pane(ang_viewer *viewer, ang_rect rect);
/* The scene of a document for a picture of this size; borrows `transfer`. */
ang_scene ang_volume_scene(const ang_viewer *viewer, const ang_document *document, const ang_transfer *transfer,
                           int width, int height);
/* Draws a document as a small, coarse picture into `texture`, with the renderer that is there. False where input came
 * or it could not be drawn. */
bool ang_volume_thumbnail(ang_viewer *viewer, const ang_document *document, int width, int height,
                          ang_paint_texture *texture, ang_error *err);
/* Draws a coarse picture where what it should show has changed; or, with `refine`, the fine one, until input comes. */
void ang_volume_update(ang_viewer *viewer, int width, int height, bool refine);
/* Seconds until the fine picture should be begun; infinite where there is nothing to refine. */
double ang_volume_refine_in(const ang_viewer *viewer);
void ang_volume_picture_clear(ang_viewer *viewer);
void ang_volume_set_method(ang_viewer *viewer, int choice);
/* About the pane's middle; by pixels. */
void ang_volume_zoom(ang_viewer *viewer, double factor);
void ang_volume_pan(ang_viewer *viewer, double right, double down);
/* The first place along a pixel's ray that shows; false where there is none. */
bool ang_volume_pick(ang_viewer *viewer, double x, double y, ang_vec3 *mm);

/* measuring.c */
/* Nothing is being made or chosen: for another study. */
void ang_measuring_start(ang_viewer *viewer);
/* Takes the tool, for measures of this kind. */
void ang_measuring_take(ang_viewer *viewer, ang_measure_kind kind);
/* Gives up what is half made; whether there was any. */
bool ang_measuring_cancel(ang_viewer *viewer);
/* What the hands do on a pane; only the tool's. */
void ang_measuring_slice(ang_viewer *viewer, ang_pane pane, const ang_canvas *canvas, const ang_slice_frame *frame);
void ang_measuring_volume(ang_viewer *viewer, const ang_canvas *canvas);
int ang_measuring_chosen(const ang_viewer *viewer); /* index into the document's measures; -1: none */
void ang_measuring_choose(ang_viewer *viewer, int index);
/* Chooses it and brings the crosshair to its middle. */
void ang_measuring_jump(ang_viewer *viewer, int index);
void ang_measuring_delete(ang_viewer *viewer, int index);
/* Of the document's measures, one each (only those of regions mean something); and of the one being made. */
const ang_region_values *ang_measuring_values(ang_viewer *viewer);
const ang_region_values *ang_measuring_pending_values(ang_viewer *viewer);
/* Whether a slice pane shows a measure, and how it lies to the slice. */
bool ang_measuring_shows(const ang_viewer *viewer, ang_pane pane, const ang_slice_frame *frame, int index,
                         ang_presence *presence);
/* What can be grabbed under the pointer (a handle or ANG_MARK_*), and of which measure. */
int ang_measuring_under(const ang_viewer *viewer, ang_pane pane, const ang_canvas *canvas, const ang_slice_frame *frame,
                        int *index);

/* measure_drawing.c */
void ang_measures_draw_slice(ang_viewer *viewer, ang_pane pane, ang_rect rect, const ang_canvas *canvas,
                             const ang_slice_frame *frame);
/* `scene`: of the pane's size. */
void ang_measures_draw_volume(ang_viewer *viewer, ang_rect rect, ang_scene scene);

/* kept_picture.c */
/* Where a comparison has begun or ended: the picture of the other side, if it still is `wanted`'s of this size, else
 * none; the one that was shown is kept. */
void ang_kept_picture_turn(ang_viewer *viewer, const ang_document *wanted, int width, int height);
void ang_kept_picture_clear(ang_viewer *viewer);

/* picture_error.c */
/* Seconds until the error of the picture that is shown should be estimated; infinite where there is nothing to do. */
double ang_picture_error_in(const ang_viewer *viewer);
/* Estimates it, until input comes. */
void ang_picture_error_find(ang_viewer *viewer);
/* For the status line; empty where there is no fine picture. */
void ang_picture_error_text(const ang_viewer *viewer, char *text, size_t size);

/* overlay.c */
void ang_pane_letters(ang_viewer *viewer, ang_rect rect, ang_vec3 right, ang_vec3 down);
void ang_pane_bar(ang_viewer *viewer, ang_rect rect, double mm_per_pixel, bool at_centre);
void ang_pane_corner(ang_viewer *viewer, ang_rect rect, int right, int bottom, int line, const char *text);
/* The patient's axes as the camera sees them, small in the corner. */
void ang_orientation_axes(ang_viewer *viewer, ang_rect rect, const ang_camera *camera);
/* The pane's border, with its letter. */
void ang_pane_frame(ang_viewer *viewer, ang_rect rect, ang_pane pane);
void ang_status_line(ang_viewer *viewer, ang_rect rect);

/* messages.c, panel.c, transfer_editor.c, load_report.c */
void ang_messages(ang_viewer *viewer);
void ang_load_report_window(ang_viewer *viewer);
/* Whether the key was for it. */
bool ang_load_report_key(ang_viewer *viewer, int key, unsigned modifiers);
void ang_panel(ang_viewer *viewer, ang_rect rect);
void ang_cutting_panel(ang_viewer *viewer); /* cutting_panel.c */
void ang_transfer_editor(ang_viewer *viewer);
/* For another volume. */
void ang_transfer_editor_start(ang_viewer *viewer);
/* Keys are no longer the editor's once the pointer has come to a pane. After the panes of each frame. */
void ang_transfer_editor_leave(ang_viewer *viewer);
/* The range of HU: nearly all values of the volume; all values and points; narrower (factor < 1) or wider. */
void ang_transfer_editor_show_data(ang_viewer *viewer);
void ang_transfer_editor_show_all(ang_viewer *viewer);
void ang_transfer_editor_zoom(ang_viewer *viewer, double about, double factor);
/* This point alone; -1: none. */
void ang_transfer_editor_choose(ang_viewer *viewer, int index);

/* transfer_keys.c */
bool ang_transfer_editor_has_keys(const ang_viewer *viewer);
/* Gives it the keys, or takes them away. */
void ang_transfer_editor_focus(ang_viewer *viewer);
/* To the next point (by > 0) or the one before; `adds`: to those chosen. */
void ang_transfer_editor_step(ang_viewer *viewer, int by, bool adds);
void ang_transfer_editor_choose_all(ang_viewer *viewer);
void ang_transfer_editor_delete(ang_viewer *viewer);
void ang_transfer_editor_insert(ang_viewer *viewer);
/* Whether the editor has taken an arrow key, or Esc. */
bool ang_transfer_editor_key(ang_viewer *viewer, int key, unsigned modifiers);
bool ang_transfer_editor_escape(ang_viewer *viewer);

/* presets.c */
void ang_presets_panel(ang_viewer *viewer);
/* The next preset of the list, or the one before. */
void ang_viewer_step_preset(ang_viewer *viewer, int by);
/* What the 3D pane shows: the document, or with the preset as it is saved. Borrowed until the next call. */
const ang_document *ang_viewer_shown_document(ang_viewer *viewer);

/* preset_dialog.c */
void ang_preset_dialog_open(ang_viewer *viewer, bool deletes);
void ang_preset_dialog_show(ang_viewer *viewer);

/* measures.c */
void ang_measures_list(ang_viewer *viewer);
/* Actions. */
void ang_measuring_next(ang_viewer *viewer, int argument); /* takes the tool; once more: the next kind */
void ang_measures_delete_chosen(ang_viewer *viewer, int argument);
void ang_measures_clear(ang_viewer *viewer, int argument);
void ang_measures_copy(ang_viewer *viewer, int argument); /* to the clipboard */
void ang_measures_toggle(ang_viewer *viewer, int argument);
bool ang_measures_any(const ang_viewer *viewer);
bool ang_measures_chosen(const ang_viewer *viewer);
bool ang_measures_shown(const ang_viewer *viewer, int argument);

/* file_browser.c, series_browser.c */
void ang_file_browser_open(ang_viewer *viewer);
void ang_file_browser_show(ang_viewer *viewer);
void ang_file_browser_clear(ang_file_browser *files);
void ang_series_browser_show(ang_viewer *viewer);
/* Takes what has been found meanwhile, and begins to look where the browser is open. */
void ang_series_browser_step(ang_viewer *viewer);
/* Whether the key was for it. */
bool ang_series_browser_key(ang_viewer *viewer, int key, unsigned modifiers);
void ang_series_browser_clear(ang_viewer *viewer);

/* thumbnails.c */
/* The presets that can be chosen, own_preset first; at most ANG_THUMBNAILS. Returns their number. */
int ang_presets(const ang_viewer *viewer, const ang_preset *presets[ANG_THUMBNAILS]);
/* The index of the document's among them; -1: none. */
int ang_preset_chosen(const ang_viewer *viewer, const ang_preset *const *presets, int count);
/* A row of them in the panel, and all of them in a message. */
void ang_thumbnails_strip(ang_viewer *viewer);
void ang_thumbnails_show(ang_viewer *viewer);
/* Whether one that is seen has no picture yet. */
bool ang_thumbnails_wanted(const ang_viewer *viewer);
/* Makes the next one. */
void ang_thumbnails_step(ang_viewer *viewer);
/* The presets are others: all pictures are made again. */
void ang_thumbnails_renew(ang_viewer *viewer);
/* Lets go of the pictures. Not while a frame is drawn. */
void ang_thumbnails_clear(ang_viewer *viewer);

/* actions.c, menus.c */
/* Something that can be done by menu or key. */
typedef struct ang_action {
    const char *menu;
    const char *name;
    const char *help; /* what the name does not say; NULL: nothing */
    int key;          /* ang_key; 0: none */
    unsigned modifiers;
    void (*run)(ang_viewer *viewer, int argument);
    int argument;
    bool apart;                                              /* from what stands before it in the menu */
    bool (*enabled)(const ang_viewer *viewer);               /* NULL: always */
    bool (*checked)(const ang_viewer *viewer, int argument); /* NULL: no tick */
} ang_action;
/* All of them, those of a menu together. */
const ang_action *ang_actions(int *count);
bool ang_action_enabled(const ang_viewer *viewer, const ang_action *action);
void ang_actions_keys(ang_viewer *viewer);
/* Windows of slices: keys 1 to 9. */
typedef struct ang_window_preset {
    const char *name;
    double width, centre; /* HU; NaN: as the file asks */
} ang_window_preset;
const ang_window_preset *ang_window_presets(int *count);
void ang_window_preset_choose(ang_viewer *viewer, int index);

double ang_menus(ang_viewer *viewer); /* the bar's height */
void ang_help(ang_viewer *viewer);
/* "Ctrl+S" of an action; empty where it has no key. */
const char *ang_action_shortcut(const ang_action *action, char text[32]);

#endif
