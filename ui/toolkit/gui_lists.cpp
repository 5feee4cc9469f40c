/* Lists that scroll, and the field in which a path is typed. */
#include "ui/toolkit/gui_private.hpp"

#include <string>

void ang_gui_rows_begin(ang_gui *gui, const char *name, double width, double height, double row, size_t count,
                        int follow, ang_rows_part *part) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::BeginChild(name, ImVec2((float)width, (float)height), false,
                      ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleVar(); /* only of the list, not of tooltips in it */
    float view = ImGui::GetWindowHeight();
    if (follow >= 0) {
        float top = (float)(follow * row), bottom = top + (float)row;
        if (top < ImGui::GetScrollY()) ImGui::SetScrollY(top);
        if (bottom > ImGui::GetScrollY() + view) ImGui::SetScrollY(bottom - view);
    }
    double from = (double)ImGui::GetScrollY();
    part->first = (int)std::floor(from / row);
    part->end = (int)std::ceil((from + (double)view) / row) + 1;
    if (part->end > (int)count) part->end = (int)count;
    if (part->first > part->end) part->first = part->end;
    part->page = (int)std::fmax(std::floor((double)view / row), 1.0);
    gui->row = row;
    gui->row_count = count;
}

ang_rect ang_gui_rows_row(ang_gui *gui, int index, bool chosen, bool enabled, ang_canvas *canvas) {
    ImGui::SetCursorPosY((float)(index * gui->row));
    ImGui::PushID(index);
    ang_gui_row_canvas(gui, "row", (double)ImGui::GetContentRegionAvail().x, gui->row, canvas);
    ImGui::PopID();
    if (chosen)
        ang_gui_fill(gui, canvas->rect, gui->theme->chosen);
    else if (canvas->hovered && enabled)
        ang_gui_fill(gui, canvas->rect, gui->theme->control_hovered);
    return canvas->rect;
}

void ang_gui_rows_end(ang_gui *gui) {
    ImGui::SetCursorPosY((float)(gui->row * (double)gui->row_count));
    ImGui::Dummy(ImVec2(1, 0));
    ImGui::EndChild();
    ImGui::PopStyleVar();
}

void ang_gui_scroll_begin(ang_gui *, const char *name, double width, double height) {
    ImGui::BeginChild(name, ImVec2((float)width, (float)height), false,
                      ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoSavedSettings);
}
void ang_gui_scroll_by(ang_gui *, double pixels) {
    if (pixels < 0 || pixels > 0) ImGui::SetScrollY(ImGui::GetScrollY() + (float)pixels);
}
void ang_gui_scroll_end(ang_gui *) { ImGui::EndChild(); }

/* Text that came while the field did not have the keyboard yet. */
static bool take_characters(char *text, size_t size) {
    ImGuiIO &io = ImGui::GetIO();
    std::string more;
    for (ImWchar c : io.InputQueueCharacters) {
        char bytes[5];
        if (c >= 32) more += ImTextCharToUtf8(bytes, c);
    }
    io.InputQueueCharacters.resize(0);
    size_t length = std::strlen(text);
    if (more.empty() || length + more.size() >= size) return false;
    std::memcpy(text + length, more.c_str(), more.size() + 1);
    return true;
}

/* Keeps Tab and the arrows for the program. */
static int keep_keys(ImGuiInputTextCallbackData *) { return 0; }

bool ang_gui_path_field(ang_gui *gui, const char *name, char *text, size_t size, double width, bool anew) {
    ImGuiContext &context = *ImGui::GetCurrentContext();
    ImGuiID id = ImGui::GetCurrentWindow()->GetID(name);
    if (anew && context.ActiveId == id) ImGui::ClearActiveID();
    bool ours = context.ActiveId == id && !context.ActiveIdIsJustActivated;
    bool changed = !ours && take_characters(text, size);
    ImGuiInputTextState *state = ours ? ImGui::GetInputTextState(id) : nullptr;
    if (state && !gui->path_held) {
        /* It comes with everything selected, so that the next letter would replace it. */
        state->ClearSelection();
        state->Stb.cursor = state->CurLenW;
    }
    gui->path_held = ours;
    gui->tab_kept = true;
    if (context.ActiveId == 0) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth((float)width);
    ImGuiInputTextFlags flags = ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_CallbackHistory;
    return ImGui::InputText(name, text, size, flags, keep_keys) || changed;
}
