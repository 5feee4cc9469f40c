#include "io/load.h"

#include "core/transfer/transfer.h"
#include "io/archive/archive.h"
#include "io/dicom/dicom.h"
#include "io/dicom/directory.h"
#include "io/dicom/identity.h"
#include "io/formats.h"
#include "io/replace.h"
#include "io/volumes.h"
#include "io/voxels/stack.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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
    ang_identity_free(report->identity);
    ang_notes_clear(&report->assumptions);
    ang_notes_clear(&report->warnings);
    *report = (ang_load_report){0};
}

const char *ang_series_phase_text(const ang_series_info *info, int phase) {
    bool known = info->phase_text && phase >= 1 && phase <= info->phases && info->phase_text[phase - 1];
    return known ? info->phase_text[phase - 1] : "";
}

bool ang_load_phase(const char *what, int phases, const ang_load_options *options, int *phase, ang_error *err) {
    *phase = options->phase > 0 ? options->phase : 1;
    if (*phase > phases && options->phase_remembered) *phase = 1;
    if (*phase <= phases || *phase == 1) return true;
    if (phases > 1) return ang_fail(err, ANG_INPUT, "--phase %d: %s has phases 1 to %d", *phase, what, phases);
    return ang_fail(err, ANG_INPUT, "--phase %d: %s is one volume, phase 1", *phase, what);
}

/* The phase of the series that was chosen; DICOM's reader has told of it. */
static bool note_phase(const ang_load_options *options, ang_load_report *report, ang_error *err) {
    char what[32];
    const ang_series_info *info = &report->series[report->chosen];
    snprintf(what, sizeof what, "series %d", info->number);
    if (!ang_load_phase(what, info->phases, options, &report->phase, err)) return false;
    const char *text = ang_series_phase_text(info, report->phase);
    if (info->phases > 1 && strcmp(report->format, "DICOM") != 0)
        ang_notes_add(&report->assumptions, "phase %d of %d is shown%s%s; %s picks another", report->phase,
                      info->phases, text[0] ? ", " : "", text,
                      options->phase_choice ? options->phase_choice : "--phase");
    return true;
}

bool ang_load_report_hounsfield(const ang_load_report *report) {
    return report->series_count > 0 && strcmp(report->format, "DICOM") == 0 &&
           strcmp(report->series[report->chosen].modality, "CT") == 0;
}

/* Options for raw input are refused where the input is something else: ignored, they would mislead. Those that a state
 * remembers were said of other data. */
static bool refuse_raw_options(const char *label, const char *what, const ang_load_options *options, ang_error *err) {
    const char *name = options->raw_dims      ? "--raw-dims"
                       : options->raw_type    ? "--raw-type"
                       : options->raw_spacing ? "--raw-spacing"
                                              : NULL;
    return !name || options->raw_remembered ||
           ang_fail(err, ANG_USAGE, "%s is for raw input, and %s is %s: leave it out", name, label, what);
}

/* What is left out of a build is no format of it. */
#ifdef ANG_WITH_NIFTI
#define NIFTI "NIfTI-1, "
#else
#define NIFTI ""
#endif
#ifdef ANG_WITH_OIIO
#define PICTURES ", a PNG or TIFF picture"
#else
#define PICTURES ""
#endif

/* Fails where the file is voxels that a header beside it describes; true where there is none. */
static bool point_to_header(const char *path, const char *label, ang_error *err) {
    static const char *const pairs[][2] = {{".img", ".hdr"}, {".img.gz", ".hdr"},  {".raw", ".nhdr"},
                                           {".raw", ".mhd"}, {".raw.gz", ".nhdr"}, {".zraw", ".mhd"}};
    size_t length = strlen(path);
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        size_t ending = strlen(pairs[i][0]);
        char *header = NULL;
        if (length <= ending || strcmp(path + length - ending, pairs[i][0]) != 0) continue;
        if (asprintf(&header, "%.*s%s", (int)(length - ending), path, pairs[i][1]) < 0) return true;
        bool there = access(header, F_OK) == 0;
        if (there)
            ang_fail(err, ANG_INPUT, "%s: holds voxels only; open the header beside it, %s", label,
                     ang_base_name(header));
        free(header);
        if (there) return false;
    }
    return true;
}

