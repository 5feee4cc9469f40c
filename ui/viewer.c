#include "ui/viewer_private.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/volume/histogram.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double message_seconds = 6;
/* After the one that an event needs: lists and messages measure themselves in one frame and show in a later one. */
enum { settling_frames = 2 };
/* At zoom 1 a picture holds the volume from any side, with much room around it from most. */
const ang_view ang_viewer_first_view = {.zoom = 1.6, .projection = ANG_PERSPECTIVE, .fov_deg = 30};

const char *ang_tool_name(ang_tool tool) {
    static const char *const names[ANG_TOOLS] = {"window", "crosshair", "pan"};
    return names[tool];
}

void ang_viewer_say(ang_viewer *viewer, bool bad, const char *format, ...) {
    va_list args;
    va_start(args, format);
    vsnprintf(viewer->message, sizeof viewer->message, format, args);
    va_end(args);
    viewer->message_bad = bad;
    viewer->message_until = ang_now_ms() / 1000 + message_seconds;
}

double ang_viewer_hu_at(const ang_viewer *viewer, ang_vec3 mm) {
    const ang_volume *volume = viewer->study.volume;
    ang_mat4 to_index;
    ang_vec3 lower, upper;
    if (!ang_mat4_inverse(&volume->affine, &to_index)) return NAN;
    ang_volume_box(volume, &lower, &upper);
    ang_vec3 at = ang_mat4_point(&to_index, mm);
    for (int axis = 0; axis < 3; axis++)
        if (ang_vec3_at(at, axis) < ang_vec3_at(lower, axis) - 1e-4 ||
            ang_vec3_at(at, axis) > ang_vec3_at(upper, axis) + 1e-4)
            return NAN;
    return ang_volume_hu(volume, ang_volume_sample(volume, at));
}

void ang_viewer_point_at(ang_viewer *viewer, ang_vec3 mm) {
    for (int i = 0; i < ANG_ORIENTATIONS; i++)
        mm = ang_slice_place(&viewer->range[i], mm, ang_slice_index(&viewer->range[i], mm));
    viewer->crosshair = mm;
}

void ang_viewer_choose_preset(ang_viewer *viewer, const ang_preset *preset) {
    ang_document_take_preset(&viewer->document, preset);
    viewer->chosen = viewer->document;
    viewer->point = -1;
}

void ang_viewer_save_preset(ang_viewer *viewer) {
    ang_error err = {0};
    const ang_viewer_host *host = viewer->host;
    if (!host->save_preset(host->context, &viewer->document, viewer->saved, sizeof viewer->saved, &err)) {
        viewer->saved[0] = '\0';
        ang_viewer_say(viewer, true, "%s", err.message);
    } else {
        ang_viewer_say(viewer, false, "Saved %s", viewer->saved);
    }
}

void ang_viewer_file_window(const ang_viewer *viewer, double *centre, double *width) {
    const ang_study *study = &viewer->study;
    *centre = study->hounsfield ? 40 : (viewer->editor_low + viewer->editor_high) / 2;
    *width = study->hounsfield ? 400 : viewer->editor_high - viewer->editor_low;
    if (!isfinite(study->window_centre) || !(study->window_width > 0)) return;
    *centre = study->window_centre;
    *width = study->window_width;
}

static const ang_preset *preset_named(const ang_viewer *viewer, const char *name) {
    for (int i = 0; viewer->host->presets[i]; i++)
        if (strcmp(viewer->host->presets[i]->name, name) == 0) return viewer->host->presets[i];
    return NULL;
}

/* The preset to begin with; one of the host's making where the values are no Hounsfield units. */
static const ang_preset *first_preset(ang_viewer *viewer, const char *wanted, ang_error *err) {
    const ang_preset *found = wanted ? preset_named(viewer, wanted) : NULL;
    if (found) return found;
    viewer->own_preset = viewer->host->preset_for(viewer->host->context, &viewer->study, err);
    return viewer->own_preset;
}

