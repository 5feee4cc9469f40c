#include "io/load.h"

#include "core/transfer/transfer.h"
#include "io/dicom/dicom.h"
#include "io/dicom/directory.h"
#include "io/formats.h"
#include "io/replace.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

const char *ang_base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

void ang_load_report_clear(ang_load_report *report) {
    for (size_t i = 0; i < report->series_count; i++) {
        free(report->series[i].description);
        free(report->series[i].patient);
        free(report->series[i].uid);
        free(report->series[i].remark);
        for (int p = 0; report->series[i].phase_text && p < report->series[i].phases; p++)
            free(report->series[i].phase_text[p]);
        free(report->series[i].phase_text);
    }
    free(report->series);
    free(report->gaps);
    ang_notes_clear(&report->assumptions);
    ang_notes_clear(&report->warnings);
    *report = (ang_load_report){0};
}

const char *ang_series_phase_text(const ang_series_info *info, int phase) {
    bool known = info->phase_text && phase >= 1 && phase <= info->phases && info->phase_text[phase - 1];
    return known ? info->phase_text[phase - 1] : "";
}

bool ang_series_take_phase(const ang_series_info *info, const ang_load_options *options, int *phase, ang_error *err) {
    *phase = options->phase > 0 ? options->phase : 1;
    if (*phase <= info->phases || *phase == 1) return true;
    if (info->phases > 1)
        return ang_fail(err, ANG_INPUT, "--phase %d: series %d has phases 1 to %d", *phase, info->number, info->phases);
    return ang_fail(err, ANG_INPUT, "--phase %d: series %d is one volume, phase 1", *phase, info->number);
}

bool ang_load_report_hounsfield(const ang_load_report *report) {
    return report->series_count > 0 && strcmp(report->format, "DICOM") == 0 &&
           strcmp(report->series[report->chosen].modality, "CT") == 0;
}

/* Options for raw input are refused where the input is something else: ignored, they would mislead. */
static bool refuse_raw_options(const char *label, const char *what, const ang_load_options *options, ang_error *err) {
    const char *name = options->raw_dims      ? "--raw-dims"
                       : options->raw_type    ? "--raw-type"
                       : options->raw_spacing ? "--raw-spacing"
                                              : NULL;
    return !name || ang_fail(err, ANG_USAGE, "%s is for raw input, and %s is %s: leave it out", name, label, what);
}

/* Formats that hold one volume have series 1 alone. */
static bool refuse_other_series(const char *label, const ang_load_options *options, ang_error *err) {
    char *rest;
    if (!options->series || (strtol(options->series, &rest, 10) == 1 && !*rest)) return true;
    return ang_fail(err, ANG_INPUT, "--series %s: %s holds one volume, series 1", options->series, label);
}

/* What a file of a known format that is not read begins with; NULL where it is none of these. */
static const char *unread_format(const char *path) {
    static const struct {
        const char *start, *name;
    } formats[] = {{"ObjectType", "MetaImage"}, {"NDims", "MetaImage"}, {"NRRD0", "NRRD"}};
    char start[16] = "";
    FILE *file = fopen(path, "rb");
    if (!file) return NULL;
    size_t length = fread(start, 1, sizeof start, file);
    fclose(file);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        size_t needed = strlen(formats[i].start);
        if (length >= needed && memcmp(start, formats[i].start, needed) == 0) return formats[i].name;
    }
    return NULL;
}

#ifdef ANG_WITH_NIFTI
#define READ_FORMATS "DICOM, NIfTI-1 and raw volumes"
#else
#define READ_FORMATS "DICOM and raw volumes"
#endif

static ang_volume *load_raw(const char *path, const ang_load_options *options, ang_load_report *report,
                            const ang_progress *progress, ang_error *err) {
    if (!refuse_other_series(ang_base_name(path), options, err)) return NULL;
    return ang_raw_load(path, options, report, progress, err);
}

static ang_volume *dispatch(const char *path, const ang_load_options *options, ang_load_report *report,
                            const ang_progress *progress, ang_error *err) {
    struct stat status;
    const char *label = ang_base_name(path);
    if (stat(path, &status) != 0) {
        ang_fail(err, ANG_INPUT, "%s: %s", path, strerror(errno));
        return NULL;
    }
    bool folder = S_ISDIR(status.st_mode);
    if (!folder && !S_ISREG(status.st_mode)) {
        ang_fail(err, ANG_INPUT, "%s: is neither a file nor a folder", path);
        return NULL;
    }
    if (!folder && options->raw_dims) return load_raw(path, options, report, progress, err);
    bool dicom = folder || ang_dicom_probe(path);
    if (!dicom && status.st_size == 0) {
        ang_fail(err, ANG_INPUT, "%s: is empty", label);
        return NULL;
    }
    if (dicom) {
        if (!refuse_raw_options(label, folder ? "a folder" : "DICOM", options, err)) return NULL;
        return ang_dicom_load(&path, 1, options, report, progress, err);
    }
    if (ang_nifti_probe(path)) {
        if (!refuse_raw_options(label, "NIfTI-1", options, err) || !refuse_other_series(label, options, err))
            return NULL;
        return ang_nifti_load(path, options, report, progress, err);
    }
    if (ang_raw_probe(path, options)) return load_raw(path, options, report, progress, err);
    const char *unread = unread_format(path);
    if (unread)
        ang_fail(err, ANG_INPUT, "%s: is %s, which is not read yet; " READ_FORMATS " are", label, unread);
    else
        ang_fail(err, ANG_INPUT,
                 "%s: is neither DICOM nor NIfTI-1; a raw volume needs --raw-dims and --raw-type or a sidecar %s.json",
                 label, label);
    return NULL;
}

