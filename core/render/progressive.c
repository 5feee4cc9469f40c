#include "core/render/progressive.h"

#include <string.h>

int ang_progressive_stride(int level) { return 1 << (ANG_PROGRESSIVE_LEVELS - level); }

bool ang_progressive_start(ang_progressive *picture, const ang_method *method, const ang_scene *scene, int first,
                           ang_error *err) {
    if (picture->image.width != scene->width || picture->image.height != scene->height) {
        ang_image_clear(&picture->image);
        if (!ang_image_create(&picture->image, scene->width, scene->height, err)) return false;
    }
    picture->level = picture->parts = 0;
    picture->first = method->splits ? first : ANG_PROGRESSIVE_LEVELS;
    return true;
}

void ang_progressive_clear(ang_progressive *picture) {
    ang_image_clear(&picture->image);
    ang_image_clear(&picture->part);
    *picture = (ang_progressive){0};
}

/* Which pixels a part of a level draws: a grid between those of the levels before. */
typedef struct grid {
    int stride, first_x, first_y;
} grid;

static int next_level(const ang_progressive *picture) { return picture->level ? picture->level + 1 : picture->first; }

static int parts_of(const ang_progressive *picture) { return picture->level ? 3 : 1; }

static grid next_grid(const ang_progressive *picture) {
    int stride = ang_progressive_stride(next_level(picture));
    if (!picture->level) return (grid){stride, 0, 0};
    return (grid){2 * stride, picture->parts == 1 ? 0 : stride, picture->parts == 0 ? 0 : stride};
}

static float *pixel(const ang_image *image, int x, int y) {
    return image->rgba + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static void put_part(const ang_image *part, const grid *at, ang_image *image) {
    for (int j = 0; j < part->height; j++) {
        float *to = pixel(image, at->first_x, at->first_y + j * at->stride);
        const float *from = pixel(part, 0, j);
        for (int i = 0; i < part->width; i++, from += 4, to += 4 * at->stride) memcpy(to, from, 4 * sizeof *to);
    }
}

static bool draw_part(ang_progressive *picture, const grid *at, const ang_method *method, ang_renderer *renderer,
                      const ang_scene *scene, const ang_render_options *options, const ang_progress *progress,
                      ang_error *err) {
    if (at->stride == 1) return method->render(renderer, scene, options, &picture->image, NULL, progress, err);
    ang_scene subset = ang_scene_subset(scene, at->stride, at->first_x, at->first_y);
    if (subset.width < 1 || subset.height < 1) return true;
    ang_image *part = &picture->part;
    if (part->width != subset.width || part->height != subset.height) {
        ang_image_clear(part);
        if (!ang_image_create(part, subset.width, subset.height, err)) return false;
    }
    if (!method->render(renderer, &subset, options, part, NULL, progress, err)) return false;
    put_part(part, at, &picture->image);
    return true;
}

/* What lies between columns that are there; beyond the last, that. */
static void fill_row(ang_image *image, int y, int stride) {
    for (int x = 0; x < image->width; x += stride) {
        const float *left = pixel(image, x, y);
        const float *right = x + stride < image->width ? left + 4 * stride : left;
        float *between = pixel(image, x, y);
        for (int i = 1; i < stride && x + i < image->width; i++) {
            float weight = (float)i / (float)stride;
            for (int c = 0; c < 4; c++) between[4 * i + c] = left[c] + weight * (right[c] - left[c]);
        }
    }
}

static void fill(ang_image *image, int stride) {
    for (int y = 0; y < image->height; y += stride) fill_row(image, y, stride);
    for (int y = 0; y < image->height; y++) {
        int after = y % stride;
        if (after == 0) continue;
        const float *above = pixel(image, 0, y - after);
        const float *below = y - after + stride < image->height ? pixel(image, 0, y - after + stride) : above;
        float *row = pixel(image, 0, y), weight = (float)after / (float)stride;
        for (int i = 0; i < 4 * image->width; i++) row[i] = above[i] + weight * (below[i] - above[i]);
    }
}

bool ang_progressive_step(ang_progressive *picture, const ang_method *method, ang_renderer *renderer,
                          const ang_scene *scene, const ang_render_options *options, const ang_progress *progress,
                          ang_error *err) {
    if (picture->level == ANG_PROGRESSIVE_LEVELS) return true;
    for (; picture->parts < parts_of(picture); picture->parts++) {
        grid at = next_grid(picture);
        if (!draw_part(picture, &at, method, renderer, scene, options, progress, err)) return false;
    }
    picture->level = next_level(picture);
    picture->parts = 0;
    fill(&picture->image, ang_progressive_stride(picture->level));
    return true;
}
