/* Colours and sizes. */
#include "ui/toolkit/gui_private.hpp"

#include <initializer_list>

static void set_colours(ImGuiStyle &style, const ang_theme *theme) {
    const auto of = [](ang_ink ink) { return ImGui::ColorConvertU32ToFloat4(ink); };
    ImVec4 *c = style.Colors;
    const struct {
        ang_ink ink;
        std::initializer_list<ImGuiCol> where;
    } roles[] = {
        {theme->text, {ImGuiCol_Text}},
        {theme->dim, {ImGuiCol_TextDisabled}},
        {theme->panel, {ImGuiCol_WindowBg, ImGuiCol_MenuBarBg, ImGuiCol_ScrollbarBg}},
        {theme->raised, {ImGuiCol_PopupBg}},
        {theme->edge, {ImGuiCol_Border}},
        {theme->control, {ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_Tab, ImGuiCol_TabUnfocused}},
        {theme->control_hovered, {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered}},
        {theme->control_pressed, {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive}},
        {theme->chosen,
         {ImGuiCol_Header, ImGuiCol_HeaderHovered, ImGuiCol_TextSelectedBg, ImGuiCol_TabHovered, ImGuiCol_TabActive,
          ImGuiCol_TabUnfocusedActive}},
        {theme->line,
         {ImGuiCol_Separator, ImGuiCol_TableBorderLight, ImGuiCol_TableBorderStrong, ImGuiCol_TableHeaderBg}},
        {theme->bar_grip, {ImGuiCol_ScrollbarGrab}},
        {theme->dim, {ImGuiCol_ScrollbarGrabHovered, ImGuiCol_ScrollbarGrabActive}},
        {theme->accent,
         {ImGuiCol_CheckMark, ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive, ImGuiCol_PlotHistogram,
          ImGuiCol_PlotLines, ImGuiCol_NavHighlight, ImGuiCol_SeparatorHovered, ImGuiCol_SeparatorActive,
          ImGuiCol_DragDropTarget}},
    };
    for (ImVec4 *colour = c; colour < c + ImGuiCol_COUNT; colour++) *colour = of(theme->control);
    for (const auto &role : roles)
        for (ImGuiCol where : role.where) c[where] = of(role.ink);
    for (ImGuiCol where : {ImGuiCol_ChildBg, ImGuiCol_BorderShadow, ImGuiCol_TableRowBg, ImGuiCol_TableRowBgAlt,
                           ImGuiCol_NavWindowingDimBg})
        c[where] = ImVec4(0, 0, 0, 0);
    c[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.5f);
}

/* A grid of 4 px, controls 24 px high at scale 1. */
void ang_gui_set_style(const ang_gui *gui) {
    ImGuiStyle &style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowPadding = ImVec2(12, 8);
    style.FramePadding = ImVec2(8, 5);
    style.ItemSpacing = ImVec2(8, 4);
    style.ItemInnerSpacing = ImVec2(8, 4);
    style.WindowRounding = 0;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = 3;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.FrameBorderSize = 0;
    style.ScrollbarSize = 12;
    style.ScrollbarRounding = 6;
    style.ScaleAllSizes((float)gui->scale);
    set_colours(style, gui->theme);
}