static void close_study(ang_viewer *viewer) {
    if (!viewer->ready) return;
    ang_thumbnails_clear(viewer);
    ang_volume_picture_clear(viewer);
    for (int i = 0; i < ANG_ORIENTATIONS; i++) ang_slice_picture_clear(viewer, &viewer->slice[i]);
    free(viewer->histogram);
    viewer->histogram = NULL;
    ang_history_clear(&viewer->history);
    ang_preset_free(viewer->own_preset);
    viewer->own_preset = NULL;
    viewer->host->release(viewer->host->context, &viewer->study);
    viewer->study = (ang_study){0};
    viewer->ready = false;
}

static void show_study(ang_viewer *viewer, const ang_study *study, const char *wanted_preset) {
    close_study(viewer);
    viewer->study = *study;
    viewer->ready = true;
    ang_document *document = &viewer->document;
    memset(document, 0, sizeof *document);
    document->view = ang_viewer_first_view;
    document->iso_hu = 300;
    ang_transfer_editor_start(viewer);
    ang_error err = {0};
    const ang_preset *preset = first_preset(viewer, wanted_preset, &err);
    if (!preset) {
        close_study(viewer);
        snprintf(viewer->failure, sizeof viewer->failure, "%s", err.message);
        return;
    }
    ang_viewer_choose_preset(viewer, preset);
    ang_viewer_file_window(viewer, &document->window_centre, &document->window_width);
    for (int i = 0; i < ANG_ORIENTATIONS; i++) {
        viewer->range[i] = ang_slice_range_of(study->volume, (ang_orientation)i);
        viewer->slice[i].view = ang_slice_view_default;
    }
    ang_viewer_point_at(viewer, ang_volume_centre(study->volume));
    ang_history_note(&viewer->history, document, 0);
}

void ang_viewer_open(ang_viewer *viewer, const char *path) {
    ang_error err = {0};
    ang_loading_end(&viewer->loading);
    viewer->failure[0] = '\0';
    if (!ang_loading_start(&viewer->loading, viewer->host, path, &err))
        snprintf(viewer->failure, sizeof viewer->failure, "%s", err.message);
}

static void take_loaded(ang_viewer *viewer, const char *wanted_preset) {
    bool done;
    ang_study study;
    ang_error err;
    if (!ang_loading_take(&viewer->loading, &done, &study, &err)) return;
    if (done)
        show_study(viewer, &study, wanted_preset);
    else if (err.code == ANG_INTERRUPTED)
        snprintf(viewer->failure, sizeof viewer->failure, "Loading was cancelled.");
    else
        snprintf(viewer->failure, sizeof viewer->failure, "%s", err.message);
    viewer->redraws = 2;
}

/* Loading, a failure, or what to do: in the middle of the window. */
static void show_loading(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    char what[64];
    double width = ang_gui_px(gui, 380);
    double fraction = ang_loading_progress(&viewer->loading, what);
    ang_gui_message_begin(gui, "loading");
    ang_gui_text(gui, "%s", what[0] ? what : "opening");
    ang_gui_progress(gui, fraction, width);
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    if (ang_gui_button(gui, "Cancel", ang_gui_px(gui, 96), true)) ang_loading_stop(&viewer->loading);
    ang_gui_same_line(gui);
    ang_gui_text_dim(gui, "%3.0f %%", 100 * fraction);
    ang_gui_message_end(gui);
}

static void show_failure(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_gui_message_begin(gui, "failure");
    ang_gui_paragraph(gui, viewer->failure, ang_gui_px(gui, 480));
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    if (ang_gui_button(gui, "Open...", ang_gui_px(gui, 96), true)) viewer->opening = true;
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, viewer->ready ? "Close" : "Quit", ang_gui_px(gui, 96), true)) {
        if (!viewer->ready) ang_window_close(viewer->window);
        viewer->failure[0] = '\0';
    }
    ang_gui_message_end(gui);
}

