/* Areas, menus and widgets. */
#include "ui/toolkit/gui_private.hpp"

const ImGuiWindowFlags ang_gui_fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

void ang_gui_place(ang_rect rect) {
    ImGui::SetNextWindowPos(ImVec2((float)rect.x, (float)rect.y));
    ImGui::SetNextWindowSize(ImVec2((float)rect.width, (float)rect.height));
}

void ang_gui_area_begin(ang_gui *, const char *name, ang_rect rect, bool solid) {
    ang_gui_place(rect);
    /* The scroll bar comes and goes in the margin: nothing else moves. */
    ImGui::SetNextWindowContentSize(ImVec2((float)rect.width - 2 * ImGui::GetStyle().WindowPadding.x, 0));
    ImGuiWindowFlags flags =
        (ang_gui_fixed & ~ImGuiWindowFlags_NoScrollbar) | (solid ? 0 : ImGuiWindowFlags_NoBackground);
    ImGui::Begin(name, nullptr, flags);
    const ImRect &inner = ImGui::GetCurrentWindow()->InnerRect; /* up to the bar: it clips half a margin before */
    ImGui::PushClipRect(inner.Min, inner.Max, false);
}

void ang_gui_area_end(ang_gui *) {
    ImGui::PopClipRect();
    ImGui::End();
}

void ang_gui_message_begin(ang_gui *gui, const char *name) {
    ImGui::SetNextWindowPos(ImVec2((float)gui->input.width / 2, (float)gui->input.height / 2), ImGuiCond_Always,
                            ImVec2(0.5f, 0.5f));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2((float)ang_gui_px(gui, 24), (float)ang_gui_px(gui, 20)));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, (float)ang_gui_px(gui, 4));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::ColorConvertU32ToFloat4(gui->theme->raised));
    const float margin = (float)ang_gui_px(gui, 24);
    ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0),
                                        ImVec2((float)gui->input.width - margin, (float)gui->input.height - margin));
    const ImGuiWindowFlags not_wanted = ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollbar;
    ImGui::Begin(name, nullptr, (ang_gui_fixed & ~not_wanted) | ImGuiWindowFlags_AlwaysAutoResize);
    /* Only for the message itself, not for tooltips in it. */
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    ang_gui_dialog_opened(gui);
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
bool ang_gui_menu_begin(ang_gui *gui, const char *label) {
    bool open = ImGui::BeginMenu(label);
    if (!open) ang_gui_menu_focus(gui);
    /* Rows as high as controls. */
    if (open)
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing,
                            ImVec2(ImGui::GetStyle().ItemSpacing.x, (float)ang_gui_px(gui, 9)));
    return open;
}
void ang_gui_menu_end(ang_gui *) {
    ImGui::PopStyleVar();
    ImGui::EndMenu();
}
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
void ang_gui_small_begin(ang_gui *gui) { ImGui::PushFont(gui->small); }
void ang_gui_small_end(ang_gui *) { ImGui::PopFont(); }
void ang_gui_text_accent(ang_gui *gui, const char *text) {
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(gui->theme->accent), "%s", text);
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
    ImGui::GetWindowDrawList()->AddLine(at, end, ImGui::GetColorU32(ImGuiCol_Separator), (float)ang_gui_hairline(gui));
    ImGui::Dummy(ImVec2(0, (float)ang_gui_px(gui, 2)));
}
void ang_gui_label(ang_gui *gui, const char *text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text);
    ImGui::SameLine((float)ang_gui_px(gui, 96));
}
void ang_gui_same_line(ang_gui *) { ImGui::SameLine(); }
void ang_gui_column(ang_gui *, double x) { ImGui::SetCursorPosX((float)x); }
void ang_gui_skip(ang_gui *, double width) { ImGui::SetCursorPosX(ImGui::GetCursorPosX() + (float)width); }
void ang_gui_gap(ang_gui *, double height) { ImGui::Dummy(ImVec2(0, (float)height)); }

static void next_width(double width) { ImGui::SetNextItemWidth(width > 0 ? (float)width : -1); }

bool ang_gui_button(ang_gui *gui, const char *label, double width, bool enabled) {
    ImGui::BeginDisabled(!enabled);
    bool pressed = ImGui::Button(label, ImVec2((float)width, 0));
    ang_gui_note_stop(gui);
    ImGui::EndDisabled();
    return pressed;
}
bool ang_gui_pressed(const ang_gui *) { return ImGui::IsItemActive(); }
bool ang_gui_checkbox(ang_gui *gui, const char *label, bool *value) {
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, (float)ang_gui_hairline(gui));
    ImGui::PushStyleColor(ImGuiCol_Border, gui->theme->box);
    bool changed = ImGui::Checkbox(label, value);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    ang_gui_note_stop(gui);
    return changed;
}
bool ang_gui_selectable(ang_gui *gui, const char *label, bool selected) {
    bool chosen = ImGui::Selectable(label, selected, 0, ImVec2(ImGui::GetContentRegionAvail().x, 0));
    ang_gui_note_stop(gui);
    return chosen;
}

