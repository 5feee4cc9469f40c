#include "app/option_table.h"

#include <getopt.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define FIELD(field) offsetof(ang_options, field)
#define DRAWS        (ANG_VERB_RENDER | ANG_VERB_REPORT)
#define READS        (ANG_VERB_INFO | DRAWS | ANG_VERB_VIEW)
#define ALL          (READS | ANG_VERB_PRESETS | ANG_VERB_PHANTOM | ANG_VERB_CHECK | ANG_VERB_SELFCHECK)
#define TEXT_OPTION(name, verbs, field, argument, initial, help)                                                       \
    { name, 0, TEXT, verbs, FIELD(field), argument, 0, 0, initial, NULL, help }
#define CHOICE_OPTION(name, field, words, initial, help)                                                               \
    { name, 0, CHOICE, DRAWS, FIELD(field), words, 0, 0, initial, NULL, help }
#define REAL_OPTION(name, verbs, field, argument, min, max, initial, unit, help)                                       \
    { name, 0, REAL, verbs, FIELD(field), argument, min, max, initial, unit, help }
#define INTEGER_OPTION(name, verbs, field, min, max, initial, help)                                                    \
    { name, 0, INTEGER, verbs, FIELD(field), "N", min, max, initial, NULL, help }
#define FLAG_OPTION(name, letter, verbs, field, help)                                                                  \
    { name, letter, FLAG, verbs, FIELD(field), NULL, 0, 0, NULL, NULL, help }