static void show_opening(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    double width = ang_gui_px(gui, 480);
    ang_gui_message_begin(gui, "open");
    ang_gui_text(gui, "Folder or file to open");
    bool entered = ang_gui_text_field(gui, "##path", viewer->typed_path, sizeof viewer->typed_path, width);
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    entered = ang_gui_button(gui, "Open", ang_gui_px(gui, 96), viewer->typed_path[0] != '\0') || entered;
    ang_gui_same_line(gui);
    bool closed = ang_gui_button(gui, "Cancel", ang_gui_px(gui, 96), true);
    ang_gui_same_line(gui);
    ang_gui_text_dim(gui, "or drop it on the window");
    if (entered && viewer->typed_path[0]) ang_viewer_open(viewer, viewer->typed_path);
    if (entered || closed) viewer->opening = false;
    ang_gui_message_end(gui);
}

static void show_welcome(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_gui_message_begin(gui, "welcome");
    ang_gui_text(gui, "Drop a folder of DICOM slices here, or open one.");
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    if (ang_gui_button(gui, "Open...", ang_gui_px(gui, 96), true)) viewer->opening = true;
    ang_gui_message_end(gui);
}

static void show_notes(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_gui_message_begin(gui, "notes");
    ang_gui_text(gui, "What loading found and assumed");
    ang_gui_gap(gui, ang_gui_px(gui, 4));
    for (size_t i = 0; i < viewer->study.notes.count; i++) {
        char line[ANG_NOTES_LINE + 16], text[ANG_NOTES_LINE];
        ang_notes_line(&viewer->study.notes, i, true, text, sizeof text);
        snprintf(line, sizeof line, "%s%s", (int)i < viewer->study.warnings ? "Warning: " : "", text);
        ang_gui_paragraph(gui, line, ang_gui_px(gui, 600));
        ang_gui_gap(gui, ang_gui_px(gui, 2));
    }
    if (ang_gui_button(gui, "Close", ang_gui_px(gui, 96), true)) viewer->notes = false;
    ang_gui_message_end(gui);
}

static void messages(ang_viewer *viewer) {
    if (viewer->opening)
        show_opening(viewer);
    else if (viewer->loading.running)
        show_loading(viewer);
    else if (viewer->failure[0])
        show_failure(viewer);
    else if (!viewer->ready)
        show_welcome(viewer);
    else if (viewer->notes)
        show_notes(viewer);
    else if (viewer->browsing)
        ang_thumbnails_show(viewer);
    ang_actions_help(viewer);
}

/* Two by two, or one of them large. */
static void place_panes(ang_viewer *viewer, ang_rect all) {
    double gap = ang_gui_px(viewer->gui, 2);
    double width = floor((all.width - gap) / 2), height = floor((all.height - gap) / 2);
    for (int i = 0; i < ANG_PANES; i++) {
        bool right = i % 2, low = i / 2;
        viewer->pane[i] = (ang_rect){right ? all.x + width + gap : all.x, low ? all.y + height + gap : all.y,
                                     right ? all.width - width - gap : width, low ? all.height - height - gap : height};
        if (viewer->maximised >= 0) viewer->pane[i] = i == viewer->maximised ? all : (ang_rect){0};
    }
}

static void panes(ang_viewer *viewer) {
    viewer->hovered = ANG_PANES;
    viewer->hovered_hu = NAN;
    for (int i = 0; i < ANG_PANES; i++) {
        if (viewer->pane[i].width < 1) continue;
        if (i == ANG_PANE_VOLUME)
            ang_volume_pane(viewer, viewer->pane[i]);
        else
            ang_slice_pane(viewer, (ang_pane)i, viewer->pane[i]);
    }
}

static void layout(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    const ang_input *input = &viewer->input;
    double top = ang_actions_menus(viewer), status = ang_gui_px(gui, 24),
           side = viewer->ready ? ang_gui_px(gui, 320) : 0;
    double tall = input->height - top - status;
    if (viewer->ready) {
        ang_panel(viewer, (ang_rect){0, top, side, tall});
        place_panes(viewer, (ang_rect){side, top, input->width - side, tall});
        panes(viewer);
    }
    ang_status_line(viewer, (ang_rect){0, top + tall, input->width, status});
    messages(viewer);
}

static void save(ang_viewer *viewer, const char *what, const ang_image *image, ang_error *err) {
    if (!viewer->host->save_picture(viewer->host->context, what, image, viewer->saved, sizeof viewer->saved, err)) {
        viewer->saved[0] = '\0';
        ang_viewer_say(viewer, true, "%s", err->message);
    } else {
        ang_viewer_say(viewer, false, "Saved %s", viewer->saved);
    }
}

