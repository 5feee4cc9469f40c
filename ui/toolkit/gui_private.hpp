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
    std::vector<ang_paint_vertex> vertices;
    std::vector<uint16_t> indices;
    std::vector<ang_paint_command> commands;
};

/* Sizes at the scale of `gui`, and colours of its theme. */
void ang_gui_set_style(const ang_gui *gui);
/* Where the next area goes, and what makes it one that stays there. */
void ang_gui_place(ang_rect rect);
extern const ImGuiWindowFlags ang_gui_fixed;

#endif