static const ang_option table[] = {
    {"output", 'o', TEXT, ANG_VERB_RENDER, FIELD(output), "OUT", 0, 0, NULL, NULL,
     "picture to write: .png or .tif (8 bit), .exr (float), .ppm (8 bit), .pfm (float) or .dcm (DICOM secondary "
     "capture), "
     "numbered with --frames; or a film of the frames: .mp4 (H.264) or .avi (FFV1, without loss)"},
    {"output", 'o', TEXT, ANG_VERB_REPORT, FIELD(output), "DIR", 0, 0, NULL, NULL,
     "folder to write report.html, .csv, .json and plots into; made where it does not exist; what was measured there "
     "before is taken over"},
    {"output", 'o', TEXT, ANG_VERB_PHANTOM, FIELD(output), "DIR", 0, 0, NULL, NULL,
     "folder to write; made where it does not exist"},
    {"output", 'o', TEXT, ANG_VERB_PRESETS, FIELD(output), "OUT", 0, 0, NULL, NULL,
     "import: preset to write, .json, instead of your own presets' folder; export: volume property, .vp or .vp.json "
     "(one preset) or .xml (several); sheet: picture"},
    FLAG_OPTION("replace", 0, ANG_VERB_PRESETS, replace,
                "import: write over presets of your own that have these names"),
    TEXT_OPTION("series", READS | ANG_VERB_PRESETS, series, "N|UID", NULL,
                "series to load, as numbered by info, or the end of its UID or file name; default: the "
                "largest CT volume, else the first by name"),
    INTEGER_OPTION("phase", READS, phase, 0, 1000000, "0",
                   "phase to load of a series of several at one place, as numbered by info; 0: the first"),
    TEXT_OPTION("preset", DRAWS | ANG_VERB_VIEW, preset, "NAME|FILE", NULL,
                "preset: see 'presets list'; default: one that suits the input"),
    REAL_OPTION("shift", DRAWS, shift, "HU", -1e5, 1e5, "0", "HU",
                "moves the preset's transfer function along the HU axis"),
    CHOICE_OPTION("method", method, "auto|cpu|adaptive|slicing|raycast|envelope|singlepass|reference", "auto",
                  "rendering method"),
    CHOICE_OPTION(
        "mode", mode, "dvr|mip|minip|mean|iso|lookups", NULL,
        "what a ray shows; default: the preset's; lookups: how many samples each pixel of that took, as a heat "
        "map"),
    REAL_OPTION("iso", DRAWS, iso, "HU", -1e6, 1e6, NULL, "HU", "iso value for --mode iso; default: the preset's"),
    CHOICE_OPTION("shading", shading, "none|phong", NULL, "shading in mode dvr; default: the preset's"),
    REAL_OPTION("step", ANG_VERB_RENDER, step, "VOXELS", 1e-5, 1e5, "0.5", "smallest spacings",
                "distance of samples along a ray"),
    TEXT_OPTION("size", DRAWS, size, "WxH", "512x512", "picture size in pixels"),
    TEXT_OPTION("size", ANG_VERB_PRESETS, size, "WxH", "256x256", "sheet: size of each preset's picture in pixels"),
    TEXT_OPTION("size", ANG_VERB_VIEW, size, "WxH", NULL, "window size in pixels; default: as suits the screen"),
    REAL_OPTION("scale", ANG_VERB_VIEW, scale, "X", 0.5, 8, NULL, NULL,
                "size of texts and controls, 1 on an ordinary screen; default: what the desktop says (Xft.dpi), or by "
                "the size of the screen's pixels"),
    TEXT_OPTION("pictures", ANG_VERB_VIEW, pictures, "DIR", ".", "folder that saved pictures and states go to"),
    TEXT_OPTION(
        "state", DRAWS, state, "FILE", NULL,
        "draw what a saved state of the viewer shows in 3D, or a picture of this program (.png, .exr) again; what "
        "other options say goes first; PATH may be left out where the state names its data"),
    TEXT_OPTION("state", ANG_VERB_VIEW, state, "FILE", NULL,
                "begin with a saved state, or with what a picture of this program shows; its data need not be named "
                "unless they have moved"),
    TEXT_OPTION("write-state", ANG_VERB_VIEW, write_state, "FILE", NULL,
                "write what is shown as JSON to this file whenever it has changed"),
    TEXT_OPTION(
        "view", DRAWS | ANG_VERB_PRESETS, view, "VIEW", "anterior",
        "anterior, posterior, left, right, superior, inferior (where the camera stands), or AZ,EL[,ROLL] in degrees; "
        "superior and inferior have anterior up, superior with the patient's right on the right: an axial slice as "
        "displayed, mirrored"),
    REAL_OPTION("zoom", DRAWS, zoom, "X", 1e-3, 1e4, "1", NULL,
                "magnification; at 1 all of the volume is inside the picture, however it is turned"),
    REAL_OPTION("zoom", ANG_VERB_PRESETS, zoom, "X", 1e-3, 1e4, NULL, NULL,
                "sheet: magnification; default: what fills the pictures with what is no air in the volume"),
    TEXT_OPTION("pan", DRAWS, pan, "X,Y", "0,0", "moves the camera to the right and up, in mm"),
    CHOICE_OPTION("projection", projection, "perspective|parallel", "perspective", "projection"),
    REAL_OPTION("fov", DRAWS, fov, "DEG", 0.01, 179, "30", "degrees", "vertical field of view in perspective"),
    TEXT_OPTION("clip", DRAWS, clip, "x0,x1,y0,y1,z0,z1", NULL,
                "clip box along the index axes, in mm from the first voxel or each with % of the box"),
    TEXT_OPTION(
        "clip-plane", DRAWS, clip_plane, "NX,NY,NZ,OFFSET_MM", NULL,
        "cut away what lies beyond an oblique plane: along the normal NX,NY,NZ (LPS, of any length) farther than "
        "OFFSET_MM from the origin of LPS"),
    FLAG_OPTION("axes", 0, DRAWS, axes,
                "draw the patient's axes through the middle of the volume, with letters at their ends"),
    TEXT_OPTION(
        "cut-plane", DRAWS, cut_plane, "PLANE[:MM|%],...", NULL,
        "opaque planes of voxels in the picture, shown through the preset's window: axial, coronal, sagittal, in "
        "mm from the first voxel or % of the box (default 50%)"),
    TEXT_OPTION("measure", DRAWS, measure, "X,Y,Z,X,Y,Z", NULL,
                "draw a measuring mark between two points in LPS mm, with its length; further pairs follow"),
    TEXT_OPTION("background", DRAWS, background, "R,G,B[,A]", "0,0,0,1", "background colour, each 0..1"),
    REAL_OPTION("termination", DRAWS, termination, "A", 0.01, 1, "0.999", NULL, "stop a ray at this opacity"),
    FLAG_OPTION("no-termination", 0, DRAWS, no_termination, "follow every ray to its end"),
    CHOICE_OPTION("proxy", proxy, "vertex-program|marching-cubes|marching-tetrahedra|convex-hull", "vertex-program",
                  "how --method slicing cuts its polygons"),
    CHOICE_OPTION(
        "gradients", gradients, "auto|lookups|texture", "auto",
        "envelope: where the gradients of Phong shading come from: six lookups a sample, or a texture made for "
        "the visible blocks"),
    CHOICE_OPTION("skipping", skipping, "both|outside|between", "both",
                  "envelope: leave out of rays what lies outside its faces, what lies between visible blocks, or both"),
    INTEGER_OPTION("quads", DRAWS, quads, 0, 10000000, "0",
                   "envelope: most faces it may have, coarser cells where there are more; 0: as many as pay"),
    CHOICE_OPTION(
        "classification", classification, "auto|midpoint|prefix", "auto",
        "mode dvr: what shows of a step: the value at its middle, all values between its ends, or whichever the "
        "transfer function and the data need"),
    FLAG_OPTION("no-skip", 0, DRAWS, no_skip, "draw what is invisible too"),
    TEXT_OPTION("bricks", DRAWS, bricks, "NxNxN", NULL,
                "slicing: this many bricks along each axis, or as many as cells allow, every visible one drawn; "
                "default: octree "
                "boxes where they pay"),
    INTEGER_OPTION(
        "passes-steps", DRAWS, pass_steps, 0, 64, "0",
        "slicing: planes that a fragment composites before it blends, 1, 2 or 4; raycast: samples of a ray in a pass; "
        "0: as many as pay"),
    FLAG_OPTION("separate-passes", 0, DRAWS, separate_passes,
                "raycast: look for empty space in passes of their own, as in the paper"),
    FLAG_OPTION("show-bricks", 0, ANG_VERB_RENDER, show_bricks, "slicing: draw the edges of the boxes"),
    REAL_OPTION(
        "gpu-memory", DRAWS, gpu_memory, "MB", 0.001, 1e9, NULL, "MB",
        "most memory that the volume's textures take; a larger volume is drawn in bricks by slicing (it stays whole in "
        "main memory)"),
    FLAG_OPTION("count-shown", 0, ANG_VERB_RENDER, count_shown,
                "count only samples that show, in mode dvr without shading: the fewest that any method could take"),
    REAL_OPTION("max-error", ANG_VERB_RENDER, max_error, "X", 1e-6, 255, NULL, "levels",
                "take the fastest method and step whose error is estimated to be at most this, in levels of 255"),
    REAL_OPTION("max-time", ANG_VERB_RENDER, max_time, "MS", 1e-3, 1e9, NULL, "ms",
                "take the method, step and, where time is short, every second or fourth pixel along each axis with the "
                "least error that draw a frame within this time, once everything is built"),
    INTEGER_OPTION("every", ANG_VERB_RENDER, every, 1, 16, "1",
                   "draw every Nth pixel along each axis and interpolate those between, for glances; --max-time "
                   "chooses it itself"),
    TEXT_OPTION("force", ANG_VERB_RENDER, force, "LIST|all", NULL,
                "use parts that the plan leaves out (see --explain), to prove that they change nothing: gradients, "
                "exponential, colour, rounding, termination, skipping, descent, near-plane, directions, border, slabs, "
                "redraw, gl"),
    FLAG_OPTION("explain", 0, ANG_VERB_RENDER, explain, "say what the picture takes and what is left out, and why"),
    FLAG_OPTION("manual-filter", 0, DRAWS, manual_filter,
                "interpolate in the shader instead of the texture unit, to verify filtering"),
    INTEGER_OPTION("frames", ANG_VERB_RENDER, frames, 1, 100000, "1", "number of pictures, spread over --orbit"),
    REAL_OPTION("orbit", ANG_VERB_RENDER, orbit, "DEG", -36000, 36000, "0", "degrees",
                "turn of the camera's azimuth over all frames"),
    TEXT_OPTION("sweep", ANG_VERB_RENDER, sweep, "PRESET,PRESET,...", NULL,
                "go from preset to preset over all frames, instead of --preset; all must be of one mode"),
    REAL_OPTION("fps", ANG_VERB_RENDER, fps, "N", 1, 240, "25", "frames a second", "speed of a film"),
    INTEGER_OPTION("repeat", ANG_VERB_RENDER, repeat, 0, 100000, "0",
                   "time this many frames after one warm-up, spread over --orbit"),
    CHOICE_OPTION("backend", backend, "auto|egl|osmesa|none", "auto", "where OpenGL comes from; none: without OpenGL"),
    {"backend", 0, CHOICE, ANG_VERB_SELFCHECK, FIELD(backend), "auto|egl|osmesa|none", 0, 0, "auto", NULL,
     "which OpenGL to check; auto: every one that is here; none: only what needs none"},
    TEXT_OPTION("cases", ANG_VERB_SELFCHECK, cases, "N,N,...", NULL, "check only the cases of these numbers"),
    INTEGER_OPTION("threads", READS | ANG_VERB_PHANTOM | ANG_VERB_SELFCHECK | ANG_VERB_PRESETS, threads, 0, 256, "0",
                   "processor threads; 0: all"),
    FLAG_OPTION("annotate", 0, ANG_VERB_RENDER, annotate,
                "draw orientation letters, a millimetre bar, preset, mode, and how wrong the picture may be"),
    FLAG_OPTION("strict", 0, READS | ANG_VERB_PRESETS, strict,
                "refuse input (exit code 4) where loading it gives a warning"),
    FLAG_OPTION("no-sandbox", 0, READS | ANG_VERB_PRESETS, no_sandbox,
                "decode compressed pixels in this process: a codec that fails on a damaged file may take the program "
                "with it"),
    FLAG_OPTION("keep-phi", 0, ANG_VERB_INFO | ANG_VERB_RENDER | ANG_VERB_VIEW, keep_phi,
                "let what may identify a patient into the output"),
    TEXT_OPTION("raw-dims", READS | ANG_VERB_PRESETS, raw_dims, "XxYxZ", NULL, "size of raw input, x fastest"),
    TEXT_OPTION("raw-type", READS | ANG_VERB_PRESETS, raw_type, "TYPE", NULL, "u8, i8, u16, i16 or f32, little endian"),
    TEXT_OPTION("raw-spacing", READS | ANG_VERB_PRESETS, raw_spacing, "X,Y,Z", NULL,
                "voxel spacing of raw input in mm; default 1,1,1"),
    REAL_OPTION("time-limit", ANG_VERB_REPORT, time_limit, "MINUTES", 0.01, 1e5, "20", "minutes",
                "most time to take; what does not fit is left out and listed, and made up for by the next run"),
    TEXT_OPTION("json", ANG_VERB_RENDER, json, "FILE|-", NULL, "write what was done, its error and its cost as JSON"),
    TEXT_OPTION("json", ANG_VERB_SELFCHECK, json, "FILE|-", NULL, "write the results as JSON; -: instead of the table"),
    FLAG_OPTION("json", 0, ANG_VERB_INFO | ANG_VERB_CHECK, json_flag, "print JSON to standard output"),
    TEXT_OPTION("dims", ANG_VERB_PHANTOM, dims, "XxYxZ", "512x512x96", "voxels of the phantom"),
    TEXT_OPTION("spacing", ANG_VERB_PHANTOM, spacing, "X,Y,Z", NULL,
                "voxel spacing in mm; default: the head fills the volume (0.45,0.45,1 at 512x512x96)"),
    REAL_OPTION("noise", ANG_VERB_PHANTOM, noise, "HU", 0, 1000, "8", "HU", "standard deviation of the noise"),
    INTEGER_OPTION("seed", ANG_VERB_PHANTOM, seed, 0, 2147483647, "1", "seed of the noise"),
    REAL_OPTION("threshold", ANG_VERB_CHECK, threshold, "X", 0, 255, "0", "levels",
                "exit code 1 where the largest difference is greater"),
    TEXT_OPTION("heat", ANG_VERB_CHECK, heat, "OUT.png", NULL, "write the differences as a heat map"),
    FLAG_OPTION("quiet", 'q', ALL, quiet, "no progress and no messages"),
    FLAG_OPTION("verbose", 'v', ALL, verbose, "say more on stderr"),
    FLAG_OPTION("help", 'h', ALL, help, "print this help"),
};
enum { table_length = sizeof table / sizeof *table };
_Static_assert((int)table_length <= (int)ANG_MOST_OPTIONS, "ang_options.given is too short");