/* Numbers that are finite and yet none of a scan: everything after this may count on sensible ones. */
static bool check_numbers(const ang_volume *volume, const char *label, ang_error *err) {
    static const double least_slope = 1e-30, least_spacing = 1e-6, most_spacing = 1e6; /* floats hold their powers */
    double low = ang_volume_hu(volume, volume->minimum), high = ang_volume_hu(volume, volume->maximum);
    if (!(low >= -ANG_TRANSFER_HU_LIMIT && high <= ANG_TRANSFER_HU_LIMIT))
        return ang_fail(err, ANG_INPUT, "%s: its values, %g to %g, are beyond %g; is the rescale right?", label, low,
                        high, ANG_TRANSFER_HU_LIMIT);
    if (!(volume->slope >= least_slope))
        return ang_fail(err, ANG_INPUT, "%s: its values differ by %g only; is the rescale right?", label,
                        volume->slope);
    ang_mat4 inverse;
    bool sound = ang_mat4_inverse(&volume->affine, &inverse);
    for (int axis = 0; axis < 3; axis++) {
        double spacing = ang_volume_spacing(volume, axis);
        sound = sound && spacing >= least_spacing && spacing <= most_spacing && isfinite(volume->affine.m[axis][3]);
    }
    return sound ||
           ang_fail(err, ANG_GEOMETRY,
                    "%s: voxels of %g x %g x %g mm, or where they lie, make no volume; is the spacing right?", label,
                    ang_volume_spacing(volume, 0), ang_volume_spacing(volume, 1), ang_volume_spacing(volume, 2));
}

/* Whether `path` lies in `folder` or below it. */
static bool lies_in(const char *folder, const char *path) {
    char *outer = realpath(folder, NULL), *inner = outer ? realpath(path, NULL) : NULL;
    size_t length = outer ? strlen(outer) : 0;
    bool inside = inner && strncmp(inner, outer, length) == 0 && inner[length] == '/';
    free(outer);
    free(inner);
    return inside;
}

bool ang_load_reads(const char *input, const char *path) {
    struct stat status;
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode)) return false;
    if (ang_file_same(input, path)) return true;
    bool folder = stat(input, &status) == 0 && S_ISDIR(status.st_mode);
    if (folder) return lies_in(input, path) && ang_dicom_probe(path);
    if (ang_dicom_is_directory(input)) {
        char *around = ang_dicom_folder_of(input);
        bool read = around && lies_in(around, path) && ang_dicom_probe(path);
        free(around);
        return read;
    }
    char *sidecar = ang_raw_sidecar(input);
    bool same = sidecar && ang_file_same(sidecar, path);
    free(sidecar);
    return same;
}

bool ang_is_dicom(const char *path) {
    struct stat status;
    bool there = stat(path, &status) == 0;
    return there && (S_ISDIR(status.st_mode) || (S_ISREG(status.st_mode) && ang_dicom_probe(path)));
}

/* Several paths: DICOM, or the first that is something else and can be told. */
static ang_volume *dispatch_all(const char *const *paths, size_t count, const ang_load_options *options,
                                ang_load_report *report, const ang_progress *progress, ang_error *err) {
    bool dicom = false;
    size_t other = count;
    for (size_t i = 0; i < count && !dicom; i++) {
        dicom = ang_is_dicom(paths[i]);
        if (other == count && (ang_nifti_probe(paths[i]) || ang_raw_probe(paths[i], options))) other = i;
    }
    if (dicom && refuse_raw_options(ang_base_name(paths[0]), "DICOM", options, err))
        return ang_dicom_load(paths, count, options, report, progress, err);
    if (dicom) return NULL;
    ang_volume *volume = dispatch(paths[other < count ? other : 0], options, report, progress, err);
    if (volume) ang_notes_add(&report->assumptions, "of %zu files, which are no DICOM, one is shown", count);
    return volume;
}

void ang_load_report_start(ang_load_report *report) {
    *report = (ang_load_report){.tilt_nominal_deg = NAN,
                                .window_centre = NAN,
                                .window_width = NAN,
                                .slope = NAN,
                                .intercept = NAN,
                                .padding_found_hu = NAN};
}

ang_volume *ang_load_all(const char *const *paths, size_t count, const ang_load_options *options,
                         ang_load_report *report, const ang_progress *progress, ang_error *err) {
    static const ang_load_options defaults = {0};
    ang_error own;
    if (!err) err = &own;
    if (!options) options = &defaults;
    *err = (ang_error){0};
    ang_load_report_start(report);
    ang_volume *volume = count == 1 ? dispatch(paths[0], options, report, progress, err)
                                    : dispatch_all(paths, count, options, report, progress, err);
    if (!volume) return NULL;
    *err = (ang_error){0};
    if (!ang_series_take_phase(&report->series[report->chosen], options, &report->phase, err) ||
        !check_numbers(volume, ang_base_name(paths[0]), err)) {
        ang_volume_free(volume);
        return NULL;
    }
    if (options->strict && report->warnings.count > 0) {
        char line[ANG_NOTES_LINE];
        ang_fail(err, ANG_GEOMETRY, "--strict: %s", ang_notes_line(&report->warnings, 0, true, line, sizeof line));
        ang_volume_free(volume);
        return NULL;
    }
    return volume;
}

ang_volume *ang_load(const char *path, const ang_load_options *options, ang_load_report *report,
                     const ang_progress *progress, ang_error *err) {
    return ang_load_all(&path, 1, options, report, progress, err);
}
