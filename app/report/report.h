/* What `angioscope report` measures and writes: runs, the truth that they are compared with, what follows from them. */
#ifndef ANG_APP_REPORT_H
#define ANG_APP_REPORT_H

#include "app/picture.h"
#include "app/verbs.h"
#include "core/error/convergence.h"
#include "core/error/metrics.h"
#include "core/render/context.h"
#include "core/render/method.h"
#include "io/session/state.h"

#include <cjson/cJSON.h>
#include <stdio.h>

enum {
    ANG_REPORT_FRAMES = 5,      /* timed a setting where time allows */
    ANG_REPORT_LEAST_FRAMES = 3 /* for which time is kept back */
};

typedef enum ang_report_group {
    ANG_REPORT_STEPS,    /* every method over all steps, as the options say otherwise */
    ANG_REPORT_ORDERS,   /* the same on the subset without ray termination, whose error no step lessens */
    ANG_REPORT_SWITCHES, /* at one step, one thing switched */
} ang_report_group;
const char *ang_report_group_name(ang_report_group group);

typedef enum ang_report_kind { ANG_REPORT_MAX, ANG_REPORT_P999, ANG_REPORT_RMS, ANG_REPORT_KINDS } ang_report_kind;

/* One setting and what came of it. Errors in levels. */
typedef struct ang_report_run {
    ang_report_group group;
    const ang_method *method;
    ang_render_options options;
    ang_shading shading;
    char switched[48]; /* of ANG_REPORT_SWITCHES: what; else "" */
    bool subset;       /* only the subset of pixels is drawn */

    bool drawn;
    char left_out[256];       /* why, where not drawn */
    ang_metrics error;        /* over `compared` pixels */
    ang_metrics subset_error; /* over the subset */
    size_t compared;
    double step_mm; /* used; 0: exact */
    uint64_t samples, pixels;
    int passes;
    ang_classify classification; /* of its steps; auto: no matter */
    double rough_ms;             /* of a frame, before it was timed */
    double frame_ms[ANG_REPORT_FRAMES];
    int frames; /* timed */

    /* What follows (judge.c). Times are of the whole picture; NaN where there are none. */
    double median_ms, least_ms, most_ms;
    double samples_per_pixel;
    bool estimated;               /* these four are not of a whole picture but derived */
    bool front[ANG_REPORT_KINDS]; /* on the Pareto front of that error over time, among ANG_REPORT_STEPS */
} ang_report_run;

/* The reference's pixels. */
typedef struct ang_report_truth {
    int stride, first_x, first_y; /* the subset, as ang_scene_subset takes it */
    ang_image whole;              /* rgba NULL: the subset alone was computed */
    ang_image subset;
    ang_image other_subset; /* with the other shading; rgba NULL: not needed */
    double pixel_ms;        /* of one pixel, on all threads */
    double whole_ms;        /* of the picture, measured or pixel_ms of each */
    bool whole_timed;
} ang_report_truth;

typedef struct ang_report_cache ang_report_cache;

/* Fitted for one method. */
typedef struct ang_report_order {
    const ang_method *method;
    ang_order fit; /* RMS over the subset, steps of 1 voxel and below */
    double rms[16];
} ang_report_order;

typedef struct ang_report {
    const ang_options *options; /* with what `state` says */
    const ang_state *state;     /* of --state; nothing in it without */
    ang_app_progress *progress;
    ang_volume *volume;
    ang_load_report input;
    ang_picture picture;
    double load_ms;
    ang_gl *gl;
    int filter_bits; /* 0: not measured */
    double filter_deviation;
    char processor[128];
    int threads;
    ang_report_cache *cache;
    ang_report_truth truth;
    ang_report_run *run;
    size_t run_count;
    double begun_ms, limit_ms;
    double load; /* processes that wanted a processor before anything was measured; NaN where the system does not say */
    ang_notes notes; /* what the reader must know */

    /* judge.c */
    ang_report_order *order;
    size_t order_count;
    ang_expected_order expected;
    const ang_report_run *recommended, *quick, *exact; /* NULL: none */
    bool good;                                         /* `recommended` keeps its promise */
} ang_report;

/* Steps in voxels, descending; the runs at `switch_step` have variants; below `fine_step` only the subset is drawn. */
extern const double ang_report_steps[];
enum { ANG_REPORT_STEP_COUNT = 7 };
extern const double ang_report_switch_step, ang_report_fine_step;
/* What 99.9 % of the pixels of a recommended setting keep within: what an 8-bit display can show. */
extern const double ang_report_good_levels, ang_report_quick_levels;
/* Errors that differ by less than this share are as good as each other on a front. */
extern const double ang_report_slack;

/* plan.c: lists the runs. False with ANG_LIMIT. */
bool ang_report_plan(ang_report *report, ang_error *err);
/* "1/8", "0.3"; static storage of the caller. */
const char *ang_report_step_text(double step, char text[16]);
bool ang_report_is_timed(const ang_report_run *run);
/* The scene of a run. */
ang_scene ang_report_scene(const ang_report *report, const ang_report_run *run);

/* truth.c: the reference, as a whole or on the subset. False with ANG_INTERRUPTED, ANG_LIMIT, ANG_GEOMETRY. */
bool ang_report_find_truth(ang_report *report, ang_error *err);
void ang_report_truth_clear(ang_report_truth *truth);
/* The pixels of a subset of `image` into a new picture. */
bool ang_report_take_subset(const ang_image *image, int stride, int first_x, int first_y, ang_image *out,
                            ang_error *err);

