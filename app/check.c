/* angioscope check: how far two pictures differ. */
#include "app/verbs.h"
#include "core/error/metrics.h"
#include "io/image/image_io.h"
#include "io/json.h"
#include "io/replace.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Pictures of 8 bits are compared as what they are; float ones (.exr, .pfm) to their full precision. */
static bool is_float(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot && (strcasecmp(dot, ".exr") == 0 || strcasecmp(dot, ".pfm") == 0);
}

static void print_json(const ang_metrics *metrics) {
    cJSON *root = cJSON_CreateObject();
    ang_json_add_number(root, "max", metrics->max);
    ang_json_add_number(root, "rms", metrics->rms);
    ang_json_add_number(root, "p999", metrics->p999);
    ang_json_add_number(root, "flipped", metrics->flipped);
    ang_json_add_number(root, "psnr", metrics->psnr);
    ang_json_add_number(root, "ssim", metrics->ssim);
    char *text = cJSON_PrintUnformatted(root);
    puts(text ? text : "null");
    free(text);
    cJSON_Delete(root);
}

static void print_text(const ang_metrics *metrics) {
    printf("max    %.4g levels of 255, of the channel that differs most\n", metrics->max);
    printf("rms    %.4g levels of 255, over pixels, of the channel that differs most\n", metrics->rms);
    printf("p99.9  %.4g levels of 255, of the channel that differs most\n", metrics->p999);
    if (isfinite(metrics->psnr))
        printf("psnr   %.2f dB, over pixels and all four channels\n", metrics->psnr);
    else
        printf("psnr   infinite (the pictures are equal)\n");
    if (isfinite(metrics->ssim))
        printf("ssim   %.6f\n", metrics->ssim);
    else
        printf("ssim   not available\n");
}

static bool compare(const ang_options *options, ang_image *a, ang_image *b, ang_error *err) {
    static const double opaque_black[4] = {0, 0, 0, 1};
    for (int i = 0; i < 2 && options->heat; i++)
        if (ang_file_same(options->arguments[i], options->heat))
            return ang_fail(err, ANG_USAGE, "--heat %s: is one of the pictures to compare; give it another name",
                            options->heat);
    if (!ang_picture_read(options->arguments[0], a, err) || !ang_picture_read(options->arguments[1], b, err))
        return false;
    bool quantised = !is_float(options->arguments[0]) || !is_float(options->arguments[1]);
    ang_metrics metrics;
    if (!ang_metrics_compute(a, b, quantised, &metrics, err)) return false;
    if (options->heat) {
        ang_image heat = {0};
        bool done = ang_metrics_heat(a, b, quantised, &heat, NULL, err) &&
                    ang_image_write(options->heat, &heat, opaque_black, err);
        ang_image_clear(&heat);
        if (!done) return false;
    }
    if (options->json_flag)
        print_json(&metrics);
    else
        print_text(&metrics);
    if (metrics.max > options->threshold)
        return ang_fail(err, ANG_CHECK_FAILED, "%s and %s differ by %.4g levels; the threshold is %g",
                        options->arguments[0], options->arguments[1], metrics.max, options->threshold);
    return true;
}

int ang_app_check(const ang_options *options, ang_error *err) {
    if (!ang_app_arguments(options, 2, "check: give two pictures to compare", err)) return ANG_USAGE;
    ang_image a = {0}, b = {0};
    bool equal = compare(options, &a, &b, err);
    ang_image_clear(&a);
    ang_image_clear(&b);
    return equal ? ANG_OK : (int)err->code;
}
