/* Frames: from what the hands did to triangles painted; letters. */
#include "ui/toolkit/gui_private.hpp"

#include <new>

static_assert(sizeof(ImDrawVert) == sizeof(ang_paint_vertex), "vertices are passed on as they are");
static_assert(sizeof(ImDrawIdx) == sizeof(uint16_t), "indices are passed on as they are");

static const double font_size = 14, small_size = 12;

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
    gui->scale = scale;
    ang_gui_set_style(gui);
    return true;
}

static const char *clipboard_get(void *window) { return ang_window_clipboard((ang_window *)window); }
static void clipboard_set(void *window, const char *text) { ang_window_set_clipboard((ang_window *)window, text); }

static void map_keys(ImGuiIO &io) {
    static const int pairs[][2] = {{ImGuiKey_LeftArrow, ANG_KEY_LEFT},
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
    gui->by_keys = true;
    gui->theme = &ang_theme_dark;
    read_font(font, gui->font);
    ImGui::CreateContext();
    ImGuiIO &io = ImGui::GetIO();
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
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

void ang_gui_set_theme(ang_gui *gui, const ang_theme *theme) {
    if (gui->theme == theme) return;
    gui->theme = theme;
    if (gui->scale > 0) ang_gui_set_style(gui);
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
    gui->characters.insert(gui->characters.end(), input->characters, input->characters + input->character_count);
    if (!gui->changing_field)
        for (unsigned c : gui->characters) io.AddInputCharacter(c);
    if (!gui->changing_field) gui->characters.clear();
    gui->changing_field = false;
    gui->cursor = ANG_CURSOR_ARROW;
    gui->tooltip_in = INFINITY;
    ang_gui_take_keys(gui);
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
double ang_gui_hairline(const ang_gui *gui) { return std::fmax(ang_gui_px(gui, 1), 1.0); }
bool ang_gui_typing(const ang_gui *) { return ImGui::GetIO().WantTextInput; }
bool ang_gui_holding(const ang_gui *gui) {
    /* Escape takes the canvas that is held from ImGui, not from the hand. */
    bool canvas = gui->held >= 0 && gui->input.button[gui->held];
    return canvas || (ImGui::IsAnyItemActive() && ImGui::IsAnyMouseDown());
}
bool ang_gui_popup_open(const ang_gui *) {
    return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void ang_gui_close_popups(ang_gui *) { ImGui::ClosePopupToLevel(0, true); }
