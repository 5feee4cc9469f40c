#include "core/scene/image.h"

#include <math.h>
#include <stdlib.h>

bool ang_image_create(ang_image *image, int width, int height, ang_error *err) {
    *image = (ang_image){width, height, NULL};
    if (width < 1 || height < 1)
        return ang_fail(err, ANG_USAGE, "a picture of %d x %d pixels does not exist", width, height);
    image->rgba = calloc((size_t)width * (size_t)height, 4 * sizeof(float));
    return image->rgba ||
           ang_fail(err, ANG_LIMIT, "no memory for a picture of %d x %d pixels; give a smaller --size", width, height);
}

void ang_image_clear(ang_image *image) {
    free(image->rgba);
    *image = (ang_image){0};
}

/* Not fmin and fmax, which are calls: 0 for what is not a number, as they give. */
static float clip(double value) { return value >= 1 ? 1 : value > 0 ? (float)value : 0; }

/* The two pixels between which `at` lies, and the weight of the second. */
static float between(int at, int first, int stride, int size, int *before, int *after) {
    float place = (float)(at - first) / (float)stride, last = (float)(size - 1);
    place = place < 0 ? 0 : place > last ? last : place;
    *before = (int)place;
    *after = *before + 1 < size ? *before + 1 : *before;
    return place - (float)*before;
}

void ang_image_enlarge(const ang_image *drawn, int stride, int first, ang_image *image) {
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            int left, right, above, below;
            float u = between(x, first, stride, drawn->width, &left, &right);
            float v = between(y, first, stride, drawn->height, &above, &below);
            const float *upper = drawn->rgba + 4 * (size_t)drawn->width * (size_t)above;
            const float *lower = drawn->rgba + 4 * (size_t)drawn->width * (size_t)below;
            float *out = image->rgba + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
            for (int c = 0; c < 4; c++) {
                float a = (1 - u) * upper[4 * left + c] + u * upper[4 * right + c];
                float b = (1 - u) * lower[4 * left + c] + u * lower[4 * right + c];
                out[c] = (1 - v) * a + v * b;
            }
        }
}

void ang_image_over(const ang_image *image, const double background[4], float *out) {
    size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; i++) {
        const float *in = image->rgba + 4 * i;
        double through = 1 - (double)clip((double)in[3]);
        double alpha = (double)clip((double)in[3]) + through * background[3];
        for (int c = 0; c < 3; c++) {
            double premultiplied = (double)clip((double)in[c]) + through * background[3] * background[c];
            out[4 * i + (size_t)c] = alpha > 0 ? clip(premultiplied / alpha) : 0;
        }
        out[4 * i + 3] = clip(alpha);
    }
}