const ang_option *ang_option_at(int index) { return index < table_length ? &table[index] : NULL; }

static bool is_choice(const char *words, const char *word) {
    size_t length = strlen(word);
    for (const char *at = words; at; at = strchr(at, '|'), at = at ? at + 1 : NULL)
        if (length > 0 && strncmp(at, word, length) == 0 && (at[length] == '|' || at[length] == '\0')) return true;
    return false;
}

static bool store(const ang_option *spec, const char *text, ang_options *options, ang_error *err) {
    void *field = (char *)options + spec->offset;
    char *end = NULL;
    switch (spec->type) {
    case FLAG:
        *(bool *)field = true;
        return true;
    case TEXT:
        *(const char **)field = text;
        return true;
    case CHOICE:
        if (!is_choice(spec->argument, text))
            return ang_fail(err, ANG_USAGE, "--%s %s: must be one of %s", spec->name, text, spec->argument);
        *(const char **)field = text;
        return true;
    case INTEGER:
    case REAL:
        break;
    }
    double value = strtod(text, &end);
    bool whole = spec->type == REAL || value == floor(value);
    if (end == text || *end || !whole || !(value >= spec->min && value <= spec->max))
        return ang_fail(err, ANG_USAGE, "--%s %s: must be a %snumber from %.10g to %.10g%s%s", spec->name, text,
                        spec->type == REAL ? "" : "whole ", spec->min, spec->max, spec->unit ? " " : "",
                        spec->unit ? spec->unit : "");
    if (spec->type == REAL)
        *(double *)field = value;
    else
        *(int *)field = (int)value;
    return true;
}

