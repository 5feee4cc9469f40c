/* The one file that knows Dear ImGui (1.86, Debian's). */
#include <imgui.h>
#include <imgui_internal.h>

extern "C" {
#include "ui/gui.h"
}

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <new>
#include <vector>

static_assert(sizeof(ImDrawVert) == sizeof(ang_paint_vertex), "vertices are passed on as they are");
static_assert(sizeof(ImDrawIdx) == sizeof(uint16_t), "indices are passed on as they are");

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

static const double font_size = 14, small_size = 12;

static ImVec4 grey(float lightness, float alpha = 1) { return ImVec4(lightness, lightness, lightness, alpha); }

/* Near-black greys and one accent colour (viewer conventions: panel 12 %, controls 18 %, text 88 %). */
static void set_colours(ImGuiStyle &style) {
    const ImVec4 accent(0.20f, 0.52f, 0.78f, 1), accent_light(0.27f, 0.60f, 0.86f, 1);
    for (ImVec4 &colour : style.Colors) colour = grey(0.18f);
    ImVec4 *c = style.Colors;
    c[ImGuiCol_Text] = grey(0.88f);
    c[ImGuiCol_TextDisabled] = grey(0.56f);
    c[ImGuiCol_WindowBg] = grey(0.12f);
    c[ImGuiCol_ChildBg] = grey(0.12f, 0);
    c[ImGuiCol_PopupBg] = grey(0.14f);
    c[ImGuiCol_Border] = grey(0.26f);
    c[ImGuiCol_BorderShadow] = grey(0, 0);
    c[ImGuiCol_FrameBg] = c[ImGuiCol_Button] = grey(0.18f);
    c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_ButtonHovered] = grey(0.24f);
    c[ImGuiCol_FrameBgActive] = c[ImGuiCol_ButtonActive] = grey(0.29f);
    c[ImGuiCol_MenuBarBg] = grey(0.12f);
    c[ImGuiCol_ScrollbarBg] = grey(0.12f);
    c[ImGuiCol_ScrollbarGrab] = grey(0.28f);
    c[ImGuiCol_ScrollbarGrabHovered] = grey(0.36f);
    c[ImGuiCol_ScrollbarGrabActive] = grey(0.42f);
    c[ImGuiCol_CheckMark] = accent_light;
    c[ImGuiCol_SliderGrab] = accent;
    c[ImGuiCol_SliderGrabActive] = accent_light;
    c[ImGuiCol_Header] = ImVec4(accent.x, accent.y, accent.z, 0.55f);
    c[ImGuiCol_HeaderHovered] = ImVec4(accent.x, accent.y, accent.z, 0.40f);
    c[ImGuiCol_HeaderActive] = ImVec4(accent.x, accent.y, accent.z, 0.70f);
    c[ImGuiCol_Separator] = grey(0.22f);
    c[ImGuiCol_PlotHistogram] = accent;
    c[ImGuiCol_TextSelectedBg] = ImVec4(accent.x, accent.y, accent.z, 0.45f);
    c[ImGuiCol_NavHighlight] = accent_light;
    c[ImGuiCol_TableBorderLight] = c[ImGuiCol_TableBorderStrong] = grey(0.22f);
    c[ImGuiCol_TableRowBg] = c[ImGuiCol_TableRowBgAlt] = grey(0, 0);
    c[ImGuiCol_ModalWindowDimBg] = grey(0, 0.5f);
}