static bool fail_unknown(const char *path, const char *label, ang_error *err) {
    struct stat status;
    if (stat(path, &status) == 0 && status.st_size == 0) return ang_fail(err, ANG_INPUT, "%s: is empty", label);
    if (ang_nifti2_probe(path))
        return ang_fail(err, ANG_INPUT, "%s: is NIfTI-2, which is not read: convert it to NIfTI-1", label);
    if (!point_to_header(path, label, err)) return false;
    return ang_fail(err, ANG_INPUT,
                    "%s: is neither DICOM, " NIFTI "NRRD, MetaImage" PICTURES
                    " nor a zip archive; a raw volume needs --raw-dims and --raw-type or a sidecar %s.json",
                    label, label);
}

typedef ang_volume *reader(const char *path, const ang_load_options *options, ang_load_report *report,
                           const ang_progress *progress, ang_error *err);

/* Formats of one volume each. */
static const struct {
    const char *name;
    reader *read;
} single[] = {[ANG_KIND_NIFTI] = {"NIfTI-1", ang_nifti_load},
              [ANG_KIND_NRRD] = {"NRRD", ang_nrrd_load},
              [ANG_KIND_METAIMAGE] = {"MetaImage", ang_metaimage_load},
              [ANG_KIND_PICTURES] = {"a stack of pictures", ang_stack_load},
              [ANG_KIND_RAW] = {"raw", ang_raw_load}};

/* One of several volumes: the list and the note say so. */
static bool tell_of_others(const ang_found *found, size_t index, const ang_load_options *options,
                           ang_load_report *report, ang_error *err) {
    if (!ang_volumes_list_around(found, index, report, err)) return false;
    if (!options->series)
        ang_notes_add(&report->assumptions, "series 1 of %zu is shown: the first volume by name; %s picks another",
                      found->count, options->series_choice ? options->series_choice : "--series");
    return true;
}

static ang_volume *read_volume(const ang_found *found, const ang_load_options *options, ang_load_report *report,
                               const ang_progress *progress, ang_error *err) {
    size_t index;
    if (!ang_volumes_choose(found, options, &index, err)) return NULL;
    const ang_found_volume *chosen = &found->volume[index];
    if (chosen->kind != ANG_KIND_RAW &&
        !refuse_raw_options(ang_base_name(chosen->path), single[chosen->kind].name, options, err))
        return NULL;
    ang_volume *volume = single[chosen->kind].read(chosen->path, options, report, progress, err);
    if (found->count == 1 || (volume && tell_of_others(found, index, options, report, err))) return volume;
    ang_volume_free(volume);
    /* What is not loaded is listed all the same, so that another can be picked. */
    if (report->series_count == 0 && err->code != ANG_INTERRUPTED) ang_volumes_list(found, report, NULL);
    return NULL;
}

/* DICOM at or below any of the paths, or volumes of other formats. */
static ang_volume *dispatch(const char *const *paths, size_t count, const ang_load_options *options,
                            ang_load_report *report, const ang_progress *progress, ang_error *err) {
    ang_found found;
    ang_volume *volume = NULL;
    if (!ang_kind_find(paths, count, options, progress, &found, err)) return NULL;
    const char *label = ang_base_name(paths[0]);
    ang_kind kind = found.volume[0].kind;
    bool folder = kind == ANG_KIND_DICOM && count == 1 && !ang_dicom_probe(paths[0]);
    if (kind == ANG_KIND_NONE)
        fail_unknown(paths[0], label, err);
    else if (kind != ANG_KIND_DICOM)
        volume = read_volume(&found, options, report, progress, err);
    else if (refuse_raw_options(label, folder ? "a folder" : "DICOM", options, err))
        volume = ang_dicom_load(paths, count, options, report, progress, err);
    if (volume && kind != ANG_KIND_DICOM && found.count == 1 && count > 1)
        ang_notes_add(&report->assumptions, "of %zu files, which are no DICOM, one is shown", count);
    ang_found_clear(&found);
    return volume;
}