static bool set_defaults(ang_verb verb, ang_options *options, ang_error *err) {
    *options = (ang_options){0};
    for (int i = 0; i < table_length; i++)
        if (table[i].type == REAL) *(double *)((char *)options + table[i].offset) = NAN;
    for (int i = 0; i < table_length; i++) {
        if ((table[i].verbs & verb) && table[i].initial && !store(&table[i], table[i].initial, options, err))
            return false;
    }
    return true;
}

bool ang_options_parse(ang_verb verb, int argc, char **argv, ang_options *options, ang_error *err) {
    struct option long_options[table_length + 1];
    char letters[2 * table_length + 2] = ":";
    int count = 0;
    size_t used = 1;
    for (int i = 0; i < table_length; i++) {
        if (!(table[i].verbs & verb)) continue;
        bool argument = table[i].type != FLAG;
        long_options[count++] =
            (struct option){table[i].name, argument ? required_argument : no_argument, NULL, 256 + i};
        if (!table[i].letter) continue;
        letters[used++] = table[i].letter;
        if (argument) letters[used++] = ':';
    }
    letters[used] = '\0';
    long_options[count] = (struct option){0};
    if (!set_defaults(verb, options, err)) return false;

    optind = 0;
    opterr = 0;
    int code;
    while ((code = getopt_long(argc, argv, letters, long_options, NULL)) != -1) {
        const char *given = optind > 0 ? argv[optind - 1] : "";
        if (code == '?' && optopt >= 256)
            return ang_fail(err, ANG_USAGE, "--%s takes no value", table[optopt - 256].name);
        if (code == '?') return ang_fail(err, ANG_USAGE, "unknown option %s; --help lists what there is", given);
        if (code == ':') return ang_fail(err, ANG_USAGE, "option %s needs a value; --help says which", given);
        int index = code - 256;
        for (int i = 0; i < table_length && code < 256; i++)
            if (table[i].letter == code && (table[i].verbs & verb)) index = i;
        if (!store(&table[index], optarg, options, err)) return false;
        options->given[index] = true;
    }
    options->arguments = (const char **)argv + optind;
    options->argument_count = argc - optind;
    return true;
}

