/* Colours and sizes. */
#include "ui/toolkit/gui_private.hpp"

/* Near-black greys and one accent colour (viewer conventions: panel 12 %, controls 18 %, text 88 %). */
static void set_colours(ImGuiStyle &style) {
    const ImVec4 accent(0.20f, 0.52f, 0.78f, 1), accent_light(0.27f, 0.60f, 0.86f, 1);
    for (ImVec4 &colour : style.Colors) colour = ang_gui_grey(0.18f);
    ImVec4 *c = style.Colors;
    c[ImGuiCol_Text] = ang_gui_grey(0.88f);
    c[ImGuiCol_TextDisabled] = ang_gui_grey(0.56f);
    c[ImGuiCol_WindowBg] = ang_gui_grey(0.12f);
    c[ImGuiCol_ChildBg] = ang_gui_grey(0.12f, 0);
    c[ImGuiCol_PopupBg] = ang_gui_grey(0.14f);
    c[ImGuiCol_Border] = ang_gui_grey(0.26f);
    c[ImGuiCol_BorderShadow] = ang_gui_grey(0, 0);
    c[ImGuiCol_FrameBg] = c[ImGuiCol_Button] = ang_gui_grey(0.18f);
    c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_ButtonHovered] = ang_gui_grey(0.24f);
    c[ImGuiCol_FrameBgActive] = c[ImGuiCol_ButtonActive] = ang_gui_grey(0.29f);
    c[ImGuiCol_MenuBarBg] = ang_gui_grey(0.12f);
    c[ImGuiCol_ScrollbarBg] = ang_gui_grey(0.12f);
    c[ImGuiCol_ScrollbarGrab] = ang_gui_grey(0.28f);
    c[ImGuiCol_ScrollbarGrabHovered] = ang_gui_grey(0.36f);
    c[ImGuiCol_ScrollbarGrabActive] = ang_gui_grey(0.42f);
    c[ImGuiCol_CheckMark] = accent_light;
    c[ImGuiCol_SliderGrab] = accent;
    c[ImGuiCol_SliderGrabActive] = accent_light;
    c[ImGuiCol_Header] = ImVec4(accent.x, accent.y, accent.z, 0.55f);
    c[ImGuiCol_HeaderHovered] = ImVec4(accent.x, accent.y, accent.z, 0.40f);
    c[ImGuiCol_HeaderActive] = ImVec4(accent.x, accent.y, accent.z, 0.70f);
    c[ImGuiCol_Separator] = ang_gui_grey(0.22f);
    c[ImGuiCol_PlotHistogram] = accent;
    c[ImGuiCol_TextSelectedBg] = ImVec4(accent.x, accent.y, accent.z, 0.45f);
    c[ImGuiCol_NavHighlight] = accent_light;
    c[ImGuiCol_TableBorderLight] = c[ImGuiCol_TableBorderStrong] = ang_gui_grey(0.22f);
    c[ImGuiCol_TableRowBg] = c[ImGuiCol_TableRowBgAlt] = ang_gui_grey(0, 0);
    c[ImGuiCol_ModalWindowDimBg] = ang_gui_grey(0, 0.5f);
}

/* A grid of 4 px, controls 24 px high at scale 1. */
void ang_gui_set_style(double scale) {
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
    style.ScaleAllSizes((float)scale);
    set_colours(style);
}
