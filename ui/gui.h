/* Widgets and drawing, as a C interface to Dear ImGui: everything of it that the viewer uses. Immediate mode: a frame
 * says what there is and learns at once what the hands did with it. All functions from one thread, between
 * ang_gui_begin and ang_gui_end unless they say otherwise. Lengths and places are pixels. */
#ifndef ANG_UI_GUI_H
#define ANG_UI_GUI_H

#include "core/base/error.h"
#include "core/render/painter.h"
#include "ui/toolkit/input.h"
#include "ui/toolkit/rect.h"
#include "ui/toolkit/theme.h"
#include "ui/toolkit/window.h"

typedef struct ang_gui ang_gui;

/* `font`: a TrueType file, NULL: a built-in font of Latin letters. The window serves pointer and clipboard. Not thread
 * safe; one at a time in a process. NULL with ANG_LIMIT. */
ang_gui *ang_gui_create(ang_window *window, ang_painter *painter, const char *font, ang_error *err);
void ang_gui_destroy(ang_gui *gui);

/* Takes the colours of all widgets from `theme`, which must outlive the interface; before the first frame, or between
 * frames. Dark until then. */
void ang_gui_set_theme(ang_gui *gui, const ang_theme *theme);

/* Begins a frame; makes letters anew where the scale has changed. False with what uploading them gives. */
bool ang_gui_begin(ang_gui *gui, const ang_input *input, ang_error *err);
/* Ends it and paints it. */
void ang_gui_end(ang_gui *gui);

/* `length` at scale 1 in pixels, whole. */
double ang_gui_px(const ang_gui *gui, double length);
/* The thinnest line in whole pixels, 1 at scale 1 and never less: frames, rules, the crosshair. */
double ang_gui_hairline(const ang_gui *gui);
/* Whether a text field has the keyboard, so that letters are no shortcuts. */
bool ang_gui_typing(const ang_gui *gui);
/* Whether a button of the mouse holds a widget: a value is still being changed. */
bool ang_gui_holding(const ang_gui *gui);
/* Whether a menu, a list or a picker is open. */
bool ang_gui_popup_open(const ang_gui *gui);
/* Closes it. */
void ang_gui_close_popups(ang_gui *gui);

/* Whether widgets have the keyboard, as they do from Tab to Esc or a click, and while a menu is open: arrows, Enter and
 * Space are then theirs. */
bool ang_gui_navigating(const ang_gui *gui);
/* Whether a message was in front in the frame before. */
bool ang_gui_dialog_open(const ang_gui *gui);
/* Whether a menu is still opening or closing after a key: another one would miss it. */
bool ang_gui_changing_menus(const ang_gui *gui);
/* Whether a widget's value is being changed by keys. */
bool ang_gui_adjusting(const ang_gui *gui);
/* Gives the keyboard to the widget that had it last or the first, with the next frame; to the bar of menus; to none. */
void ang_gui_enter_widgets(ang_gui *gui);
void ang_gui_enter_menus(ang_gui *gui);
void ang_gui_leave_widgets(ang_gui *gui);

/* A part of the window that does not move, with widgets from top to bottom. `solid`: filled as a panel. To be ended in
 * any case. */
void ang_gui_area_begin(ang_gui *gui, const char *name, ang_rect rect, bool solid);
void ang_gui_area_end(ang_gui *gui);
/* The same in front of all else, as large as its contents, centred in the window; scrolls where that is too small. */
void ang_gui_message_begin(ang_gui *gui, const char *name);
void ang_gui_message_end(ang_gui *gui);

/* A part of an area that scrolls where its contents are higher. */
void ang_gui_scroll_begin(ang_gui *gui, const char *name, double width, double height);
void ang_gui_scroll_by(ang_gui *gui, double pixels);
void ang_gui_scroll_end(ang_gui *gui);

/* The bar of menus at the window's top; its height. */
double ang_gui_menu_bar_begin(ang_gui *gui);
void ang_gui_menu_bar_end(ang_gui *gui);
bool ang_gui_menu_begin(ang_gui *gui, const char *label);
void ang_gui_menu_end(ang_gui *gui);
void ang_gui_menu_separator(ang_gui *gui);
bool ang_gui_menu_item(ang_gui *gui, const char *label, const char *shortcut, bool checked, bool enabled);

