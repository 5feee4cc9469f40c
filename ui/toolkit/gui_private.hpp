/* What the files that know Dear ImGui (1.86, Debian's) share; only ui/toolkit/gui*.cpp include it. */
#ifndef ANG_UI_GUI_PRIVATE_HPP
#define ANG_UI_GUI_PRIVATE_HPP

#include <imgui.h>
#include <imgui_internal.h>

extern "C" {
#include "ui/gui.h"
}

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <vector>

/* A widget that Tab goes to. */
struct ang_gui_stop {
    ImGuiID id, scope;
    ImGuiWindow *window;
    ImRect rect;  /* from where the window's contents start */
    bool of_text; /* a text field, which types as soon as Tab comes to it */
};

struct ang_gui {
    ang_window *window;
    ang_painter *painter;
    std::vector<char> font;
    ImFont *normal, *small;
    ang_paint_texture letters;
    const ang_theme *theme;
    double scale, time;
    ang_input input;
    ang_cursor cursor;
    int held; /* the button that a canvas holds; -1: none */
    ImGuiID holder;
    double start_x, start_y, last_x, last_y;
    bool moved;
    /* Who has the keyboard (gui_focus.cpp). */
    std::vector<ang_gui_stop> stops;  /* in the order of the frame */
    ImGuiWindow *dialog;              /* in front; nullptr: none */
    ImGuiWindow *last_dialog;         /* in the frame before */
    ImGuiID before;                   /* the widget that had the keyboard before the dialog; 0: none */
    ImGuiID arrows_of;                /* a canvas that uses arrows itself; 0: none */
    bool navigating;                  /* widgets have the keyboard */
    bool bar, menus_wanted;           /* the bar of menus has it; it is to have it */
    int bar_frames;                   /* without a menu, before the bar is left */
    int menu_waits;                   /* frames in which the menu beside the one that was left may open */
    int menu_settles;                 /* frames until a key in a menu has done all that it does */
    bool pressing;                    /* Enter went down on a widget and is still held */
    bool by_keys;                     /* the last that was done was done by a key; at first so */
    int frames;                       /* so far; in the first the pointer is where it happens to be */
    int waiting_step;                 /* of Tab, for the next frame; 0: none */
    bool changing_field;              /* in that frame no field takes letters yet: */
    std::vector<unsigned> characters; /* typed since */
    int focused_frame;                /* in which a text field was given the keyboard */
    ImGuiID pointed;                  /* the widget with a tooltip that the pointer rests on; 0: none */
    double pointed_since;             /* seconds; infinite once it has been pressed */
    int pointed_frame;                /* in which the pointer was last seen there */
    double tooltip_in;                /* seconds; infinite: none is to come */
    double row;                       /* of the list that is open: pixels */
    size_t row_count;
    bool tab_kept;  /* Tab completes in the field of a path that was shown in the frame before */
    bool path_held; /* the field of a path had the keyboard in the frame before */
    bool on_top, layered;          /* of the pane: what is drawn now lies over the rest; something does */
    std::vector<ang_rect> written; /* what was written on top */
    std::vector<ang_paint_vertex> vertices;
    std::vector<uint16_t> indices;
    std::vector<ang_paint_command> commands;
};

/* A canvas of the left button that leaves the wheel to what it lies in. */
void ang_gui_row_canvas(ang_gui *gui, const char *name, double width, double height, ang_canvas *canvas);
/* Sizes at the scale of `gui`, and colours of its theme. */
void ang_gui_set_style(const ang_gui *gui);
/* Where the next area goes, and what makes it one that stays there. */
void ang_gui_place(ang_rect rect);
extern const ImGuiWindowFlags ang_gui_fixed;
/* Before a frame: which keys Dear ImGui gets. */
void ang_gui_take_keys(ang_gui *gui);
/* After a widget: Tab goes to it. */
void ang_gui_note_stop(ang_gui *gui, bool of_text = false);
/* After a dialog's begin. */
void ang_gui_dialog_opened(ang_gui *gui);
/* After the first menu's label. */
void ang_gui_menu_focus(ang_gui *gui);

#endif
