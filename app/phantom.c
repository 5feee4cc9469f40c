/* angioscope phantom: a synthetic head CT angiogram as a DICOM series, with its truth beside it. */
#include "core/volume/phantom.h"
#include "app/verbs.h"
#include "io/phantom.h"

#include <stdlib.h>

static bool read_params(const ang_options *options, ang_phantom_params *params, ang_error *err) {
    *params = ang_phantom_params_default;
    int count;
    /* Rows and columns of a DICOM image are counted in 16 bits. */
    if (!ang_app_parse_dims("dims", options->dims, 3, 65535, params->dims, err)) return false;
    if (options->spacing && !ang_app_parse_numbers("spacing", options->spacing, 3, 3, params->spacing_mm, &count, err))
        return false;
    /* To the phantom 0 means the default. */
    for (int i = 0; options->spacing && i < 3; i++)
        if (!(params->spacing_mm[i] > 0))
            return ang_fail(err, ANG_USAGE, "--spacing %s: each must be more than 0 mm", options->spacing);
    params->seed = (uint64_t)options->seed;
    params->noise_hu = options->noise;
    return true;
}

int ang_app_phantom(const ang_options *options, ang_error *err) {
    if (options->argument_count != 0 || !options->output) {
        ang_fail(err, ANG_USAGE, "phantom: give a folder to write with -o DIR, and no other argument");
        return ANG_USAGE;
    }
    ang_phantom_params params;
    if (!read_params(options, &params, err)) return (int)err->code;
    ang_app_progress *progress = ang_app_progress_start(options->quiet);
    bool done = ang_phantom_write(options->output, &params, options->threads, ang_app_progress_sink(progress), err);
    ang_app_progress_end(progress);
    if (!done) return (int)err->code;
    if (!options->quiet)
        fprintf(stderr, "%d slice%s and truth.json are in %s\n", params.dims[2], ang_plural(params.dims[2]),
                options->output);
    return ANG_OK;
}