bool ang_gui_choice(ang_gui *gui, const char *name, const char *const *words, int count, int *chosen, double width) {
    next_width(width);
    bool known = *chosen >= 0 && *chosen < count;
    bool changed = false;
    bool open = ImGui::BeginCombo(name, known ? words[*chosen] : "", ImGuiComboFlags_HeightLarge);
    if (!open) {
        ang_gui_note_stop(gui);
        return false;
    }
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
    /* ImGui makes a drag with Shift ten times faster. Where the number is typed it asserts that both tell the same. */
    ImGuiIO &io = ImGui::GetIO();
    bool shift = io.KeyShift;
    ImGuiKeyModFlags modifiers = io.KeyMods;
    io.KeyShift = false;
    io.KeyMods &= ~ImGuiKeyModFlags_Shift;
    bool changed = ImGui::DragScalar(name, ImGuiDataType_Double, value, (float)speed, &low, &high, format,
                                     ImGuiSliderFlags_AlwaysClamp);
    io.KeyShift = shift;
    io.KeyMods = modifiers;
    ang_gui_note_stop(gui);
    return changed;
}

bool ang_gui_number_field(ang_gui *gui, const char *name, double *value, const char *format, double width) {
    next_width(width);
    double typed = *value;
    ImGui::InputDouble(name, &typed, 0, 0, format);
    ang_gui_note_stop(gui);
    if (!ImGui::IsItemDeactivatedAfterEdit() || !std::isfinite(typed)) return false;
    bool changed = typed < *value || typed > *value;
    *value = typed;
    return changed;
}

bool ang_gui_text_field(ang_gui *gui, const char *name, char *text, size_t size, double width) {
    next_width(width);
    if (ImGui::IsWindowAppearing() && gui->focused_frame != ImGui::GetFrameCount()) {
        ImGui::SetKeyboardFocusHere();
        gui->focused_frame = ImGui::GetFrameCount();
    }
    /* What gets the keyboard by itself is chosen as a whole, to be typed over. */
    int chosen = ImGui::IsMouseDown(ImGuiMouseButton_Left) ? 0 : ImGuiInputTextFlags_AutoSelectAll;
    bool entered = ImGui::InputText(name, text, size, ImGuiInputTextFlags_EnterReturnsTrue | chosen);
    entered = entered && gui->waiting_step == 0; /* not the Enter by which Tab leaves it */
    /* What was entered may be refused or asked about: another Enter answers. */
    if (entered) ImGui::SetKeyboardFocusHere(-1);
    ang_gui_note_stop(gui, true);
    return entered;
}

bool ang_gui_colour(ang_gui *gui, const char *name, double colour[3]) {
    float value[3] = {(float)colour[0], (float)colour[1], (float)colour[2]};
    bool changed = ImGui::ColorEdit3(
        name, value, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_NoTooltip);
    ang_gui_note_stop(gui);
    if (!changed) return false;
    for (int i = 0; i < 3; i++) colour[i] = std::fmin(std::fmax((double)value[i], 0.0), 1.0);
    return true;
}

void ang_gui_progress(ang_gui *gui, double fraction, double width) {
    ImGui::ProgressBar((float)fraction, ImVec2((float)width, (float)ang_gui_px(gui, 8)), "");
}
/* Whether the pointer has rested on the last widget long enough. */
static bool rested(ang_gui *gui) {
    static const double rest_seconds = 0.5;
    ImGuiID id = ImGui::GetItemID();
    int frame = ImGui::GetFrameCount();
    if (id != gui->pointed || frame > gui->pointed_frame + 1) gui->pointed_since = gui->time;
    gui->pointed = id;
    gui->pointed_frame = frame;
    if (ImGui::IsAnyMouseDown()) gui->pointed_since = INFINITY;
    double left = gui->pointed_since + rest_seconds - gui->time;
    if (left > 0) gui->tooltip_in = left;
    return left <= 0;
}

double ang_gui_tooltip_in(const ang_gui *gui) { return gui->tooltip_in; }

/* Whether a dialog lies before the widget. */
static bool behind_dialog(const ang_gui *gui) {
    const ImGuiWindow *front = gui->last_dialog, *window = ImGui::GetCurrentWindow();
    return front && window->RootWindow != front && !(window->Flags & ImGuiWindowFlags_Popup);
}

void ang_gui_tooltip(ang_gui *gui, const char *text) {
    if (behind_dialog(gui)) return;
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    const ImGuiContext &g = *ImGui::GetCurrentContext();
    bool by_keys = g.NavDisableMouseHover && !g.NavDisableHighlight;
    if (by_keys ? ImGui::IsItemActive() : !rested(gui)) return;
    /* Below what has the keyboard, above it at the window's foot: its value stays in sight. */
    ImVec2 least = ImGui::GetItemRectMin(), most = ImGui::GetItemRectMax();
    const float gap = (float)ang_gui_px(gui, 4);
    bool above = most.y + (float)ang_gui_px(gui, 80) > g.IO.DisplaySize.y;
    if (by_keys)
        ImGui::SetNextWindowPos(ImVec2(least.x, above ? least.y - gap : most.y + gap), ImGuiCond_Always,
                                ImVec2(0, above ? 1.0f : 0.0f));
    /* Beside a menu, not over what comes next in it. */
    const ImGuiWindow *menu = g.CurrentWindow;
    if (menu->Flags & ImGuiWindowFlags_Popup)
        ImGui::SetNextWindowPos(ImVec2(menu->Pos.x + menu->Size.x + gap, least.y));
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
