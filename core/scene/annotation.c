#include "core/scene/annotation.h"

#include "core/scene/objects.h"

#include <stdio.h>
#include <string.h>

static const double further_letter = 0.38; /* tan(20.8 degrees) */
static const double bar_share = 0.2;       /* of the picture's width */

ang_letters ang_letters_make(ang_vec3 direction) {
    static const char negative[3] = {'R', 'A', 'F'}, positive[3] = {'L', 'P', 'H'};
    ang_letters letters = {{0}};
    double size[3];
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 3; i++) {
        size[i] = fabs(ang_vec3_at(direction, i));
        if (!isfinite(size[i])) return letters;
    }
    for (int i = 0; i < 2; i++) {
        for (int j = 2; j > i; j--) {
            if (size[order[j]] > size[order[j - 1]]) {
                int swapped = order[j];
                order[j] = order[j - 1];
                order[j - 1] = swapped;
            }
        }
    }
    double largest = size[order[0]];
    for (int i = 0; i < 3 && largest > 0; i++) {
        if (i > 0 && size[order[i]] <= further_letter * largest) break;
        letters.text[i] = ang_vec3_at(direction, order[i]) < 0 ? negative[order[i]] : positive[order[i]];
    }
    return letters;
}

double ang_round_length(double limit) {
    if (!(limit > 0) || !isfinite(limit)) return 0;
    double power = pow(10, floor(log10(limit)));
    /* log10 may land beside a whole number: start one decade up. */
    static const double steps[] = {10, 5, 2, 1, 0.5};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        if (steps[i] * power <= limit * (1 + 1e-12)) return steps[i] * power;
    }
    return 0;
}

static double scale_at_centre(const ang_scene *scene) {
    const ang_camera *camera = &scene->camera;
    double height_mm = camera->projection == ANG_PERSPECTIVE
                           ? 2 * camera->focus_mm * tan(camera->fov_deg * (M_PI / 360))
                           : 2 * camera->half_height;
    const ang_sampling *sampling = &scene->sampling;
    double scale = sampling->stride > 0 ? height_mm / sampling->height * sampling->stride : height_mm / scene->height;
    return scale > 0 && isfinite(scale) ? scale : NAN; /* a centre behind the eye has no scale */
}

bool ang_annotation_place(const ang_scene *scene, ang_vec3 at, double *x, double *y, double *depth_mm) {
    const ang_camera *camera = &scene->camera;
    ang_vec3 from = ang_vec3_sub(at, camera->eye);
    double depth = ang_vec3_dot(from, camera->forward), half = camera->half_height;
    if (camera->projection == ANG_PERSPECTIVE) half = depth * tan(camera->fov_deg * (M_PI / 360));
    double pixel = 2 * half / scene->height;
    if (!(depth > camera->near_mm) || !(pixel > 0)) return false;
    *x = 0.5 * scene->width + ang_vec3_dot(from, camera->right) / pixel;
    *y = 0.5 * scene->height - ang_vec3_dot(from, camera->up) / pixel;
    *depth_mm = depth;
    return true;
}

static bool is_light(const ang_scene *scene) {
    const double *b = scene->background;
    return b[3] * (0.299 * b[0] + 0.587 * b[1] + 0.114 * b[2]) > 0.5;
}

/* Letters are a fortieth of the picture's height, at least 11 pixels. */
static double letter_height(const ang_scene *scene) { return fmax(scene->height / 40.0, 11); }

/* The label before number `last` that it would be written over; -1: none. */
static int hidden_by(const ang_annotation *a, int last, double letter) {
    const ang_annotation_label *label = &a->label[last];
    for (int i = 0; i < last; i++) {
        const ang_annotation_label *other = &a->label[i];
        double room = 0.35 * letter * (double)(strlen(label->text) + strlen(other->text));
        if (fabs(label->x - other->x) < room && fabs(label->y - other->y) < letter) return i;
    }
    return -1;
}

ang_annotation ang_annotation_of_objects(const ang_scene *scene) {
    ang_annotation a = {.dark_ink = is_light(scene)};
    const ang_objects *objects = scene->objects;
    double depth[ANG_ANNOTATION_LABELS], letter = letter_height(scene);
    bool is_length[ANG_ANNOTATION_LABELS];
    for (size_t i = 0; objects && i < objects->label_count && a.labels < ANG_ANNOTATION_LABELS; i++) {
        ang_annotation_label *label = &a.label[a.labels];
        bool below = objects->label[i].below;
        if (!ang_annotation_place(scene, objects->label[i].at, &label->x, &label->y, &depth[a.labels])) continue;
        if (below) label->y += 1.6 * letter;
        snprintf(label->text, sizeof label->text, "%s", objects->label[i].text);
        int other = hidden_by(&a, a.labels, letter);
        /* Lengths make room for one another. Of an axis that points at the eye only the near end has its letter. */
        for (int line = 0; line < ANG_ANNOTATION_LABELS && below && other >= 0; line++) {
            label->y = a.label[other].y + 1.2 * letter;
            other = hidden_by(&a, a.labels, letter);
        }
        if (other >= 0 && !below && (is_length[other] || depth[a.labels] >= depth[other])) continue;
        if (other >= 0 && !below) {
            a.label[other] = *label;
            depth[other] = depth[a.labels];
            continue;
        }
        is_length[a.labels] = below;
        a.labels++;
    }
    return a;
}

ang_annotation ang_annotation_make(const ang_scene *scene, const char *preset_name) {
    const ang_camera *camera = &scene->camera;
    ang_annotation a = ang_annotation_of_objects(scene);
    a.left = ang_letters_make(ang_vec3_scale(camera->right, -1));
    a.right = ang_letters_make(camera->right);
    a.top = ang_letters_make(camera->up);
    a.bottom = ang_letters_make(ang_vec3_scale(camera->up, -1));
    a.mm_per_pixel = scale_at_centre(scene);
    if (a.mm_per_pixel > 0) {
        a.bar_mm = ang_round_length(bar_share * scene->width * a.mm_per_pixel);
        a.bar_pixels = a.bar_mm / a.mm_per_pixel;
        snprintf(a.bar_label, sizeof a.bar_label, "%.6g mm%s", a.bar_mm,
                 camera->projection == ANG_PERSPECTIVE ? " at the centre" : "");
    }
    const char *mode = ang_mode_name(scene->mode);
    bool named = preset_name && *preset_name;
    snprintf(a.caption, sizeof a.caption, "%.100s%s%s", named ? preset_name : "", named && mode ? ", " : "",
             mode ? mode : "");
    return a;
}

/* Upwards: rather too much than too little. */
static double two_figures(double value) {
    if (!(value > 0)) return value;
    double power = pow(10, floor(log10(value)) - 1);
    return ceil(value / power * (1 - 1e-12)) * power;
}

void ang_annotation_add_error(ang_annotation *annotation, double levels, double rms, double milliseconds) {
    char error[48] = "error not known";
    if (isfinite(levels))
        snprintf(error, sizeof error, "error about %.3g levels", fmin(two_figures(levels), 255));
    else if (isfinite(rms))
        snprintf(error, sizeof error, "RMS error %.2g levels", two_figures(rms));
    snprintf(annotation->remark, sizeof annotation->remark, "%s, %.0f ms", error, milliseconds);
}
