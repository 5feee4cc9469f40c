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

inline ImVec4 ang_gui_grey(float lightness, float alpha = 1) { return ImVec4(lightness, lightness, lightness, alpha); }
/* Colours and sizes at a scale. */
void ang_gui_set_style(double scale);
/* Where the next area goes, and what makes it one that stays there. */
void ang_gui_place(ang_rect rect);
extern const ImGuiWindowFlags ang_gui_fixed;

#endif
