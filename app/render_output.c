#include "app/render_output.h"

#include "app/verbs.h"
#include "core/scene/annotation.h"
#include "io/image/image_io.h"
#include "io/preset/preset.h"
#include "io/replace.h"
#include "io/report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool ang_render_output_is_capture(const char *path) {
    size_t length = strlen(path);
    return length > 4 && strcasecmp(path + length - 4, ".dcm") == 0;
}

/* OUT.png becomes OUT-0007.png where several pictures are made. */
static void frame_path(const char *output, int frame, int frames, char *path, size_t size) {
    const char *slash = strrchr(output, '/'), *dot = strrchr(slash ? slash : output, '.');
    if (frames == 1 || !dot || ang_movie_is(output))
        snprintf(path, size, "%s", output);
    else
        snprintf(path, size, "%.*s-%04d%s", (int)(dot - output), output, frame + 1, dot);
}

static bool writable(const ang_options *options, ang_error *err) {
    int size[2];
    if (!ang_app_parse_dims("size", options->size, 2, 65536, size, err)) return false;
    if (ang_render_output_is_capture(options->output)) return ang_file_replaceable(options->output, err);
    if (!ang_movie_is(options->output)) {
        ang_error own = {0};
        if (ang_image_writable(options->output, &own)) return true;
        bool unknown = own.code == ANG_USAGE && strstr(own.message, "extension");
        return ang_fail(err, own.code, "%s%s", own.message, unknown ? "; or .dcm, .mp4 or .avi" : "");
    }
    if (options->frames < 2)
        return ang_fail(err, ANG_USAGE,
                        "-o %s: a film needs --frames N, and --orbit or --sweep to show more than one picture",
                        options->output);
    return ang_movie_writable(options->output, size[0], size[1], err);
}

bool ang_render_output_check(const ang_options *options, ang_error *err) {
    const char *json = options->json && strcmp(options->json, "-") != 0 ? options->json : NULL;
    if (!writable(options, err)) return false;
    if (json && !ang_file_replaceable(json, err)) return false;
    if (json && options->state && ang_file_same(options->state, json))
        return ang_fail(err, ANG_USAGE, "--json %s: is read as state; give the output another name", json);
    int files = ang_movie_is(options->output) ? 1 : options->frames;
    for (int frame = 0; frame < files; frame++) {
        char path[4096];
        frame_path(options->output, frame, options->frames, path, sizeof path);
        if (options->state && ang_file_same(options->state, path))
            return ang_fail(err, ANG_USAGE, "-o %s: is read as state; give the picture another name", path);
        if (json && ang_file_same(path, json))
            return ang_fail(err, ANG_USAGE, "--json %s: is the picture too (-o); give one of them another name", json);
        if (ang_load_reads(options->arguments[0], path))
            return ang_fail(err, ANG_USAGE, "-o %s: is read as input; give the picture another name", path);
    }
    bool preset =
        json && options->preset && ang_preset_is_path(options->preset) && ang_file_same(options->preset, json);
    if (json && (preset || ang_load_reads(options->arguments[0], json)))
        return ang_fail(err, ANG_USAGE, "--json %s: is read as %s; give the output another name", json,
                        preset ? "preset" : "input");
    return true;
}

bool ang_render_output_start(ang_render_output *output, const ang_options *options, const ang_load_report *report,
                             ang_notes *warnings, ang_error *err) {
    int size[2];
    char name[32];
    *output = (ang_render_output){.options = options, .captures = ang_render_output_is_capture(options->output)};
    if (!ang_app_parse_dims("size", options->size, 2, 65536, size, err)) return false;
    if (ang_movie_is(options->output)) {
        output->movie = ang_movie_open(options->output, size[0], size[1], options->fps, err);
        return output->movie != NULL;
    }
    if (!output->captures) return true;
    ang_load_report_name(report, name);
    return ang_capture_begin(&output->capture, report->identity, options->keep_phi, name, ANG_VERSION, warnings, err);
}

static bool write_capture(ang_render_output *output, int frame, const char *path, const ang_image *image,
                          const ang_render_words *words, ang_error *err) {
    ang_annotation letters = ang_annotation_make(words->scene, NULL);
    ang_capture_picture picture = {.width = image->width,
                                   .height = image->height,
                                   .number = frame + 1,
                                   .right = letters.right.text,
                                   .down = letters.bottom.text,
                                   .description = words->description};
    unsigned char *rgb = NULL, *file = NULL;
    size_t size = 0;
    bool made = ang_image_rgb(image, words->scene->background, &rgb, err);
    picture.rgb = rgb;
    bool written = made && ang_capture_encode(&output->capture, &picture, &file, &size, err) &&
                   ang_file_replace(path, file, size, err);
    free(rgb);
    free(file);
    return written;
}

bool ang_render_output_add(ang_render_output *output, int frame, const ang_image *image, const ang_render_words *words,
                           ang_error *err) {
    const double *background = words->scene->background;
    char path[4096];
    frame_path(output->options->output, frame, output->options->frames, path, sizeof path);
    if (output->movie) return ang_movie_add(output->movie, image, background, err);
    if (output->captures) return write_capture(output, frame, path, image, words, err);
    return ang_image_write_stated(path, image, background, words->state, err);
}

bool ang_render_output_finish(ang_render_output *output, ang_error *err) {
    ang_movie *movie = output->movie;
    output->movie = NULL;
    return !movie || ang_movie_finish(movie, err);
}

void ang_render_output_clear(ang_render_output *output) {
    ang_movie_abandon(output->movie);
    *output = (ang_render_output){0};
}

double ang_render_output_rounding(const ang_options *options, const double background[4]) {
    const char *path = options->output;
    if (ang_render_output_is_capture(path)) return 0.5;
    if (ang_movie_is(path)) return ang_movie_lossless(path) ? 0.5 : NAN;
    return ang_image_rounding(path, background);
}