/* measure.c: draws and times. What fails alone is left out, saying why. False with ANG_INTERRUPTED, ANG_LIMIT. */
bool ang_report_measure(ang_report *report, ang_error *err);

/* The whole picture of a run that has been drawn: from the cache, or drawn again, since only pictures that a page shows
 * are kept. False where it cannot be. */
bool ang_report_picture(const ang_report *report, const ang_report_run *run, ang_image *image);

/* judge.c: times, fronts, orders, what to recommend. False with ANG_LIMIT. */
bool ang_report_judge(ang_report *report, ang_error *err);
/* Whether a run stands for its method and step in plots and fronts: a step may be drawn on the subset as well. */
bool ang_report_is_point(const ang_report_run *run);
/* The run of a method, step and group; NULL where there is none. */
const ang_report_run *ang_report_find(const ang_report *report, const ang_method *method, ang_report_group group,
                                      double step, bool subset);
double ang_report_error(const ang_report_run *run, ang_report_kind kind);

/* cache.c: what was measured before, in DIR/cache. Keys are hashes of all that decides a result. */
ang_report_cache *ang_report_cache_open(const ang_report *report, ang_error *err);
/* Writes what is new where the last time lies back some seconds, or at once. False with ANG_OUTPUT. */
bool ang_report_cache_save(ang_report_cache *cache, bool at_once, ang_error *err);
/* Removes what this report has not asked for. */
void ang_report_cache_prune(ang_report_cache *cache);
void ang_report_cache_close(ang_report_cache *cache);
bool ang_report_cache_get_run(ang_report_cache *cache, const ang_report *report, ang_report_run *run);
void ang_report_cache_put_run(ang_report_cache *cache, const ang_report *report, const ang_report_run *run);
/* Pictures by name: "truth", or what ang_report_picture_name gives. False where there is none. */
bool ang_report_cache_get_image(ang_report_cache *cache, const char *name, int width, int height, ang_image *image);
bool ang_report_cache_put_image(ang_report_cache *cache, const char *name, const ang_image *image, ang_error *err);
/* Pictures that were got or are said to be in use survive ang_report_cache_prune. */
void ang_report_cache_use_image(ang_report_cache *cache, const char *name);
void ang_report_picture_name(const ang_report *report, const ang_report_run *run, char name[160]);
/* Other numbers by name; NULL where there are none. Borrowed. */
const cJSON *ang_report_cache_get(ang_report_cache *cache, const char *name);
void ang_report_cache_put(ang_report_cache *cache, const char *name, cJSON *value);

/* data.c: files for programs. False with ANG_OUTPUT, ANG_LIMIT. */
bool ang_report_write_csv(const ang_report *report, const char *path, ang_error *err);
bool ang_report_write_json(const ang_report *report, const char *path, ang_error *err);

/* plots.c: SVG texts, free with free(); NULL where there is nothing to plot or gnuplot fails, which goes to the notes.
 */
typedef enum ang_report_plot_kind {
    ANG_REPORT_PLOT_MAX,
    ANG_REPORT_PLOT_P999,
    ANG_REPORT_PLOT_RMS,
    ANG_REPORT_PLOT_ORDERS,
    ANG_REPORT_PLOT_SAMPLES,
    ANG_REPORT_PLOTS
} ang_report_plot_kind;
const char *ang_report_plot_file(ang_report_plot_kind kind);
void ang_report_plot(ang_report *report, char *plots[ANG_REPORT_PLOTS]);

/* pictures.c: as data within a page. */
enum { ANG_REPORT_PICTURE_SIDE = 640 }; /* pixels; larger pictures are shrunk by a whole number */
/* Whether this build makes pictures, and heat maps of them; what it lacks goes to the notes. */
void ang_report_can_picture(ang_report *report, bool *pictures, bool *heat);
/* Writes an <img> of the picture over its background, with `alt` (plain text) and `class`. False, with nothing written,
 * where this build makes no PNG. */
bool ang_report_put_picture(FILE *out, const ang_image *image, const double background[4], const char *alt,
                            const char *class);
/* The same of the differences, in one logarithmic scale of colours from ang_report_heat_least (and below: black) to
 * ang_report_heat_most levels; and the scale itself. */
bool ang_report_put_heat(FILE *out, const ang_image *image, const ang_image *truth, const char *alt);
bool ang_report_put_heat_scale(FILE *out);
extern const double ang_report_heat_least, ang_report_heat_most;

/* tables.c: parts of the page. Numbers and text as HTML. */
void ang_report_put_settings_table(FILE *out, const ang_report *report);
void ang_report_put_switches_table(FILE *out, const ang_report *report);
void ang_report_put_orders_table(FILE *out, const ang_report *report);
void ang_report_put_left_out(FILE *out, const ang_report *report);
void ang_report_put_facts(FILE *out, const ang_report *report);       /* scene, machine, how it was measured */
const char *ang_report_time_text(double milliseconds, char text[32]); /* "840 ms", "1.2 s" */
const char *ang_report_levels_text(double levels, char text[32]);

/* html.c: the page. `plots` as from ang_report_plot. False with ANG_OUTPUT, ANG_LIMIT. */
bool ang_report_write_html(ang_report *report, char *const plots[ANG_REPORT_PLOTS], const char *path, ang_error *err);

#endif