/* A grid of 4 px, controls 24 px high at scale 1. */
static void set_style(double scale) {
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

static bool make_letters(ang_gui *gui, double scale, ang_error *err) {
    static const ImWchar ranges[] = {0x20,   0xff,   0x370,  0x3ff,  0x2010, 0x203a, 0x2070,
                                     0x209f, 0x2190, 0x22ff, 0x25a0, 0x25ff, 0};
    ImGuiIO &io = ImGui::GetIO();
    io.Fonts->Clear();
    ImFontConfig config;
    config.OversampleH = 2;
    config.PixelSnapH = true;
    if (gui->font.empty()) {
        config.SizePixels = (float)std::floor(13 * scale);
        gui->normal = gui->small = io.Fonts->AddFontDefault(&config);
    } else {
        config.FontDataOwnedByAtlas = false;
        int size = (int)gui->font.size();
        gui->normal = io.Fonts->AddFontFromMemoryTTF(gui->font.data(), size, (float)std::floor(font_size * scale),
                                                     &config, ranges);
        gui->small = io.Fonts->AddFontFromMemoryTTF(gui->font.data(), size, (float)std::floor(small_size * scale),
                                                    &config, ranges);
    }
    unsigned char *pixels;
    int width, height;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    if (!ang_painter_picture(gui->painter, &gui->letters, width, height, pixels, true, err)) return false;
    io.Fonts->SetTexID((ImTextureID)(intptr_t)gui->letters.name);
    set_style(scale);
    gui->scale = scale;
    return true;
}

static const char *clipboard_get(void *window) { return ang_window_clipboard((ang_window *)window); }
static void clipboard_set(void *window, const char *text) { ang_window_set_clipboard((ang_window *)window, text); }

static void map_keys(ImGuiIO &io) {
    static const int pairs[][2] = {{ImGuiKey_Tab, ANG_KEY_TAB},
                                   {ImGuiKey_LeftArrow, ANG_KEY_LEFT},
                                   {ImGuiKey_RightArrow, ANG_KEY_RIGHT},
                                   {ImGuiKey_UpArrow, ANG_KEY_UP},
                                   {ImGuiKey_DownArrow, ANG_KEY_DOWN},
                                   {ImGuiKey_PageUp, ANG_KEY_PAGE_UP},
                                   {ImGuiKey_PageDown, ANG_KEY_PAGE_DOWN},
                                   {ImGuiKey_Home, ANG_KEY_HOME},
                                   {ImGuiKey_End, ANG_KEY_END},
                                   {ImGuiKey_Insert, ANG_KEY_INSERT},
                                   {ImGuiKey_Delete, ANG_KEY_DELETE},
                                   {ImGuiKey_Backspace, ANG_KEY_BACKSPACE},
                                   {ImGuiKey_Space, ANG_KEY_SPACE},
                                   {ImGuiKey_Enter, ANG_KEY_ENTER},
                                   {ImGuiKey_Escape, ANG_KEY_ESCAPE},
                                   {ImGuiKey_A, 'A'},
                                   {ImGuiKey_C, 'C'},
                                   {ImGuiKey_V, 'V'},
                                   {ImGuiKey_X, 'X'},
                                   {ImGuiKey_Y, 'Y'},
                                   {ImGuiKey_Z, 'Z'}};
    for (const auto &pair : pairs) io.KeyMap[pair[0]] = pair[1];
}

static void read_font(const char *path, std::vector<char> &font) {
    FILE *file = path ? std::fopen(path, "rb") : nullptr;
    if (!file) return;
    char block[65536];
    size_t got;
    while ((got = std::fread(block, 1, sizeof block, file)) > 0) font.insert(font.end(), block, block + got);
    std::fclose(file);
}

ang_gui *ang_gui_create(ang_window *window, ang_painter *painter, const char *font, ang_error *err) {
    ang_gui *gui = new (std::nothrow) ang_gui();
    if (!gui) {
        ang_fail(err, ANG_LIMIT, "no memory for the user interface");
        return nullptr;
    }
    gui->window = window;
    gui->painter = painter;
    gui->held = -1;
    read_font(font, gui->font);
    ImGui::CreateContext();
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors | ImGuiBackendFlags_RendererHasVtxOffset;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.MouseDragThreshold = 4;
    io.GetClipboardTextFn = clipboard_get;
    io.SetClipboardTextFn = clipboard_set;
    io.ClipboardUserData = window;
    map_keys(io);
    return gui;
}

void ang_gui_destroy(ang_gui *gui) {
    if (!gui) return;
    ang_painter_forget(gui->painter, &gui->letters);
    ImGui::DestroyContext();
    delete gui;
}

bool ang_gui_begin(ang_gui *gui, const ang_input *input, ang_error *err) {
    ImGuiIO &io = ImGui::GetIO();
    if (gui->scale != input->scale && !make_letters(gui, input->scale, err)) return false;
    gui->input = *input;
    io.DisplaySize = ImVec2((float)input->width, (float)input->height);
    io.DeltaTime = (float)std::fmax(input->time_seconds - gui->time, 1e-3);
    gui->time = input->time_seconds;
    io.MousePos = ImVec2((float)input->x, (float)input->y);
    for (int i = 0; i < ANG_BUTTON_COUNT; i++) io.MouseDown[i] = input->button[i];
    io.MouseWheel = (float)input->wheel_y;
    io.MouseWheelH = (float)input->wheel_x;
    for (int i = 1; i < ANG_KEY_COUNT; i++) io.KeysDown[i] = input->key[i];
    io.KeyShift = input->modifiers & ANG_MOD_SHIFT;
    io.KeyCtrl = input->modifiers & ANG_MOD_CONTROL;
    io.KeyAlt = input->modifiers & ANG_MOD_ALT;
    for (int i = 0; i < input->character_count; i++) io.AddInputCharacter(input->characters[i]);
    gui->cursor = ANG_CURSOR_ARROW;
    ImGui::NewFrame();
    ImGui::PushFont(gui->normal);
    return true;
}

static void show_cursor(ang_gui *gui) {
    ang_cursor cursor = gui->cursor;
    switch (ImGui::GetMouseCursor()) {
    case ImGuiMouseCursor_TextInput:
        cursor = ANG_CURSOR_TEXT;
        break;
    case ImGuiMouseCursor_ResizeEW:
        cursor = ANG_CURSOR_ACROSS;
        break;
    case ImGuiMouseCursor_ResizeNS:
        cursor = ANG_CURSOR_UP_DOWN;
        break;
    case ImGuiMouseCursor_Hand:
        cursor = ANG_CURSOR_HAND;
        break;
    default:
        break;
    }
    ang_window_cursor(gui->window, cursor);
}

static void add_list(ang_gui *gui, const ImDrawList *list) {
    uint32_t first_vertex = (uint32_t)gui->vertices.size(), first_index = (uint32_t)gui->indices.size();
    const auto *vertices = reinterpret_cast<const ang_paint_vertex *>(list->VtxBuffer.Data);
    gui->vertices.insert(gui->vertices.end(), vertices, vertices + list->VtxBuffer.Size);
    gui->indices.insert(gui->indices.end(), list->IdxBuffer.Data, list->IdxBuffer.Data + list->IdxBuffer.Size);
    for (const ImDrawCmd &from : list->CmdBuffer) {
        if (from.UserCallback || from.ElemCount == 0) continue;
        ang_paint_command command = {};
        command.clip[0] = std::fmax(from.ClipRect.x, 0.0f);
        command.clip[1] = std::fmax(from.ClipRect.y, 0.0f);
        command.clip[2] = from.ClipRect.z;
        command.clip[3] = from.ClipRect.w;
        command.texture = (unsigned)(intptr_t)from.GetTexID();
        command.first_index = first_index + from.IdxOffset;
        command.index_count = from.ElemCount;
        command.first_vertex = first_vertex + from.VtxOffset;
        gui->commands.push_back(command);
    }
}

void ang_gui_end(ang_gui *gui) {
    ImGui::PopFont();
    ImGui::Render();
    show_cursor(gui);
    gui->last_x = gui->input.x;
    gui->last_y = gui->input.y;
    gui->vertices.clear();
    gui->indices.clear();
    gui->commands.clear();
    const ImDrawData *data = ImGui::GetDrawData();
    for (int i = 0; i < data->CmdListsCount; i++) add_list(gui, data->CmdLists[i]);
    ang_paint_list list = {};
    list.vertices = gui->vertices.data();
    list.indices = gui->indices.data();
    list.commands = gui->commands.data();
    list.vertex_count = gui->vertices.size();
    list.index_count = gui->indices.size();
    list.command_count = gui->commands.size();
    ang_painter_draw(gui->painter, &list);
}

double ang_gui_px(const ang_gui *gui, double length) { return std::round(length * gui->scale); }
bool ang_gui_typing(const ang_gui *) { return ImGui::GetIO().WantTextInput; }
bool ang_gui_holding(const ang_gui *) { return ImGui::IsAnyItemActive() && ImGui::IsAnyMouseDown(); }
bool ang_gui_popup_open(const ang_gui *) {
    return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void ang_gui_close_popups(ang_gui *) { ImGui::ClosePopupToLevel(0, false); }

static const ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                             ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                             ImGuiWindowFlags_NoBringToFrontOnFocus;

static void place(ang_rect rect) {
    ImGui::SetNextWindowPos(ImVec2((float)rect.x, (float)rect.y));
    ImGui::SetNextWindowSize(ImVec2((float)rect.width, (float)rect.height));
}

void ang_gui_area_begin(ang_gui *, const char *name, ang_rect rect, bool solid) {
    place(rect);
    ImGuiWindowFlags flags =
        (fixed_window & ~ImGuiWindowFlags_NoScrollbar) | (solid ? 0 : ImGuiWindowFlags_NoBackground);
    ImGui::Begin(name, nullptr, flags);
}

void ang_gui_area_end(ang_gui *) { ImGui::End(); }

void ang_gui_message_begin(ang_gui *gui, const char *name) {
    ImGui::SetNextWindowPos(ImVec2((float)gui->input.width / 2, (float)gui->input.height / 2), ImGuiCond_Always,
                            ImVec2(0.5f, 0.5f));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2((float)ang_gui_px(gui, 24), (float)ang_gui_px(gui, 20)));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, (float)ang_gui_px(gui, 4));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, grey(0.14f));
    ImGui::Begin(name, nullptr,
                 (fixed_window & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_AlwaysAutoResize);
    /* Only for the message itself, not for tooltips in it. */
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
}