/* Numbers that are finite and yet none of a scan: everything after this may count on sensible ones. */
static bool check_numbers(const ang_volume *volume, const char *label, ang_error *err) {
    static const double least_slope = 1e-30, least_spacing = 1e-6, most_spacing = 1e6; /* floats hold their powers */
    static const double most_place = 1e6; /* mm from the origin of LPS, as stack.json may say */
    double low = ang_volume_hu(volume, volume->minimum), high = ang_volume_hu(volume, volume->maximum);
    if (!isfinite(low) || !isfinite(high))
        return ang_fail(err, ANG_INPUT, "%s: its values are no numbers; is the rescale right?", label);
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
        sound = sound && spacing >= least_spacing && spacing <= most_spacing &&
                fabs(volume->affine.m[axis][3]) <= most_place;
    }
    return sound ||
           ang_fail(err, ANG_GEOMETRY,
                    "%s: voxels of %g x %g x %g mm, or where they lie, make no volume; is the spacing right?", label,
                    ang_volume_spacing(volume, 0), ang_volume_spacing(volume, 1), ang_volume_spacing(volume, 2));
}

/* What is unusual of the axes that a header gives. DICOM's come from positions, and its reader speaks of tilt. */
static void note_axes(const ang_volume *volume, ang_notes *assumptions) {
    static const double degree = 3.14159265358979323846 / 180;
    double largest = 0; /* cosine between two axes */
    for (int axis = 0; axis < 3; axis++) {
        ang_vec3 a = ang_mat4_column(&volume->affine, axis), b = ang_mat4_column(&volume->affine, (axis + 1) % 3);
        double cosine = fabs(ang_vec3_dot(ang_vec3_unit(a), ang_vec3_unit(b)));
        if (cosine > largest) largest = cosine;
    }
    if (largest > 1e-3)
        ang_notes_add(assumptions,
                      "its axes are up to %.2f degrees off right angles: kept as a shear, nothing is resampled for it",
                      asin(largest < 1 ? largest : 1) / degree);
    if (ang_mat4_determinant(&volume->affine) < 0)
        ang_notes_add(assumptions, "its axes are left-handed: kept so, the letters at the panes follow them");
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

/* Whether reading this volume reads the file. */
static bool volume_reads(const ang_found_volume *volume, const char *path) {
    bool header = volume->kind == ANG_KIND_NRRD || volume->kind == ANG_KIND_METAIMAGE;
    bool pictures = volume->kind == ANG_KIND_PICTURES;
    bool reads = ang_file_same(volume->path, path) ||
                 (header && ang_header_names(volume->path, volume->kind == ANG_KIND_NRRD, path)) ||
                 (pictures && lies_in(volume->path, path) && ang_stack_probe(path));
    char *sidecar = pictures ? ang_stack_sidecar(volume->path) : ang_raw_sidecar(volume->path);
    reads = reads || (sidecar && ang_file_same(sidecar, path));
    free(sidecar);
    return reads;
}

bool ang_load_reads(const char *input, const char *path) {
    struct stat status;
    static const ang_load_options none = {0};
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode)) return false;
    if (ang_file_same(input, path)) return true;
    bool folder = stat(input, &status) == 0 && S_ISDIR(status.st_mode);
    if (ang_dicom_is_directory(input)) {
        char *around = ang_dicom_folder_of(input);
        bool read = around && lies_in(around, path) && ang_dicom_probe(path);
        free(around);
        return read;
    }
    if (folder && !lies_in(input, path)) return false;
    ang_found found;
    bool reads = false;
    if (!ang_kind_find(&input, 1, &none, NULL, &found, NULL)) return false;
    if (folder && found.volume[0].kind == ANG_KIND_DICOM) reads = ang_dicom_probe(path);
    for (size_t i = 0; i < found.count && !reads; i++) reads = volume_reads(&found.volume[i], path);
    ang_found_clear(&found);
    return reads;
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
    ang_unpacked unpacked;
    ang_volume *volume = NULL;
    if (ang_unpack(paths, count, &unpacked, &report->warnings, progress, err))
        volume = dispatch(unpacked.path, count, options, report, progress, err);
    ang_unpacked_name(&unpacked, err);
    ang_unpacked_clear(&unpacked);
    if (!volume) return NULL;
    *err = (ang_error){0};
    if (!note_phase(options, report, err) || !check_numbers(volume, ang_base_name(paths[0]), err)) {
        ang_volume_free(volume);
        return NULL;
    }
    if (strcmp(report->format, "DICOM") != 0) note_axes(volume, &report->assumptions);
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
