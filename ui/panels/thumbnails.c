#include "ui/panels/thumbnails.h"

#include "ui/study.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* At scale 1. */
enum { WIDTH = 128, HEIGHT = 96, COLUMNS = 5, SMALL_WIDTH = 92, SMALL_HEIGHT = 69, LINE = 18, BAR = 4 };

/* The first one that is seen and has no picture yet; -1: none. */
static int next_wanted(const ang_viewer *viewer) {
    const ang_thumbnails *thumbnails = &viewer->thumbnails;
    const ang_preset *presets[ANG_PRESETS];
    int count = ang_presets(viewer, presets);
    for (int i = 0; i < count; i++) {
        bool seen = viewer->browsing || (i >= thumbnails->first && i <= thumbnails->last);
        if (seen && !thumbnails->made[i]) return i;
    }
    return -1;
}

bool ang_thumbnails_wanted(const ang_viewer *viewer) {
    const ang_volume_picture *volume = &viewer->volume;
    return volume->renderer && volume->refined && !volume->failure[0] && next_wanted(viewer) >= 0;
}

int ang_thumbnails_made(const ang_viewer *viewer) {
    int count = 0;
    for (int i = 0; i < ANG_PRESETS; i++) count += viewer->thumbnails.texture[i].name != 0;
    return count;
}

void ang_thumbnails_step(ang_viewer *viewer) {
    ang_thumbnails *thumbnails = &viewer->thumbnails;
    const ang_preset *presets[ANG_PRESETS];
    ang_presets(viewer, presets);
    int next = next_wanted(viewer);
    if (next < 0) return;
    ang_document document = viewer->document;
    ang_document_take_preset(&document, presets[next]);
    document.view = ang_viewer_first_view;
    document.crop = false;
    document.clip = (ang_clip_plane){0};
    ang_error err = {0};
    bool made = ang_volume_thumbnail(viewer, &document, (int)ang_gui_px(viewer->gui, WIDTH),
                                     (int)ang_gui_px(viewer->gui, HEIGHT), &thumbnails->texture[next], &err);
    /* One that cannot be drawn stays empty. */
    if (made || err.code != ANG_INTERRUPTED) thumbnails->made[next] = true;
}

void ang_thumbnails_renew(ang_viewer *viewer) {
    for (int i = 0; i < ANG_PRESETS; i++) viewer->thumbnails.made[i] = false;
}

void ang_thumbnails_clear(ang_viewer *viewer) {
    ang_thumbnails *thumbnails = &viewer->thumbnails;
    for (int i = 0; i < ANG_PRESETS; i++) ang_painter_forget(viewer->painter, &thumbnails->texture[i]);
    ang_thumbnails_renew(viewer);
}

/* `name` as far as it goes into `width`, cut off with an ellipsis. */
static void fit(const ang_gui *gui, const char *name, double width, char *text, size_t size) {
    snprintf(text, size, "%s", name);
    for (size_t length = strlen(name); length > 0 && ang_gui_text_width(gui, text, true) > width; length--) {
        /* Not within a character of UTF-8. */
        while (length > 1 && ((unsigned char)name[length - 1] & 0xc0) == 0x80) length--;
        snprintf(text, size, "%.*s\xe2\x80\xa6", (int)(length - 1), name);
    }
}

/* A picture with its name below. */
static void draw(ang_viewer *viewer, const ang_preset *preset, int index, ang_rect picture, bool pointed) {
    ang_gui *gui = viewer->gui;
    char text[128];
    ang_gui_fill(gui, picture, ANG_INK(0, 0, 0, 255));
    if (viewer->thumbnails.made[index]) ang_gui_picture(gui, &viewer->thumbnails.texture[index], picture);
    bool chosen = strcmp(preset->name, viewer->document.preset) == 0;
    ang_ink border = chosen ? viewer->theme->accent : pointed ? viewer->theme->text : viewer->theme->edge;
    ang_gui_frame(gui, picture, border);
    ang_rect inner = ang_rect_inset(picture, ang_gui_hairline(gui));
    if (chosen) ang_gui_frame(gui, inner, pointed ? viewer->theme->text : border);
    fit(gui, preset->name, picture.width, text, sizeof text);
    ang_gui_write(gui, picture.x + picture.width / 2, picture.y + picture.height + ang_gui_px(gui, 2), 0.5, true, false,
                  chosen || pointed ? viewer->theme->text : viewer->theme->dim, text);
}

static void tell(ang_gui *gui, const ang_preset *preset) {
    char text[640];
    snprintf(text, sizeof text, "%s\n%s", preset->name, preset->description);
    ang_gui_tooltip(gui, text);
}