void ang_gui_message_end(ang_gui *) { ImGui::End(); }

double ang_gui_menu_bar_begin(ang_gui *gui) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2((float)ang_gui_px(gui, 8), (float)ang_gui_px(gui, 6)));
    ImGui::BeginMainMenuBar();
    double height = (double)ImGui::GetWindowHeight();
    return height;
}
void ang_gui_menu_bar_end(ang_gui *) {
    ImGui::EndMainMenuBar();
    ImGui::PopStyleVar();
}
bool ang_gui_menu_begin(ang_gui *, const char *label) { return ImGui::BeginMenu(label); }
void ang_gui_menu_end(ang_gui *) { ImGui::EndMenu(); }
void ang_gui_menu_separator(ang_gui *) { ImGui::Separator(); }
bool ang_gui_menu_item(ang_gui *, const char *label, const char *shortcut, bool checked, bool enabled) {
    return ImGui::MenuItem(label, shortcut, checked, enabled);
}

void ang_gui_text(ang_gui *, const char *format, ...) {
    va_list args;
    va_start(args, format);
    ImGui::TextV(format, args);
    va_end(args);
}
void ang_gui_text_dim(ang_gui *, const char *format, ...) {
    va_list args;
    va_start(args, format);
    ImGui::TextDisabledV(format, args);
    va_end(args);
}
void ang_gui_paragraph(ang_gui *, const char *text, double width) {
    ImGui::PushTextWrapPos(width > 0 ? ImGui::GetCursorPosX() + (float)width : 0.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
}
void ang_gui_hint(ang_gui *, const char *text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", text);
    ImGui::SameLine();
    ImGui::Dummy(ImVec2(0, ImGui::GetFrameHeight()));
}
void ang_gui_heading(ang_gui *gui, const char *text) {
    ImGui::Dummy(ImVec2(0, (float)ang_gui_px(gui, 4)));
    ImGui::PushFont(gui->small);
    ImGui::TextDisabled("%s", text);
    ImGui::PopFont();
    ImVec2 at = ImGui::GetCursorScreenPos();
    ImVec2 end(ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x, at.y);
    ImGui::GetWindowDrawList()->AddLine(at, end, ImGui::GetColorU32(ImGuiCol_Separator));
    ImGui::Dummy(ImVec2(0, (float)ang_gui_px(gui, 2)));
}
void ang_gui_label(ang_gui *gui, const char *text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text);
    ImGui::SameLine((float)ang_gui_px(gui, 96));
}
void ang_gui_same_line(ang_gui *) { ImGui::SameLine(); }
void ang_gui_gap(ang_gui *, double height) { ImGui::Dummy(ImVec2(0, (float)height)); }

