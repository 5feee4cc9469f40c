/* Pictures and heat maps as data within a page. */
#include "app/report/report.h"

#include "core/base/memory.h"
#include "io/image/image_io.h"

#include <math.h>
#include <stdlib.h>

const double ang_report_heat_least = 0.01, ang_report_heat_most = 100;

static const double opaque_black[4] = {0, 0, 0, 1};

/* RFC 4648, section 4. */
static void put_base64(FILE *out, const unsigned char *data, size_t size) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        unsigned bits = (unsigned)data[i] << 16;
        if (left > 1) bits |= (unsigned)data[i + 1] << 8;
        if (left > 2) bits |= data[i + 2];
        fputc(digits[bits >> 18], out);
        fputc(digits[bits >> 12 & 63], out);
        fputc(left > 1 ? digits[bits >> 6 & 63] : '=', out);
        fputc(left > 2 ? digits[bits & 63] : '=', out);
    }
}

/* The mean of blocks of factor x factor pixels, those cut off at the right and lower edge left out. */
static bool shrink(const ang_image *image, int factor, ang_image *out) {
    if (!ang_image_create(out, image->width / factor, image->height / factor, NULL)) return false;
    double weight = 1.0 / ((double)factor * factor);
    for (int y = 0; y < out->height * factor; y++)
        for (int x = 0; x < out->width * factor; x++)
            for (size_t c = 0; c < 4; c++) {
                size_t to = (size_t)(y / factor) * (size_t)out->width + (size_t)(x / factor);
                size_t from = (size_t)y * (size_t)image->width + (size_t)x;
                out->rgba[4 * to + c] += (float)(weight * (double)image->rgba[4 * from + c]);
            }
    return true;
}

static bool put(FILE *out, const ang_image *image, const double background[4], const char *alt, const char *class) {
    unsigned char *data = NULL;
    size_t size = 0;
    if (!ang_image_png(image, background, NULL, &data, &size, NULL)) return false;
    fprintf(out, "<img class=\"%s\" alt=\"%s\" width=\"%d\" height=\"%d\" src=\"data:image/png;base64,", class, alt,
            image->width, image->height);
    put_base64(out, data, size);
    fputs("\">", out);
    free(data);
    return true;
}

bool ang_report_put_picture(FILE *out, const ang_image *image, const double background[4], const char *alt,
                            const char *class) {
    int side = image->width > image->height ? image->width : image->height;
    int factor = (side + ANG_REPORT_PICTURE_SIDE - 1) / ANG_REPORT_PICTURE_SIDE;
    ang_image small = {0};
    if (factor < 2 || !shrink(image, factor, &small)) return put(out, image, background, alt, class);
    bool done = put(out, &small, background, alt, class);
    ang_image_clear(&small);
    return done;
}

/* 0 at the scale's least, 1 at its greatest; below 0 is black. */
static float heat_of(double levels) {
    double decades = log10(ang_report_heat_most / ang_report_heat_least);
    if (!(levels > ang_report_heat_least)) return 0;
    return (float)fmin(log10(levels / ang_report_heat_least) / decades, 1);
}

bool ang_report_put_heat(FILE *out, const ang_image *image, const ang_image *truth, const char *alt) {
    size_t count = (size_t)image->width * (size_t)image->height;
    float *values = ang_alloc(count, sizeof *values, "heat map", NULL);
    ang_image heat = {0};
    bool good = values && ang_metrics_map(image, truth, values, NULL);
    for (size_t i = 0; good && i < count; i++) values[i] = heat_of(values[i]);
    good = good && ang_heat_image(values, 1, image->width, image->height, &heat, NULL) &&
           ang_report_put_picture(out, &heat, opaque_black, alt, "heat");
    ang_image_clear(&heat);
    free(values);
    return good;
}

bool ang_report_put_heat_scale(FILE *out) {
    enum { LENGTH = 256 };
    float values[LENGTH];
    for (int i = 0; i < LENGTH; i++) values[i] = (float)i / (LENGTH - 1);
    ang_image bar = {0};
    bool good = ang_heat_image(values, 1, LENGTH, 1, &bar, NULL) && put(out, &bar, opaque_black, "scale", "bar");
    ang_image_clear(&bar);
    return good;
}

void ang_report_can_picture(ang_report *report, bool *pictures, bool *heat) {
    float value = 0, rgba[4] = {0, 0, 0, 1};
    ang_image pixel = {1, 1, rgba}, map = {0};
    unsigned char *data = NULL;
    size_t size = 0;
    ang_error err = {0};
    *pictures = ang_image_png(&pixel, opaque_black, NULL, &data, &size, &err);
    free(data);
    if (!*pictures) ang_notes_add(&report->notes, "there are no pictures: %s", err.message);
    *heat = *pictures && ang_heat_image(&value, 1, 1, 1, &map, &err);
    ang_image_clear(&map);
    if (*pictures && !*heat) ang_notes_add(&report->notes, "there are no heat maps: %s", err.message);
}
