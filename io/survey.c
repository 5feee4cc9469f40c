#include "io/survey.h"

#include "core/base/memory.h"
#include "io/archive/archive.h"
#include "io/dicom/dicom.h"
#include "io/formats.h"
#include "io/kind.h"
#include "io/voxels/volume_header.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One series, of which nothing more is known before it is read. */
static bool list_one(ang_load_report *report, const char *path, ang_error *err) {
    report->series = ang_alloc(1, sizeof *report->series, "list of series", err);
    if (!report->series) return false;
    report->series_count = 1;
    *report->series = (ang_series_info){.number = 1,
                                        .modality = "?",
                                        .description = strdup(ang_base_name(path)),
                                        .patient = strdup(""),
                                        .uid = strdup(""),
                                        .remark = strdup(""),
                                        .phases = 1,
                                        .loadable = true};
    const ang_series_info *info = report->series;
    return (info->description && info->patient && info->uid && info->remark) ||
           ang_fail(err, ANG_LIMIT, "no memory for the list of series");
}

/* A volume whose header tells its size and phases without its voxels being read. */
static bool list_header(ang_load_report *report, const char *path, ang_header_parser *parse, ang_error *err) {
    ang_volume_header header = {0};
    bool ok = ang_volume_header_read(path, parse, &header, err) && ang_volume_header_list(&header, path, report, err);
    ang_volume_header_clear(&header);
    return ok;
}

static bool look(const char *const *paths, size_t count, const ang_load_options *options, ang_load_report *report,
                 const ang_survey_sink *sink, const ang_progress *progress, ang_error *err) {
    ang_found found;
    size_t index;
    if (!ang_kind_choose(paths, count, options, progress, &index, &found, err)) return false;
    bool dicom = found.kind == ANG_KIND_DICOM;
    bool ok = dicom                              ? ang_dicom_survey(paths, count, options, report, sink, progress, err)
              : found.kind == ANG_KIND_NRRD      ? list_header(report, found.path, ang_nrrd_parse, err)
              : found.kind == ANG_KIND_METAIMAGE ? list_header(report, found.path, ang_metaimage_parse, err)
                                                 : list_one(report, found.path, err);
    ang_found_clear(&found);
    if (ok && !dicom) sink->listed(sink->context, report);
    return ok;
}

bool ang_survey(const char *const *paths, size_t count, const ang_load_options *options, ang_load_report *report,
                const ang_survey_sink *sink, const ang_progress *progress, ang_error *err) {
    static const ang_load_options defaults = {0};
    ang_unpacked unpacked;
    if (!options) options = &defaults;
    ang_load_report_start(report);
    bool ok = ang_unpack(paths, count, &unpacked, &report->warnings, progress, err) &&
              look(unpacked.path, count, options, report, sink, progress, err);
    if (err) ang_unpacked_name(&unpacked, err);
    ang_unpacked_clear(&unpacked);
    return ok;
}
