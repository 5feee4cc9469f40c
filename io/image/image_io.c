#include "io/image/image_io.h"

#include "core/base/memory.h"
#include "io/image/encode.h"
#include "io/image/picture_text.h"
#include "io/image/portable.h"
#include "io/replace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef enum format { PNG, TIFF, EXR, PPM, PFM, UNKNOWN } format;

static const struct {
    const char *extension;
    format format;
} extensions[] = {{".png", PNG}, {".tif", TIFF}, {".tiff", TIFF}, {".exr", EXR}, {".ppm", PPM}, {".pfm", PFM}};

static const char *oiio_name(format format) { return format == PNG ? "png" : format == TIFF ? "tiff" : "openexr"; }

static format format_of(const char *path) {
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash ? slash : path, '.');
    for (size_t i = 0; dot && i < sizeof extensions / sizeof *extensions; i++) {
        if (strcasecmp(dot, extensions[i].extension) == 0) return extensions[i].format;
    }
    return UNKNOWN;
}

/* Whether this build has what reads, or writes, a format. */
static bool known(format format, bool reads) {
#ifdef ANG_WITH_PNG
    if (format == PNG && !reads) return true;
#endif
#ifdef ANG_WITH_OIIO
    if (format == TIFF || format == EXR || (format == PNG && reads)) return true;
#endif
    (void)reads;
    return format >= PPM;
}

/* What is not written or, where `reads`, not read. */
static bool refuse(const char *path, format format, bool reads, ang_error *err) {
    if (format == UNKNOWN)
        return ang_fail(err, ANG_USAGE, "%s: not a picture's extension; use .png, .tif, .exr, .ppm or .pfm", path);
    bool png = format == PNG && !reads;
    return known(format, reads) ||
           ang_fail(err, ANG_USAGE, "%s: this build has no %s; use .ppm (8 bit) or .pfm (float)", path,
                    png ? "libpng (ANG_WITH_PNG)" : "OpenImageIO (ANG_WITH_OIIO)");
}

double ang_image_rounding(const char *path, const double background[4]) {
    format format = format_of(path);
    if (format == EXR || format == PFM) return 0;
    return format != PPM && background[3] < 1 ? 1 : 0.5;
}

bool ang_image_writable(const char *path, ang_error *err) {
    return refuse(path, format_of(path), false, err) && ang_file_replaceable(path, err);
}

/* Premultiplied over the background, not clipped. */
static bool flatten(const ang_image *image, const double background[4], int channels, float **out, ang_error *err) {
    size_t count = (size_t)image->width * (size_t)image->height;
    *out = ang_alloc(count * (size_t)channels, sizeof **out, "picture", err);
    if (!*out) return false;
    for (size_t i = 0; i < count; i++) {
        const float *from = image->rgba + 4 * i;
        float *to = *out + (size_t)channels * i;
        double behind = (1 - (double)from[3]) * background[3];
        for (int c = 0; c < 3; c++) to[c] = (float)(from[c] + behind * background[c]);
        if (channels == 4) to[3] = (float)(from[3] + behind);
    }
    return true;
}

/* A float times 255 is exact in double, and so is its half up. */
static unsigned char to_byte(double value) {
    return value >= 1 ? 255 : value > 0 ? (unsigned char)(255 * value + 0.5) : 0;
}

/* 8-bit unassociated RGBA, or RGB where all is opaque or `channels` says 3. */
static bool quantise(const ang_image *image, const double background[4], unsigned char **out, int *channels,
                     ang_error *err) {
    size_t count = (size_t)image->width * (size_t)image->height;
    float *rgba = ang_alloc(4 * count, sizeof *rgba, "picture", err);
    unsigned char *bytes = ang_alloc(4 * count, 1, "picture", err);
    *out = bytes;
    if (!rgba || !bytes) {
        free(rgba);
        free(bytes);
        return false;
    }
    ang_image_over(image, background, rgba);
    bool opaque = true;
    for (size_t i = 0; i < count && opaque; i++) opaque = to_byte(rgba[4 * i + 3]) == 255;
    *channels = opaque ? 3 : 4;
    for (size_t i = 0; i < count; i++) {
        for (int c = 0; c < *channels; c++) bytes[(size_t)*channels * i + (size_t)c] = to_byte(rgba[4 * i + (size_t)c]);
    }
    free(rgba);
    return true;
}