static void save_window(ang_viewer *viewer) {
    ang_error err = {0};
    ang_image image = {0};
    int width = viewer->input.width, height = viewer->input.height;
    size_t pixels = (size_t)width * (size_t)height;
    viewer->save_window = false;
    uint8_t *rgb = ang_alloc(pixels, 3, "the window's picture", &err);
    if (rgb && ang_image_create(&image, width, height, &err)) {
        ang_painter_read(viewer->painter, rgb);
        for (size_t i = 0; i < pixels; i++) {
            for (size_t c = 0; c < 3; c++) image.rgba[4 * i + c] = (float)rgb[3 * i + c] / 255;
            image.rgba[4 * i + 3] = 1;
        }
        save(viewer, "window", &image, &err);
        ang_image_clear(&image);
    } else {
        ang_viewer_say(viewer, true, "%s", err.message);
    }
    free(rgb);
}

/* The 3D pane's picture only once it is refined. */
static void save_pane(ang_viewer *viewer) {
    ang_error err = {0};
    if (viewer->save_pane == ANG_PANE_VOLUME) {
        if (!viewer->volume.refined) return;
        if (viewer->volume.failure[0])
            ang_viewer_say(viewer, true, "%s", viewer->volume.failure);
        else
            save(viewer, "volume", &viewer->volume.image, &err);
    } else {
        ang_image image = {0};
        if (ang_slice_image(viewer, (ang_orientation)viewer->save_pane, &image, &err))
            save(viewer, ang_orientation_name((ang_orientation)viewer->save_pane), &image, &err);
        else
            ang_viewer_say(viewer, true, "%s", err.message);
        ang_image_clear(&image);
    }
    viewer->save_wanted = false;
}

static void tell_host(ang_viewer *viewer) {
    if (!viewer->host->shown) return;
    const ang_volume_picture *volume = &viewer->volume;
    ang_viewer_state state = {.phase = viewer->loading.running ? "loading"
                                       : viewer->failure[0]    ? "failed"
                                       : viewer->ready         ? "ready"
                                                               : "empty",
                              .study = viewer->ready ? &viewer->study : NULL,
                              .document = &viewer->document,
                              .crosshair = viewer->crosshair,
                              .hovered = viewer->hovered,
                              .hovered_hu = viewer->hovered_hu,
                              .maximised = viewer->maximised,
                              .editor = viewer->editor,
                              .editor_low = viewer->editor_low,
                              .editor_high = viewer->editor_high,
                              .point = viewer->point,
                              .tool = ang_tool_name(viewer->tool),
                              .method = volume->method ? volume->method->name : NULL,
                              .size = {volume->size[0], volume->size[1]},
                              .refined = volume->refined,
                              .latency_ms = viewer->latency_ms,
                              .frame_ms = volume->frame_ms,
                              .undo = ang_history_can_undo(&viewer->history),
                              .redo = ang_history_can_redo(&viewer->history),
                              .saved = viewer->saved[0] ? viewer->saved : NULL,
                              .frames = viewer->frames};
    for (int i = 0; i < ANG_ORIENTATIONS && viewer->ready; i++) {
        state.slice[i].index = ang_slice_index(&viewer->range[i], viewer->crosshair);
        state.slice[i].count = viewer->range[i].count;
        state.slice[i].zoom = viewer->slice[i].view.zoom;
        memcpy(state.slice[i].pan_mm, viewer->slice[i].view.pan_mm, sizeof state.slice[i].pan_mm);
        state.pane[i] = viewer->pane[i];
    }
    state.pane[ANG_PANE_VOLUME] = viewer->pane[ANG_PANE_VOLUME];
    viewer->host->shown(viewer->host->context, &state);
}