void ang_thumbnails_show(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_preset *presets[ANG_PRESETS];
    int count = ang_presets(viewer, presets), taken = -1;
    double width = ang_gui_px(gui, WIDTH), height = ang_gui_px(gui, HEIGHT);
    const char *about = "";
    ang_gui_message_begin(gui, "presets");
    for (int i = 0; i < count; i++) {
        ang_canvas canvas;
        if (i % COLUMNS != 0) ang_gui_same_line(gui);
        ang_gui_canvas(gui, presets[i]->name, width, height + ang_gui_px(gui, LINE), &canvas);
        bool pointed = canvas.hovered || canvas.focused;
        draw(viewer, presets[i], i, (ang_rect){canvas.rect.x, canvas.rect.y, width, height}, pointed);
        if (pointed) about = presets[i]->description;
        if (canvas.activated || (canvas.clicked && canvas.released == ANG_BUTTON_LEFT)) taken = i;
    }
    ang_gui_gap(gui, ang_gui_px(gui, 2));
    /* Below the pictures: it would hide the next ones. */
    ang_gui_scroll_begin(gui, "about", COLUMNS * (width + ang_gui_px(gui, 8)), 3 * ang_gui_text_height(gui, false));
    ang_gui_paragraph(gui, about, 0);
    ang_gui_scroll_end(gui);
    ang_gui_text_dim(gui, "A click, or arrows and Enter, take one; Esc or B closes this.");
    ang_gui_message_end(gui);
    if (taken < 0) return;
    ang_viewer_choose_preset(viewer, presets[taken]);
    viewer->browsing = false;
}

/* Arrows go from one to the next while the strip has the keyboard, from the chosen one on. True where they went. */
static bool move_cursor(ang_viewer *viewer, const ang_canvas *canvas, int chosen, int count) {
    ang_thumbnails *thumbnails = &viewer->thumbnails;
    const ang_input *input = &viewer->input;
    int before = thumbnails->by_keys ? thumbnails->cursor : -1, at = before;
    thumbnails->by_keys = canvas->focused && count > 0;
    if (!thumbnails->by_keys) return false;
    ang_gui_canvas_arrows(viewer->gui);
    if (at < 0) at = chosen;
    for (int i = 0; i < input->press_count; i++) {
        int key = input->press[i].key;
        at = key == ANG_KEY_LEFT    ? at - 1
             : key == ANG_KEY_RIGHT ? at + 1
             : key == ANG_KEY_HOME  ? 0
             : key == ANG_KEY_END   ? count - 1
                                    : at;
    }
    thumbnails->cursor = at < 0 ? 0 : at >= count ? count - 1 : at;
    return thumbnails->cursor != before;
}

/* Where the strip is scrolled to: by the wheel, a drag, or to what has just been chosen or gone to. */
static void scroll(ang_viewer *viewer, const ang_canvas *canvas, int chosen, bool moved, double pitch, double most) {
    ang_thumbnails *thumbnails = &viewer->thumbnails;
    int seen = -1;
    if (strcmp(thumbnails->shown, viewer->document.preset) != 0) {
        memcpy(thumbnails->shown, viewer->document.preset, sizeof thumbnails->shown);
        seen = chosen;
    }
    if (moved) seen = thumbnails->cursor;
    double start = seen * pitch, end = start + pitch - canvas->rect.width;
    if (seen >= 0) thumbnails->scroll = fmin(fmax(thumbnails->scroll, end), start);
    if (canvas->held >= 0) thumbnails->scroll -= canvas->dx;
    thumbnails->scroll -= canvas->wheel * pitch;
    thumbnails->scroll = round(fmin(fmax(thumbnails->scroll, 0), fmax(most, 0)));
}

void ang_thumbnails_strip(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_thumbnails *thumbnails = &viewer->thumbnails;
    const ang_preset *presets[ANG_PRESETS];
    int count = ang_presets(viewer, presets), pointed = -1;
    double width = ang_gui_px(gui, SMALL_WIDTH), height = ang_gui_px(gui, SMALL_HEIGHT);
    double pitch = width + ang_gui_px(gui, 8), room = ang_gui_room(gui), all = count * pitch - ang_gui_px(gui, 8);
    double bar = ang_gui_px(gui, BAR), line = ang_gui_px(gui, LINE);
    ang_canvas canvas;
    ang_gui_canvas(gui, "preset strip", room, height + line + bar, &canvas);
    int chosen = ang_preset_chosen(viewer, presets, count);
    bool moved = move_cursor(viewer, &canvas, chosen, count);
    scroll(viewer, &canvas, chosen, moved, pitch, all - room);
    double left = thumbnails->scroll;
    thumbnails->first = (int)floor(left / pitch);
    thumbnails->last = (int)floor((left + room - 1) / pitch);
    double at = left + canvas.x;
    int under = (int)floor(at / pitch);
    if (canvas.hovered && canvas.y < height + line && under < count && at - under * pitch < width) pointed = under;
    if (thumbnails->by_keys) pointed = thumbnails->cursor;
    ang_gui_clip(gui, canvas.rect);
    for (int i = thumbnails->first; i <= thumbnails->last && i < count; i++) {
        ang_rect picture = {canvas.rect.x + i * pitch - left, canvas.rect.y, width, height};
        draw(viewer, presets[i], i, picture, i == pointed);
    }
    if (all > room) {
        double y = canvas.rect.y + height + line;
        ang_gui_fill(gui, (ang_rect){canvas.rect.x, y, room, bar}, viewer->theme->grid);
        ang_gui_fill(gui, (ang_rect){canvas.rect.x + left / all * room, y, room / all * room, bar},
                     viewer->theme->bar_grip);
    }
    ang_gui_unclip(gui);
    if (pointed >= 0) tell(gui, presets[pointed]);
    if (pointed >= 0 && (canvas.activated || (canvas.clicked && canvas.released == ANG_BUTTON_LEFT)))
        ang_viewer_choose_preset(viewer, presets[pointed]);
}