bool ang_options_offer(ang_verb verb, ang_options *options, const char *name, const char *text, ang_error *err) {
    for (int i = 0; i < table_length; i++) {
        if (!(table[i].verbs & verb) || strcmp(table[i].name, name) != 0) continue;
        if (table[i].type == FLAG && text[0]) return ang_fail(err, ANG_USAGE, "--%s takes no value", name);
        return options->given[i] || store(&table[i], text, options, err);
    }
    return ang_fail(err, ANG_USAGE, "there is no option --%s", name);
}

bool ang_options_given(ang_verb verb, const ang_options *options, const char *name) {
    for (int i = 0; i < table_length; i++)
        if ((table[i].verbs & verb) && strcmp(table[i].name, name) == 0) return options->given[i];
    return false;
}

static void value_text(const ang_option *spec, const ang_options *options, char *text, size_t size) {
    const void *field = (const char *)options + spec->offset;
    switch (spec->type) {
    case FLAG:
        snprintf(text, size, "%s", *(const bool *)field ? "yes" : "");
        break;
    case INTEGER:
        snprintf(text, size, "%d", *(const int *)field);
        break;
    case REAL:
        snprintf(text, size, "%.17g", *(const double *)field);
        break;
    case TEXT:
    case CHOICE:
        snprintf(text, size, "%s", *(const char *const *)field ? *(const char *const *)field : "");
        break;
    }
}

