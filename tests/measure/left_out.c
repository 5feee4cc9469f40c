/* What each part that the plan leaves out would cost (docs/left-out.md): pictures with and without it in turn, as a
 * table in Markdown. Wall time in ms, and the ratio of processor time, which other work on the machine moves less;
 * medians. measure_left_out [PAIRS [SIZE [SIDE [PART]]]]
 * SIZE: of the pictures; SIDE: voxels of the phantom in a slice, of which there are 3/8 as many; PART: that alone. */
#include "core/base/clock.h"
#include "core/base/median.h"
#include "core/render/context.h"
#include "core/render/kept.h"
#include "core/volume/phantom.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_PAIRS = 99 };

typedef struct timing {
    double wall[MOST_PAIRS], processor[MOST_PAIRS];
} timing;

static double processor_ms(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static void stop(const char *what, const ang_error *err) {
    fprintf(stderr, "%s: %s\n", what, err->message);
    exit(1);
}

/* One way of drawing in which a part is left out. */
typedef struct trial {
    ang_part part;
    const ang_method *method;
    const char *scene; /* in words */
    ang_mode mode;
    int transfer;                        /* make_transfer() */
    bool phong, parallel, inside, fresh; /* fresh: with a new renderer every time */
} trial;

static const trial trials[] = {
    {.part = ANG_PART_GRADIENTS, .method = &ang_method_envelope, .scene = "vessels, no shading"},
    {.part = ANG_PART_GRADIENTS, .method = &ang_method_singlepass, .scene = "vessels, no shading"},
    {.part = ANG_PART_EXPONENTIAL, .method = &ang_method_singlepass, .scene = "vessels, no shading"},
    {.part = ANG_PART_EXPONENTIAL, .method = &ang_method_envelope, .scene = "vessels, no shading"},
    {.part = ANG_PART_COLOUR, .method = &ang_method_envelope, .scene = "vessels in one colour", .transfer = 1},
    {.part = ANG_PART_COLOUR, .method = &ang_method_singlepass, .scene = "vessels in one colour", .transfer = 1},
    {.part = ANG_PART_COLOUR, .method = &ang_method_slicing, .scene = "vessels in one colour", .transfer = 1},
    {.part = ANG_PART_ROUNDING, .method = &ang_method_singlepass, .scene = "vessels, no shading"},
    {.part = ANG_PART_TERMINATION, .method = &ang_method_raycast, .scene = "a faint haze", .transfer = 2},
    {.part = ANG_PART_TERMINATION, .method = &ang_method_slicing, .scene = "a faint haze", .transfer = 2},
    {.part = ANG_PART_SKIPPING, .method = &ang_method_envelope, .scene = "everything shows", .transfer = 2},
    {.part = ANG_PART_SKIPPING, .method = &ang_method_raycast, .scene = "everything shows", .transfer = 2},
    {.part = ANG_PART_DESCENT, .method = &ang_method_slicing, .scene = "everything shows", .transfer = 2},
    {.part = ANG_PART_DESCENT, .method = &ang_method_slicing, .scene = "vessels"},
    {.part = ANG_PART_NEAR_PLANE, .method = &ang_method_envelope, .scene = "vessels"},
    {.part = ANG_PART_DIRECTIONS, .method = &ang_method_raycast, .scene = "vessels, parallel", .parallel = true},
    {.part = ANG_PART_BORDER, .method = &ang_method_envelope, .scene = "vessels, from outside: faces"},
    {.part = ANG_PART_BORDER, .method = &ang_method_envelope, .scene = "vessels, from inside: a box", .inside = true},
    {.part = ANG_PART_SLABS, .method = &ang_method_envelope, .scene = "vessels, first picture", .fresh = true},
    {.part = ANG_PART_SLABS,
     .method = &ang_method_envelope,
     .scene = "shaded, first picture",
     .phong = true,
     .fresh = true},
    {.part = ANG_PART_SLABS, .method = &ang_method_raycast, .scene = "vessels, first picture", .fresh = true},
    {.part = ANG_PART_CLIP_PLANE, .method = &ang_method_singlepass, .scene = "vessels, no shading"},
    {.part = ANG_PART_CLIP_PLANE, .method = &ang_method_envelope, .scene = "vessels, no shading"},
    {.part = ANG_PART_CLIP_PLANE, .method = &ang_method_slicing, .scene = "vessels, no shading"},
    {.part = ANG_PART_REDRAW, .method = &ang_method_envelope, .scene = "vessels, shaded, again", .phong = true},
};

/* Vessels and bone; the same in one colour; a haze over all values. */
static ang_transfer *make_transfer(int which, ang_error *err) {
    static const ang_transfer_point vessels[] = {{.hu = 150, .colour = {0.6, 0.1, 0.05}, .opacity = 0},
                                                 {.hu = 350, .colour = {0.9, 0.4, 0.2}, .opacity = 0.1},
                                                 {.hu = 1200, .colour = {1, 0.95, 0.9}, .opacity = 0.5}},
                                    plain[] = {{.hu = 150, .colour = {0.9, 0.8, 0.7}, .opacity = 0},
                                               {.hu = 350, .colour = {0.9, 0.8, 0.7}, .opacity = 0.1},
                                               {.hu = 1200, .colour = {0.9, 0.8, 0.7}, .opacity = 0.5}},
                                    haze[] = {{.hu = -1024, .colour = {0.3, 0.3, 0.5}, .opacity = 0.001},
                                              {.hu = 1200, .colour = {1, 0.9, 0.8}, .opacity = 0.02}};
    const ang_transfer_point *const points[] = {vessels, plain, haze};
    return ang_transfer_create(points[which], which == 2 ? 2 : 3, 1, false, NULL, err);
}

typedef struct stage {
    ang_gl *gl;
    const ang_volume *volume;
    const trial *of;
    ang_scene scene;
    ang_renderer *renderer;
    ang_kept kept;
    ang_image image;
} stage;

static void draw(stage *s, unsigned forced, double *wall, double *processor) {
    ang_error err = {0};
    ang_render_options options = ang_render_options_default;
    options.forced = forced;
    double start = ang_now_ms(), used = processor_ms();
    if (s->of->fresh) {
        if (s->renderer) s->of->method->destroy(s->renderer);
        s->renderer = NULL;
        start = ang_now_ms();
        used = processor_ms();
    }
    if (!s->renderer) s->renderer = s->of->method->create(s->gl, s->volume, &options, &err);
    if (!s->renderer) stop("renderer", &err);
    bool again = s->of->part == ANG_PART_REDRAW && !forced;
    /* So that options are what they were: the picture to be kept was drawn before. */
    bool ok =
        again ? ang_kept_render(&s->kept, s->of->method, s->renderer, &s->scene, &options, &s->image, NULL, NULL, &err)
              : s->of->method->render(s->renderer, &s->scene, &options, &s->image, NULL, NULL, &err);
    if (!ok) stop("picture", &err);
    *wall = ang_now_ms() - start;
    *processor = processor_ms() - used;
}

/* Whether the part is left out here, as it must be to be measured. */
static bool is_forced(stage *s, unsigned forced) {
    if (s->of->part == ANG_PART_REDRAW) return true;
    ang_render_options options = ang_render_options_default;
    options.forced = forced;
    ang_plan plan = {0};
    ang_error err = {0};
    if (!s->of->method->explain(s->renderer, &s->scene, &options, &plan, &err)) stop("plan", &err);
    bool found = false;
    for (size_t i = 0; i < plan.uses.count; i++) found = found || strstr(plan.uses.item[i].what, "by --force");
    ang_plan_clear(&plan);
    return found;
}

static void measure(ang_gl *gl, const ang_volume *volume, const trial *t, int pairs, int size) {
    ang_error err = {0};
    ang_transfer *transfer = make_transfer(t->transfer, &err);
    stage s = {.gl = gl, .volume = volume, .of = t, .scene = ang_scene_default(volume)};
    ang_view view = ang_view_default;
    view.azimuth_deg = 30;
    view.elevation_deg = 15;
    if (t->parallel) view.projection = ANG_PARALLEL;
    s.scene.camera = ang_camera_for(volume, &view);
    if (t->inside) s.scene.camera.eye = ang_vec3_along(ang_volume_centre(volume), s.scene.camera.forward, -60);
    s.scene.width = s.scene.height = size;
    s.scene.transfer = transfer;
    s.scene.mode = t->mode;
    s.scene.shading = t->phong ? ANG_SHADING_PHONG : ANG_SHADING_NONE;
    static timing plain, with;
    double worst = 0, unused;
    size_t values = 4 * (size_t)size * (size_t)size;
    float *first = malloc(values * sizeof *first);
    if (!transfer || !first || !ang_image_create(&s.image, size, size, &err)) stop("scene", &err);
    unsigned forced = 1u << t->part;
    draw(&s, 0, &unused, &unused);
    memcpy(first, s.image.rgba, values * sizeof *first);
    draw(&s, forced, &unused, &unused);
    for (size_t i = 0; i < values; i++) worst = fmax(worst, 255 * fabs((double)first[i] - (double)s.image.rgba[i]));
    bool found = is_forced(&s, forced);
    for (int i = 0; i < pairs; i++) {
        draw(&s, 0, &plain.wall[i], &plain.processor[i]);
        draw(&s, forced, &with.wall[i], &with.processor[i]);
    }
    double without = ang_median(plain.wall, (size_t)pairs), used = ang_median(with.wall, (size_t)pairs);
    double ratio = ang_median(with.processor, (size_t)pairs) / ang_median(plain.processor, (size_t)pairs);
    printf("| %s | %s, %s | %.1f | %.1f | %.2f | %.2f | %.2g |%s\n", ang_part_name(t->part), t->method->name, t->scene,
           without, used, used / without, ratio, worst, found ? "" : " never left out");
    fflush(stdout);
    t->method->destroy(s.renderer);
    ang_kept_clear(&s.kept);
    ang_image_clear(&s.image);
    ang_transfer_free(transfer);
    free(first);
}

/* The reference with a context that it does not need. */
static void measure_context(int pairs) {
    static double wall[MOST_PAIRS];
    ang_error err = {0};
    for (int i = 0; i < pairs; i++) {
        double start = ang_now_ms();
        ang_gl *gl = ang_gl_create(ANG_BACKEND_AUTO, &err);
        if (!gl) stop("OpenGL", &err);
        wall[i] = ang_now_ms() - start;
        ang_gl_destroy(gl);
    }
    printf("| gl | reference, any scene | 0 | %.1f | | | 0 |\n", ang_median(wall, (size_t)pairs));
}

int main(int argc, char **argv) {
    int pairs = argc > 1 ? atoi(argv[1]) : 9, size = argc > 2 ? atoi(argv[2]) : 256;
    int side = argc > 3 ? atoi(argv[3]) : 256, only = argc > 4 ? ang_part_from_name(argv[4]) : -1;
    if (pairs < 1 || side < 16 || pairs > MOST_PAIRS || size < 16) return 2;
    ang_error err = {0};
    ang_phantom_params params = ang_phantom_params_default;
    params.dims[0] = params.dims[1] = side;
    params.dims[2] = side * 3 / 8;
    ang_volume *volume = ang_phantom_make(&params, 0, NULL, NULL, &err);
    if (!volume) stop("phantom", &err);
    printf("| part | picture | left out, ms | used, ms | ratio | of processor time | difference, levels |\n");
    printf("|---|---|---|---|---|---|---|\n");
    measure_context(pairs);
    ang_gl *gl = ang_gl_create(ANG_BACKEND_AUTO, &err);
    if (!gl) stop("OpenGL", &err);
    for (size_t i = 0; i < sizeof trials / sizeof *trials; i++)
        if (only < 0 || (int)trials[i].part == only) measure(gl, volume, &trials[i], pairs, size);
    ang_gl_destroy(gl);
    ang_volume_free(volume);
    return 0;
}
