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

static float clip(double value) { return (float)fmin(fmax(value, 0), 1); }

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