static bool draw_frame(ang_viewer *viewer, ang_error *err) {
    static const float background[3] = {0, 0, 0};
    if (!ang_gui_begin(viewer->gui, &viewer->input, err)) return false;
    viewer->typing = ang_gui_typing(viewer->gui);
    if (viewer->message[0] && viewer->input.time_seconds > viewer->message_until) viewer->message[0] = '\0';
    ang_actions_keys(viewer);
    layout(viewer);
    ang_painter_clear(viewer->painter, viewer->input.width, viewer->input.height, background);
    ang_gui_end(viewer->gui);
    if (viewer->save_window) save_window(viewer);
    ang_window_show(viewer->window);
    viewer->frames++;
    if (viewer->input.since_seconds > 0) viewer->latency_ms = ang_now_ms() - 1000 * viewer->input.since_seconds;
    if (viewer->ready && !ang_gui_holding(viewer->gui) && !viewer->typing)
        ang_history_note(&viewer->history, &viewer->document, viewer->input.time_seconds);
    if (viewer->save_wanted && viewer->ready) save_pane(viewer);
    return ang_painter_check(viewer->painter, err);
}

/* Sleeps as long as nothing has to be drawn; refines the picture when the hands rest. */
static void rest(ang_viewer *viewer) {
    if (viewer->redraws > 0) {
        viewer->redraws--;
        ang_window_wait(viewer->window, 0);
        return;
    }
    tell_host(viewer);
    double seconds = INFINITY;
    bool shown = viewer->ready && viewer->pane[ANG_PANE_VOLUME].width >= 1;
    if (shown) seconds = ang_volume_refine_in(viewer);
    bool thumbnails = shown && ang_thumbnails_wanted(viewer);
    if (thumbnails) seconds = 0;
    if (viewer->message[0]) seconds = fmin(seconds, fmax(viewer->message_until - ang_now_ms() / 1000, 0.01));
    if (viewer->typing) seconds = fmin(seconds, 0.5); /* the text cursor blinks */
    if (seconds > 0) ang_window_wait(viewer->window, seconds);
    if (shown && !ang_window_pending(viewer->window) && ang_volume_refine_in(viewer) <= 0) {
        ang_rect rect = viewer->pane[ANG_PANE_VOLUME];
        ang_volume_update(viewer, (int)rect.width, (int)rect.height, true);
    }
    viewer->redraws = settling_frames;
    if (thumbnails && !ang_window_pending(viewer->window)) {
        ang_thumbnails_step(viewer);
        viewer->redraws = 0; /* nothing has to settle */
    }
}

static bool work(ang_viewer *viewer, const ang_viewer_options *options, ang_error *err) {
    if (options->path) ang_viewer_open(viewer, options->path);
    viewer->redraws = 2;
    while (!ang_window_closing(viewer->window)) {
        take_loaded(viewer, options->preset);
        char *dropped = ang_window_dropped(viewer->window);
        if (dropped) ang_viewer_open(viewer, dropped);
        free(dropped);
        bool more = ang_window_input(viewer->window, &viewer->input);
        if (viewer->input.width < 1 || viewer->input.height < 1) {
            ang_window_wait(viewer->window, INFINITY); /* iconified */
            continue;
        }
        if (!draw_frame(viewer, err)) return false;
        if (more)
            ang_window_wait(viewer->window, 0);
        else
            rest(viewer);
    }
    return true;
}

bool ang_viewer_run(const ang_viewer_host *host, const ang_viewer_options *options, ang_error *err) {
    ang_viewer *viewer = ang_alloc(1, sizeof *viewer, "the viewer", err);
    if (!viewer) return false;
    viewer->host = host;
    viewer->maximised = viewer->point = -1;
    viewer->gesture.pane = -1;
    viewer->hovered = ANG_PANES;
    viewer->corner_text = viewer->crosshair_shown = true;
    viewer->window = ang_window_create("Angioscope", options->width, options->height, err);
    if (viewer->window) viewer->painter = ang_painter_create(ang_window_gl(viewer->window), err);
    if (viewer->painter) viewer->gui = ang_gui_create(viewer->window, viewer->painter, host->font, err);
    bool done = viewer->gui && work(viewer, options, err);
    ang_loading_end(&viewer->loading);
    close_study(viewer);
    ang_gui_destroy(viewer->gui);
    ang_painter_destroy(viewer->painter);
    ang_window_destroy(viewer->window);
    free(viewer);
    return done;
}
