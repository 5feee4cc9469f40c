/* Who has the keyboard: widgets, only once Tab has been pressed or a menu is open; else nobody here, and all keys are
 * the program's. Dear ImGui moves among widgets by arrows; Tab is done here, since its own passes over buttons. */
#include "ui/toolkit/gui_private.hpp"

/* From Left or Right in a menu until the one beside it is open. */
enum { menu_change = 4 };

static bool takes_keys(const ImGuiWindow *window) { return window && !(window->Flags & ImGuiWindowFlags_NoNavInputs); }

static bool in_menu_bar() {
    const ImGuiWindow *window = ImGui::GetCurrentContext()->NavWindow;
    return window && std::strcmp(window->Name, "##MainMenuBar") == 0;
}

static void give(const ang_gui_stop &stop) {
    ImGuiContext &g = *ImGui::GetCurrentContext();
    ImGui::FocusWindow(stop.window);
    ImGui::SetNavID(stop.id, ImGuiNavLayer_Main, stop.scope, stop.rect);
    g.NavDisableHighlight = false;
    g.NavDisableMouseHover = true;
    ImRect place = stop.rect;
    place.Translate(stop.window->DC.CursorStartPos);
    ImGui::ScrollToBringRectIntoView(stop.window, place);
    if (!stop.of_text) return;
    ImGui::ActivateItem(stop.id);
    g.NavInputSource = ImGuiInputSource_Keyboard;
}

/* To the next or last widget of the dialog in front, else of all areas. */
static void step(ang_gui *gui, int by) {
    const ImGuiContext &g = *ImGui::GetCurrentContext();
    std::vector<ang_gui_stop> stops;
    for (const ang_gui_stop &stop : gui->stops)
        if (!gui->dialog || stop.window == gui->dialog || stop.window->RootWindow == gui->dialog) stops.push_back(stop);
    if (stops.empty()) return;
    int count = (int)stops.size(), at = -1;
    for (int i = 0; i < count; i++)
        if (stops[(size_t)i].id == g.NavId) at = i;
    bool shown = takes_keys(g.NavWindow) && !g.NavDisableHighlight;
    int next = at < 0 ? (by > 0 ? 0 : count - 1) : shown ? (at + by + count) % count : at;
    give(stops[(size_t)next]);
}

/* Keys go back to the program when a menu is done with, and to the widget that had them when a dialog has gone. */
static void leave_what_has_gone(ang_gui *gui) {
    ImGuiContext &g = *ImGui::GetCurrentContext();
    bool popup = ang_gui_popup_open(gui);
    /* From one menu to the next there are frames without any. */
    if (popup) gui->bar_frames = menu_change;
    if (gui->bar && gui->bar_frames > 0 && !popup && --gui->bar_frames == 0) gui->bar = false;
    bool gone = g.NavWindow && !g.NavWindow->Active, shown = !g.NavDisableHighlight;
    if (!gone && !(in_menu_bar() && !gui->bar && !popup)) return;
    ang_gui_leave_widgets(gui);
    for (const ang_gui_stop &stop : gui->stops)
        if (gone && shown && stop.id == gui->before) give(stop);
}

/* Menus open and close in the frames after a key. */
static void settle_menus(ang_gui *gui) {
    if (gui->menu_settles > 0) gui->menu_settles--;
    if (gui->input.press_count > 0 && (gui->bar || ang_gui_popup_open(gui))) gui->menu_settles = menu_change;
}

/* Left and Right in a menu open the one beside it; Dear ImGui goes to its name alone, a frame after the key. */
static void change_menus(ang_gui *gui) {
    const ang_input &input = gui->input;
    const ImGuiContext &g = *ImGui::GetCurrentContext();
    bool in_menu = g.NavWindow && (g.NavWindow->Flags & ImGuiWindowFlags_ChildMenu);
    for (int i = 0; i < input.press_count && in_menu; i++)
        if (input.press[i].key == ANG_KEY_LEFT || input.press[i].key == ANG_KEY_RIGHT) {
            gui->menu_waits = menu_change;
            gui->bar = true;
        }
    if (gui->menu_waits > 0 && --gui->menu_waits < menu_change - 2 && in_menu_bar()) {
        ImGui::GetIO().KeysDown[ANG_KEY_DOWN] = true;
        gui->menu_waits = 0;
    }
}

/* The first key that means a widget shows which one of a dialog has the keyboard. */
static void show_in_dialog(ang_gui *gui) {
    ImGuiContext &g = *ImGui::GetCurrentContext();
    const ang_input &input = gui->input;
    if (!gui->dialog || g.NavWindow != gui->dialog || g.NavId == 0 || g.IO.WantTextInput) return;
    for (int i = 0; i < input.press_count; i++)
        if (input.press[i].key == ANG_KEY_ENTER || input.press[i].key == ANG_KEY_SPACE ||
            (input.press[i].key >= ANG_KEY_LEFT && input.press[i].key <= ANG_KEY_END)) {
            g.NavDisableHighlight = false;
            gui->navigating = true;
        }
}

/* Tab. What is being typed is taken first, as by Enter. */
static void take_tabs(ang_gui *gui) {
    const ang_input &input = gui->input;
    if (gui->waiting_step != 0) step(gui, gui->waiting_step);
    gui->waiting_step = 0;
    for (int i = 0; i < input.press_count; i++) {
        if (input.press[i].key != ANG_KEY_TAB || (input.press[i].modifiers & ~(unsigned)ANG_MOD_SHIFT)) continue;
        int by = input.press[i].modifiers & ANG_MOD_SHIFT ? -1 : 1;
        if (ang_gui_popup_open(gui) || gui->tab_kept) continue;
        if (ImGui::GetIO().WantTextInput)
            gui->waiting_step = by, gui->changing_field = true;
        else
            step(gui, by);
    }
    if (gui->waiting_step != 0) ImGui::GetIO().KeysDown[ANG_KEY_ENTER] = true;
}