static void next_width(double width) { ImGui::SetNextItemWidth(width > 0 ? (float)width : -1); }

bool ang_gui_button(ang_gui *, const char *label, double width, bool enabled) {
    ImGui::BeginDisabled(!enabled);
    bool pressed = ImGui::Button(label, ImVec2((float)width, 0));
    ImGui::EndDisabled();
    return pressed;
}
bool ang_gui_checkbox(ang_gui *, const char *label, bool *value) { return ImGui::Checkbox(label, value); }
bool ang_gui_selectable(ang_gui *, const char *label, bool selected) { return ImGui::Selectable(label, selected); }

bool ang_gui_choice(ang_gui *, const char *name, const char *const *words, int count, int *chosen, double width) {
    next_width(width);
    bool known = *chosen >= 0 && *chosen < count;
    bool changed = false;
    if (!ImGui::BeginCombo(name, known ? words[*chosen] : "", ImGuiComboFlags_HeightLarge)) return false;
    for (int i = 0; i < count; i++) {
        if (ImGui::Selectable(words[i], i == *chosen) && i != *chosen) {
            *chosen = i;
            changed = true;
        }
        if (i == *chosen) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
    return changed;
}

bool ang_gui_number(ang_gui *gui, const char *name, double *value, double speed, double low, double high,
                    const char *format, double width) {
    next_width(width);
    if (gui->input.modifiers & ANG_MOD_SHIFT) speed /= 10;
    /* ImGui makes a drag with Shift ten times faster. */
    ImGuiIO &io = ImGui::GetIO();
    bool shift = io.KeyShift;
    io.KeyShift = false;
    bool changed = ImGui::DragScalar(name, ImGuiDataType_Double, value, (float)speed, &low, &high, format,
                                     ImGuiSliderFlags_AlwaysClamp);
    io.KeyShift = shift;
    return changed;
}

bool ang_gui_number_field(ang_gui *, const char *name, double *value, const char *format, double width) {
    next_width(width);
    double typed = *value;
    ImGui::InputDouble(name, &typed, 0, 0, format);
    if (!ImGui::IsItemDeactivatedAfterEdit() || !std::isfinite(typed)) return false;
    bool changed = typed < *value || typed > *value;
    *value = typed;
    return changed;
}

bool ang_gui_text_field(ang_gui *, const char *name, char *text, size_t size, double width) {
    next_width(width);
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    return ImGui::InputText(name, text, size, ImGuiInputTextFlags_EnterReturnsTrue);
}

bool ang_gui_colour(ang_gui *, const char *name, double colour[3]) {
    float value[3] = {(float)colour[0], (float)colour[1], (float)colour[2]};
    if (!ImGui::ColorEdit3(name, value,
                           ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_NoTooltip))
        return false;
    for (int i = 0; i < 3; i++) colour[i] = std::fmin(std::fmax((double)value[i], 0.0), 1.0);
    return true;
}

void ang_gui_progress(ang_gui *gui, double fraction, double width) {
    ImGui::ProgressBar((float)fraction, ImVec2((float)width, (float)ang_gui_px(gui, 8)), "");
}
void ang_gui_tooltip(ang_gui *, const char *text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}
double ang_gui_room(const ang_gui *) { return (double)ImGui::GetContentRegionAvail().x; }

bool ang_gui_table_begin(ang_gui *, const char *name, int columns) {
    return ImGui::BeginTable(name, columns, ImGuiTableFlags_SizingFixedFit);
}
void ang_gui_table_next(ang_gui *) { ImGui::TableNextColumn(); }
void ang_gui_table_end(ang_gui *) { ImGui::EndTable(); }

/* The state of a canvas whose invisible button was the last item. */
static void read_canvas(ang_gui *gui, ang_rect rect, ang_canvas *canvas) {
    const ang_input &input = gui->input;
    ImGuiID id = ImGui::GetItemID();
    *canvas = ang_canvas{};
    canvas->rect = rect;
    canvas->held = canvas->released = -1;
    canvas->hovered = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
                      (!ImGui::IsAnyItemActive() || ImGui::IsItemActive());
    canvas->x = input.x - rect.x;
    canvas->y = input.y - rect.y;
    canvas->modifiers = input.modifiers;
    canvas->wheel = canvas->hovered ? input.wheel_y : 0;
    if (gui->held < 0 && ImGui::IsItemActivated()) {
        for (int i = 0; i < ANG_BUTTON_COUNT; i++) {
            if (!ImGui::IsMouseClicked(i)) continue;
            gui->held = i;
            gui->holder = id;
            gui->start_x = gui->last_x = input.x;
            gui->start_y = gui->last_y = input.y;
            gui->moved = false;
            canvas->pressed = true;
            canvas->double_clicked = i == ANG_BUTTON_LEFT && input.double_click[i];
        }
    }
    if (gui->held < 0 || gui->holder != id) return;
    canvas->start_x = gui->start_x - rect.x;
    canvas->start_y = gui->start_y - rect.y;
    canvas->dx = input.x - gui->last_x;
    canvas->dy = input.y - gui->last_y;
    if (std::hypot(input.x - gui->start_x, input.y - gui->start_y) >= ang_gui_px(gui, 4)) gui->moved = true;
    if (input.button[gui->held]) {
        canvas->held = gui->held;
        return;
    }
    canvas->released = gui->held;
    canvas->clicked = !gui->moved;
    gui->held = -1;
}

static const ImGuiButtonFlags all_buttons =
    ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle;

void ang_gui_pane_begin(ang_gui *gui, const char *name, ang_rect rect, ang_canvas *canvas) {
    place(rect);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32_BLACK);
    ImGui::Begin(name, nullptr, fixed_window | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    ImGui::InvisibleButton("canvas", ImVec2(std::fmax((float)rect.width, 1.0f), std::fmax((float)rect.height, 1.0f)),
                           all_buttons);
    read_canvas(gui, rect, canvas);
}
void ang_gui_pane_end(ang_gui *) { ImGui::End(); }

void ang_gui_canvas(ang_gui *gui, const char *name, double width, double height, ang_canvas *canvas) {
    ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(name, ImVec2((float)width, (float)height), all_buttons);
    read_canvas(gui, ang_rect{(double)at.x, (double)at.y, width, height}, canvas);
    /* Otherwise the wheel would scroll the panel as well. */
    if (canvas->hovered) ImGui::SetItemUsingMouseWheel();
}

static ImVec2 at(double x, double y) { return ImVec2((float)x, (float)y); }
static ImDrawList *sheet() { return ImGui::GetWindowDrawList(); }

void ang_gui_line(ang_gui *, double x0, double y0, double x1, double y1, ang_ink ink, double thickness) {
    sheet()->AddLine(at(x0, y0), at(x1, y1), ink, (float)thickness);
}
void ang_gui_frame(ang_gui *, ang_rect r, ang_ink ink) {
    sheet()->AddRect(at(r.x, r.y), at(r.x + r.width, r.y + r.height), ink);
}
void ang_gui_fill(ang_gui *, ang_rect r, ang_ink ink) {
    sheet()->AddRectFilled(at(r.x, r.y), at(r.x + r.width, r.y + r.height), ink);
}
void ang_gui_fill_across(ang_gui *, ang_rect r, ang_ink left, ang_ink right) {
    sheet()->AddRectFilledMultiColor(at(r.x, r.y), at(r.x + r.width, r.y + r.height), left, right, right, left);
}
void ang_gui_disc(ang_gui *, double x, double y, double radius, ang_ink ink) {
    sheet()->AddCircleFilled(at(x, y), (float)radius, ink);
}
void ang_gui_ring(ang_gui *, double x, double y, double radius, ang_ink ink, double thickness) {
    sheet()->AddCircle(at(x, y), (float)radius, ink, 0, (float)thickness);
}
void ang_gui_picture(ang_gui *, const ang_paint_texture *texture, ang_rect r) {
    if (texture->name)
        sheet()->AddImage((ImTextureID)(intptr_t)texture->name, at(r.x, r.y), at(r.x + r.width, r.y + r.height));
}

static ImFont *font_of(const ang_gui *gui, bool small) { return small ? gui->small : gui->normal; }

void ang_gui_write(ang_gui *gui, double x, double y, double align, bool small, bool outlined, ang_ink ink,
                   const char *text) {
    ImFont *font = font_of(gui, small);
    x = std::round(x - align * ang_gui_text_width(gui, text, small));
    y = std::round(y);
    const ang_ink dark = ANG_INK(0, 0, 0, 170);
    static const int around[][2] = {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}};
    for (const auto &step : around)
        if (outlined) sheet()->AddText(font, font->FontSize, at(x + step[0], y + step[1]), dark, text);
    sheet()->AddText(font, font->FontSize, at(x, y), ink, text);
}
double ang_gui_text_width(const ang_gui *gui, const char *text, bool small) {
    ImFont *font = font_of(gui, small);
    return (double)font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, text).x;
}
double ang_gui_text_height(const ang_gui *gui, bool small) { return (double)font_of(gui, small)->FontSize; }
void ang_gui_clip(ang_gui *, ang_rect r) {
    sheet()->PushClipRect(at(r.x, r.y), at(r.x + r.width, r.y + r.height), true);
}
void ang_gui_unclip(ang_gui *) { sheet()->PopClipRect(); }
void ang_gui_cursor(ang_gui *gui, ang_cursor cursor) { gui->cursor = cursor; }