static bool encode_float(format format, const ang_image *image, const double background[4], const char *state,
                         ang_bytes *bytes, ang_error *err) {
    float *pixels = NULL;
    int channels = format == EXR ? 4 : 3;
    if (!flatten(image, background, channels, &pixels, err)) return false;
    bool good;
    if (format == PFM) {
        good = ang_pfm_encode(image->width, image->height, pixels, bytes, err);
    } else if (format == EXR) {
        ang_pixels floats = {image->width, image->height, channels, true, pixels, state};
        good = ang_oiio_encode(oiio_name(EXR), &floats, bytes, err);
    } else { /* .ppm has no alpha: the premultiplied colour is what a black screen behind it shows */
        good = ang_ppm_encode(image->width, image->height, pixels, bytes, err);
    }
    free(pixels);
    return good;
}

static bool encode_bytes(format format, const ang_image *image, const double background[4], const char *state,
                         ang_bytes *bytes, ang_error *err) {
    unsigned char *pixels = NULL;
    int channels = 0;
    if (!quantise(image, background, &pixels, &channels, err)) return false;
    ang_pixels quantised = {image->width, image->height, channels, false, pixels, state};
    bool good = format == PNG ? ang_png_encode(&quantised, bytes, err)
                              : ang_oiio_encode(oiio_name(format), &quantised, bytes, err);
    free(pixels);
    return good;
}

bool ang_image_write(const char *path, const ang_image *image, const double background[4], ang_error *err) {
    return ang_image_write_stated(path, image, background, NULL, err);
}

bool ang_image_write_stated(const char *path, const ang_image *image, const double background[4], const char *state,
                            ang_error *err) {
    format format = format_of(path);
    if (!refuse(path, format, false, err)) return false;
    ang_bytes bytes = {0};
    bool whole = format == PNG || format == TIFF ? encode_bytes(format, image, background, state, &bytes, err)
                                                 : encode_float(format, image, background, state, &bytes, err);
    if (whole) whole = ang_file_replace(path, bytes.data, bytes.size, err);
    free(bytes.data);
    return whole;
}

bool ang_image_png(const ang_image *image, const double background[4], const char *state, unsigned char **data,
                   size_t *size, ang_error *err) {
    ang_bytes bytes = {0};
    bool whole = refuse("a picture.png", PNG, false, err) && encode_bytes(PNG, image, background, state, &bytes, err);
    *data = bytes.data;
    *size = bytes.size;
    return whole;
}

bool ang_image_rgb(const ang_image *image, const double background[4], unsigned char **rgb, ang_error *err) {
    int channels;
    if (!quantise(image, background, rgb, &channels, err)) {
        *rgb = NULL;
        return false;
    }
    float *pixels = NULL;
    if (channels == 3) return true;
    bool done = flatten(image, background, 3, &pixels, err);
    size_t values = 3 * (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < values && done; i++) (*rgb)[i] = to_byte(pixels[i]);
    free(pixels);
    if (done) return true;
    free(*rgb);
    *rgb = NULL;
    return false;
}

bool ang_picture_read(const char *path, ang_image *out, ang_error *err) {
    *out = (ang_image){0};
    format format = format_of(path);
    if (!refuse(path, format, true, err)) return false;
    if (format == PPM || format == PFM) return ang_portable_read(path, out, err);
    return ang_oiio_read(path, oiio_name(format), out, err);
}

char *ang_image_state(const char *path, ang_error *err) {
    format format = format_of(path);
    if (format != PNG && format != EXR) {
        ang_fail(err, ANG_USAGE, "%s: carries no state; .png and .exr may", path);
        return NULL;
    }
    return format == PNG ? ang_png_text(path, ANG_IMAGE_STATE, err) : ang_exr_text(path, ANG_IMAGE_STATE, err);
}