/* Dear ImGui sees the keys that move among widgets only where those have the keyboard. */
static void hold_back(ang_gui *gui) {
    static const int moving[] = {ANG_KEY_SPACE, ANG_KEY_ENTER, ANG_KEY_LEFT,    ANG_KEY_RIGHT,     ANG_KEY_UP,
                                 ANG_KEY_DOWN,  ANG_KEY_HOME,  ANG_KEY_PAGE_UP, ANG_KEY_PAGE_DOWN, ANG_KEY_END};
    const ImGuiContext &g = *ImGui::GetCurrentContext();
    bool canvas = gui->arrows_of != 0 && g.NavId == gui->arrows_of && !g.NavDisableHighlight;
    for (int key : moving) {
        bool arrow = key >= ANG_KEY_LEFT && key <= ANG_KEY_END, upright = key >= ANG_KEY_UP && key <= ANG_KEY_PAGE_DOWN;
        bool held = g.IO.WantTextInput ? upright : !gui->navigating || (canvas && arrow);
        if (held) ImGui::GetIO().KeysDown[key] = false;
    }
}

/* Enter presses what Space presses too; Dear ImGui would only let it begin to type. One that ended typing does not. */
static void press_by_enter(ang_gui *gui) {
    const ang_input &input = gui->input;
    ImGuiIO &io = ImGui::GetIO();
    for (int i = 0; i < input.press_count; i++)
        if (input.press[i].key == ANG_KEY_ENTER && !input.press[i].repeat)
            gui->pressing = gui->navigating && !io.WantTextInput;
    gui->pressing = gui->pressing && input.key[ANG_KEY_ENTER];
    if (gui->pressing) io.KeysDown[ANG_KEY_SPACE] = true;
}

void ang_gui_take_keys(ang_gui *gui) {
    const ImGuiContext &g = *ImGui::GetCurrentContext();
    const ang_input &input = gui->input;
    leave_what_has_gone(gui);
    bool pointing =
        gui->frames++ > 0 && (input.x != gui->last_x || input.y != gui->last_y || input.button[0] || input.button[1]);
    if (input.press_count > 0 || pointing) gui->by_keys = input.press_count > 0;
    if (input.button[0] || input.button[1]) gui->bar = false;
    show_in_dialog(gui);
    hold_back(gui); /* before Tab, which may ask for Enter */
    press_by_enter(gui);
    take_tabs(gui);
    change_menus(gui);
    settle_menus(gui);
    bool shown = takes_keys(g.NavWindow) && !g.NavDisableHighlight;
    gui->navigating = ang_gui_popup_open(gui) || gui->bar || shown;
    if (!gui->dialog) gui->before = shown ? g.NavId : 0;
    gui->stops.clear();
    gui->last_dialog = gui->dialog;
    gui->tab_kept = false;
    gui->dialog = nullptr;
    gui->arrows_of = 0;
}

void ang_gui_note_stop(ang_gui *gui, bool of_text) {
    ImGuiContext &g = *ImGui::GetCurrentContext();
    ImGuiWindow *window = g.CurrentWindow;
    if (!takes_keys(window) || (window->Flags & ImGuiWindowFlags_Popup) ||
        (g.LastItemData.InFlags & ImGuiItemFlags_Disabled))
        return;
    gui->stops.push_back(ang_gui_stop{g.LastItemData.ID, window->DC.NavFocusScopeIdCurrent, window,
                                      ImGui::WindowRectAbsToRel(window, g.LastItemData.NavRect), of_text});
}

void ang_gui_dialog_opened(ang_gui *gui) {
    ImGuiContext &g = *ImGui::GetCurrentContext();
    gui->dialog = g.CurrentWindow;
    if (ImGui::IsWindowAppearing() && gui->by_keys) g.NavDisableHighlight = false;
}

bool ang_gui_changing_menus(const ang_gui *gui) { return gui->menu_settles > 0; }

bool ang_gui_navigating(const ang_gui *gui) { return gui->navigating; }

bool ang_gui_dialog_open(const ang_gui *gui) { return gui->last_dialog != nullptr; }

bool ang_gui_adjusting(const ang_gui *) {
    const ImGuiContext &g = *ImGui::GetCurrentContext();
    return g.ActiveId != 0 && g.ActiveIdSource == ImGuiInputSource_Nav;
}

void ang_gui_leave_widgets(ang_gui *gui) {
    ImGui::FocusWindow(nullptr);
    ImGui::GetCurrentContext()->NavDisableHighlight = true;
    gui->bar = gui->navigating = false;
}

void ang_gui_enter_widgets(ang_gui *gui) { gui->waiting_step = 1; }

void ang_gui_enter_menus(ang_gui *gui) { gui->menus_wanted = true; }

void ang_gui_menu_focus(ang_gui *gui) {
    if (!gui->menus_wanted) return;
    ImGuiContext &g = *ImGui::GetCurrentContext();
    ImGuiWindow *window = g.CurrentWindow;
    gui->menus_wanted = false;
    gui->bar = true;
    gui->bar_frames = 0;
    gui->menu_settles = menu_change;
    ImGui::FocusWindow(window);
    ImGui::SetNavID(g.LastItemData.ID, ImGuiNavLayer_Menu, 0,
                    ImGui::WindowRectAbsToRel(window, g.LastItemData.NavRect));
    g.NavDisableHighlight = false;
    g.NavDisableMouseHover = true;
}

void ang_gui_canvas_arrows(ang_gui *gui) { gui->arrows_of = ImGui::GetItemID(); }