/* Widgets. Labels end at "##"; what follows only tells widgets of one label apart. `width` 0: what is left. */
void ang_gui_text(ang_gui *gui, const char *format, ...) __attribute__((format(printf, 2, 3)));
void ang_gui_text_dim(ang_gui *gui, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Texts in between are in the smaller of the two sizes of letters. */
void ang_gui_small_begin(ang_gui *gui);
void ang_gui_small_end(ang_gui *gui);
void ang_gui_text_accent(ang_gui *gui, const char *text);
/* With line breaks at the area's or the given width. */
void ang_gui_paragraph(ang_gui *gui, const char *text, double width);
/* As high as a row of controls. */
void ang_gui_hint(ang_gui *gui, const char *text);
void ang_gui_heading(ang_gui *gui, const char *text);
void ang_gui_label(ang_gui *gui, const char *text); /* before a control of the same line, in a column of its own */
void ang_gui_same_line(ang_gui *gui);
void ang_gui_gap(ang_gui *gui, double height);
void ang_gui_column(ang_gui *gui, double x);   /* of the same line: what comes next begins `x` from the area's left */
void ang_gui_skip(ang_gui *gui, double width); /* before a control of the same line */
bool ang_gui_button(ang_gui *gui, const char *label, double width, bool enabled);
/* Whether the widget before is held down. */
bool ang_gui_pressed(const ang_gui *gui);
bool ang_gui_checkbox(ang_gui *gui, const char *label, bool *value);
bool ang_gui_selectable(ang_gui *gui, const char *label, bool selected);
/* One of `count` words; true where it changed. */
bool ang_gui_choice(ang_gui *gui, const char *name, const char *const *words, int count, int *chosen, double width);
/* A number that is dragged or, after a double click, typed; `speed` units a pixel; Shift: ten times finer. */
bool ang_gui_number(ang_gui *gui, const char *name, double *value, double speed, double low, double high,
                    const char *format, double width);
/* A number that is typed: true when Enter or leaving the field changed it. */
bool ang_gui_number_field(ang_gui *gui, const char *name, double *value, const char *format, double width);
/* A line of text; true on Enter. In a message that has just opened the first one has the keyboard. */
bool ang_gui_text_field(ang_gui *gui, const char *name, char *text, size_t size, double width);
/* A swatch that opens a picker; red, green, blue in 0..1. */
bool ang_gui_colour(ang_gui *gui, const char *name, double colour[3]);
void ang_gui_progress(ang_gui *gui, double fraction, double width);
/* Of the widget before, once the pointer has rested there for a moment; not where it is pressed. */
void ang_gui_tooltip(ang_gui *gui, const char *text);
/* Seconds after this frame's input until a tooltip is due; infinite: none is. */
double ang_gui_tooltip_in(const ang_gui *gui);
double ang_gui_room(const ang_gui *gui); /* pixels left to the right of where the next widget goes */

/* A list in columns. */
bool ang_gui_table_begin(ang_gui *gui, const char *name, int columns);
void ang_gui_table_next(ang_gui *gui); /* to the next cell */
void ang_gui_table_end(ang_gui *gui);

/* What the hands do on a canvas: an area that the program draws itself. */
typedef struct ang_canvas {
    ang_rect rect;
    bool hovered;            /* the pointer is on it and nothing lies between */
    int held;                /* ANG_BUTTON_* that went down on it and is still down; -1: none */
    bool pressed;            /* `held` went down in this frame */
    int released;            /* the button that went up in this frame; -1: none */
    bool clicked;            /* `released` without having moved */
    bool double_clicked;     /* left */
    double x, y;             /* the pointer from the left top corner */
    double dx, dy;           /* its movement since the last frame */
    double start_x, start_y; /* where `held` or `released` went down */
    double wheel;            /* turns, up positive; 0 where not hovered */
    unsigned modifiers;      /* ANG_MOD_* */
    bool focused;            /* it has the keyboard; only among widgets */
    bool activated;          /* by Enter or Space, while it has the keyboard */
} ang_canvas;

/* A list that scrolls, of `count` rows of one height, `row` pixels, that the program draws itself; of them only those
 * from `first` up to `end` need to be. `height` below 0: all that is left but for so much. `follow`: the row that must
 * show, -1: none. Tab passes over it. To be ended in any case. */
typedef struct ang_rows_part {
    int first, end;
    int page; /* rows that show at once */
} ang_rows_part;
void ang_gui_rows_begin(ang_gui *gui, const char *name, double width, double height, double row, size_t count,
                        int follow, ang_rows_part *part);
/* Begins row `index`, on its ground: whether it is the chosen one, and can be taken. What the hands do on it; its place
 * in the window. */
ang_rect ang_gui_rows_row(ang_gui *gui, int index, bool chosen, bool enabled, ang_canvas *canvas);
void ang_gui_rows_end(ang_gui *gui);
/* A text field that has the keyboard whenever nothing else has; Tab, Enter, Up and Down are left to the program.
 * `anew`: `text` has been changed by the program. True where it was typed in. */
bool ang_gui_path_field(ang_gui *gui, const char *name, char *text, size_t size, double width, bool anew);

/* A pane of its own at `rect`, black; draw until its end. To be ended in any case. */
void ang_gui_pane_begin(ang_gui *gui, const char *name, ang_rect rect, ang_canvas *canvas);
void ang_gui_pane_end(ang_gui *gui);
/* The same over the panes that are begun later, and clear. */
void ang_gui_grip_begin(ang_gui *gui, const char *name, ang_rect rect, ang_canvas *canvas);
/* A canvas among widgets. */
void ang_gui_canvas(ang_gui *gui, const char *name, double width, double height, ang_canvas *canvas);
/* The canvas before uses arrows itself while it has the keyboard; Tab still leaves it. */
void ang_gui_canvas_arrows(ang_gui *gui);

/* Drawing, in pixels of the window, onto the area or pane that is open. `small`: the smaller of the two sizes of
 * letters. A level or upright line of an odd thickness is sharp through the middle of pixels (whole and a half), of an
 * even one between them. */
void ang_gui_line(ang_gui *gui, double x0, double y0, double x1, double y1, ang_ink ink, double thickness);
/* The same, interrupted where it would run through what has been written between begin and end below. */
void ang_gui_guide(ang_gui *gui, double x0, double y0, double x1, double y1, ang_ink ink, double thickness);
/* In a pane, once: what is drawn between these two lies over all that is drawn later in the pane. */
void ang_gui_on_top_begin(ang_gui *gui);
void ang_gui_on_top_end(ang_gui *gui);
/* A hairline within the rectangle's sides. */
void ang_gui_frame(ang_gui *gui, ang_rect rect, ang_ink ink);
void ang_gui_fill(ang_gui *gui, ang_rect rect, ang_ink ink);
/* Between two colours, from left to right. */
void ang_gui_fill_across(ang_gui *gui, ang_rect rect, ang_ink left, ang_ink right);
void ang_gui_disc(ang_gui *gui, double x, double y, double radius, ang_ink ink);
void ang_gui_ring(ang_gui *gui, double x, double y, double radius, ang_ink ink, double thickness);
void ang_gui_picture(ang_gui *gui, const ang_paint_texture *texture, ang_rect rect);
/* `align` 0: x is the left end, 0.5: the middle, 1: the right end; y is the top. With a dark outline where `outlined`,
 * to be read on any picture. */
void ang_gui_write(ang_gui *gui, double x, double y, double align, bool small, bool outlined, ang_ink ink,
                   const char *text);
double ang_gui_text_width(const ang_gui *gui, const char *text, bool small);
double ang_gui_text_height(const ang_gui *gui, bool small);
void ang_gui_clip(ang_gui *gui, ang_rect rect);
void ang_gui_unclip(ang_gui *gui);

/* The pointer's shape for this frame, where no widget wants another. */
void ang_gui_cursor(ang_gui *gui, ang_cursor cursor);

#endif