void ang_options_each(ang_verb verb, const ang_options *options,
                      void (*take)(void *context, const char *name, const char *value), void *context) {
    for (int i = 0; i < table_length; i++) {
        if (!(table[i].verbs & verb)) continue;
        char text[ANG_LONGEST_OPTION];
        value_text(&table[i], options, text, sizeof text);
        take(context, table[i].name, text);
    }
}

/* Writes words, breaking lines at column 100 and continuing at column `indent`. */
static void print_wrapped(FILE *out, const char *text, int indent) {
    int column = indent;
    while (*text) {
        int length = (int)strcspn(text, " ");
        if (column + length > 100 && column > indent) {
            fprintf(out, "\n%*s", indent, "");
            column = indent;
        }
        fprintf(out, "%.*s", length, text);
        text += length;
        column += length;
        if (*text == ' ') {
            fputc(' ', out);
            text++;
            column++;
        }
    }
}

void ang_options_help(ang_verb verb, FILE *out) {
    enum { indent = 34 };
    for (int i = 0; i < table_length; i++) {
        const ang_option *spec = &table[i];
        if (!(spec->verbs & verb)) continue;
        char left[128], text[512];
        snprintf(left, sizeof left, "  %c%c%s--%s %s", spec->letter ? '-' : ' ', spec->letter ? spec->letter : ' ',
                 spec->letter ? ", " : "  ", spec->name, spec->argument ? spec->argument : "");
        if (strlen(left) < indent - 1)
            fprintf(out, "%-*s", indent, left);
        else
            fprintf(out, "%s\n%*s", left, indent, "");
        int used = snprintf(text, sizeof text, "%s", spec->help);
        if (spec->initial && used < (int)sizeof text)
            snprintf(text + used, sizeof text - (size_t)used, " (default %s%s%s)", spec->initial, spec->unit ? " " : "",
                     spec->unit ? spec->unit : "");
        print_wrapped(out, text, indent);
        fputc('\n', out);
    }
}
