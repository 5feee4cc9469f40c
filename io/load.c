#include "io/load.h"

#include "io/dicom/dicom.h"
#include "io/formats.h"

#include <errno.h>
#include <math.h>
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
        free(report->series[i].uid);
        free(report->series[i].remark);
    }
    free(report->series);
    free(report->gaps);
    ang_notes_clear(&report->assumptions);
    ang_notes_clear(&report->warnings);
    *report = (ang_load_report){0};
}

bool ang_load_report_hounsfield(const ang_load_report *report) {
    return report->series_count > 0 && strcmp(report->format, "DICOM") == 0 &&
           strcmp(report->series[report->chosen].modality, "CT") == 0;
}

static ang_volume *dispatch(const char *path, const ang_load_options *options, ang_load_report *report,
                            const ang_progress *progress, ang_error *err) {
    struct stat status;
    const char *label = ang_base_name(path);
    if (stat(path, &status) != 0) {
        ang_fail(err, ANG_INPUT, "%s: %s", path, strerror(errno));
        return NULL;
    }
    if (S_ISDIR(status.st_mode)) return ang_dicom_load(path, options, report, progress, err);
    if (!S_ISREG(status.st_mode)) {
        ang_fail(err, ANG_INPUT, "%s: is neither a file nor a folder", path);
        return NULL;
    }
    if (options->raw_dims) return ang_raw_load(path, options, report, progress, err);
    if (status.st_size == 0) {
        ang_fail(err, ANG_INPUT, "%s: is empty", label);
        return NULL;
    }
    if (ang_dicom_probe(path)) return ang_dicom_load(path, options, report, progress, err);
    if (ang_nifti_probe(path)) return ang_nifti_load(path, options, report, progress, err);
    if (ang_raw_probe(path, options)) return ang_raw_load(path, options, report, progress, err);
    ang_fail(err, ANG_INPUT,
             "%s: is neither DICOM nor NIfTI-1; a raw volume needs --raw-dims and --raw-type or a sidecar %s.json",
             label, label);
    return NULL;
}

ang_volume *ang_load(const char *path, const ang_load_options *options, ang_load_report *report,
                     const ang_progress *progress, ang_error *err) {
    static const ang_load_options defaults = {0};
    ang_error own;
    if (!err) err = &own;
    if (!options) options = &defaults;
    *err = (ang_error){0};
    *report = (ang_load_report){.tilt_nominal_deg = NAN, .window_centre = NAN, .window_width = NAN};
    ang_volume *volume = dispatch(path, options, report, progress, err);
    if (!volume) return NULL;
    *err = (ang_error){0};
    if (options->strict && report->warnings.count > 0) {
        char line[ANG_NOTES_LINE];
        ang_fail(err, ANG_GEOMETRY, "--strict: %s", ang_notes_line(&report->warnings, 0, true, line, sizeof line));
        ang_volume_free(volume);
        return NULL;
    }
    return volume;
}
