/* Canvases, that the program draws itself, and drawing. */
#include "ui/toolkit/gui_private.hpp"

static ImVec2 at(double x, double y) { return ImVec2((float)x, (float)y); }
static ImDrawList *sheet() { return ImGui::GetWindowDrawList(); }

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

static void begin_canvas(ang_gui *gui, const char *name, ang_rect rect, ImGuiWindowFlags more, ang_canvas *canvas) {
    ang_gui_place(rect);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32_BLACK);
    ImGui::Begin(name, nullptr, ang_gui_fixed | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollWithMouse | more);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    ImGui::InvisibleButton("canvas", ImVec2(std::fmax((float)rect.width, 1.0f), std::fmax((float)rect.height, 1.0f)),
                           all_buttons);
    read_canvas(gui, rect, canvas);
}
void ang_gui_pane_begin(ang_gui *gui, const char *name, ang_rect rect, ang_canvas *canvas) {
    begin_canvas(gui, name, rect, 0, canvas);
}
void ang_gui_grip_begin(ang_gui *gui, const char *name, ang_rect rect, ang_canvas *canvas) {
    begin_canvas(gui, name, rect, ImGuiWindowFlags_NoBackground, canvas);
}
void ang_gui_pane_end(ang_gui *gui) {
    if (gui->layered) sheet()->ChannelsMerge();
    gui->layered = false;
    gui->written.clear();
    ImGui::End();
}
void ang_gui_on_top_begin(ang_gui *gui) {
    sheet()->ChannelsSplit(2);
    sheet()->ChannelsSetCurrent(1);
    gui->on_top = gui->layered = true;
}
void ang_gui_on_top_end(ang_gui *gui) {
    sheet()->ChannelsSetCurrent(0);
    gui->on_top = false;
}

void ang_gui_canvas(ang_gui *gui, const char *name, double width, double height, ang_canvas *canvas) {
    ImVec2 at = ImGui::GetCursorScreenPos();
    bool pressed = ImGui::InvisibleButton(name, ImVec2((float)width, (float)height), all_buttons);
    read_canvas(gui, ang_rect{(double)at.x, (double)at.y, width, height}, canvas);
    ang_gui_note_stop(gui);
    const ImGuiContext &g = *ImGui::GetCurrentContext();
    canvas->focused = gui->navigating && g.NavId == ImGui::GetItemID() && !g.NavDisableHighlight;
    ImGui::RenderNavHighlight(ImRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax()), ImGui::GetItemID());
    canvas->activated = pressed && canvas->focused && gui->held < 0 && canvas->released < 0;
    /* Otherwise the wheel would scroll the panel as well. */
    if (canvas->hovered) ImGui::SetItemUsingMouseWheel();
}

void ang_gui_row_canvas(ang_gui *gui, const char *name, double width, double height, ang_canvas *canvas) {
    ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(name, ImVec2((float)width, (float)height), ImGuiButtonFlags_MouseButtonLeft);
    read_canvas(gui, ang_rect{(double)at.x, (double)at.y, width, height}, canvas);
    canvas->wheel = 0;
}

void ang_gui_line(ang_gui *, double x0, double y0, double x1, double y1, ang_ink ink, double thickness) {
    /* It adds half a pixel itself. */
    sheet()->AddLine(at(x0 - 0.5, y0 - 0.5), at(x1 - 0.5, y1 - 0.5), ink, (float)thickness);
}
void ang_gui_guide(ang_gui *gui, double x0, double y0, double x1, double y1, ang_ink ink, double thickness) {
    const double line[4] = {x0, y0, x1, y1};
    double pieces[ANG_LINE_PIECES][4];
    int count = ang_line_outside(line, gui->written.data(), gui->written.size(), pieces);
    for (int i = 0; i < count; i++)
        ang_gui_line(gui, pieces[i][0], pieces[i][1], pieces[i][2], pieces[i][3], ink, thickness);
}
void ang_gui_frame(ang_gui *gui, ang_rect r, ang_ink ink) {
    /* It puts a line of one pixel within the sides itself. */
    double thick = ang_gui_hairline(gui), more = (thick - 1) / 2;
    sheet()->AddRect(at(r.x + more, r.y + more), at(r.x + r.width - more, r.y + r.height - more), ink, 0, 0,
                     (float)thick);
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

/* Dark close to the letters; on top of a pane on a clear dark ground as well, to be read on bone too. */
static void darken(const ang_gui *gui, ImFont *font, double x, double y, const ang_rect &ground, const char *text) {
    if (gui->on_top)
        sheet()->AddRectFilled(at(ground.x, ground.y), at(ground.x + ground.width, ground.y + ground.height),
                               ANG_INK(0, 0, 0, 145), (float)ang_gui_px(gui, 3));
    double reach = ang_gui_hairline(gui);
    for (int across = -1; across <= 1; across++)
        for (int down = -1; down <= 1; down++)
            if (across != 0 || down != 0)
                sheet()->AddText(font, font->FontSize, at(x + across * reach, y + down * reach),
                                 ANG_INK(0, 0, 0, gui->on_top ? 110 : 170), text);
}

void ang_gui_write(ang_gui *gui, double x, double y, double align, bool small, bool outlined, ang_ink ink,
                   const char *text) {
    ImFont *font = font_of(gui, small);
    double width = ang_gui_text_width(gui, text, small);
    x = std::round(x - align * width);
    y = std::round(y);
    if (!text[0]) return;
    double room = ang_gui_px(gui, 3);
    ang_rect ground = {x - room, y, width + 2 * room, (double)font->FontSize + ang_gui_px(gui, 1)};
    if (outlined) darken(gui, font, x, y, ground, text);
    sheet()->AddText(font, font->FontSize, at(x, y), ink, text);
    if (gui->on_top) gui->written.push_back(ground);
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
