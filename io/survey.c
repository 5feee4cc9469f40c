#include "io/survey.h"

#include "core/base/memory.h"
#include "io/dicom/dicom.h"
#include "io/formats.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

bool ang_survey(const char *const *paths, size_t count, const ang_load_options *options, ang_load_report *report,
                const ang_survey_sink *sink, const ang_progress *progress, ang_error *err) {
    static const ang_load_options defaults = {0};
    if (!options) options = &defaults;
    ang_load_report_start(report);
    if (access(paths[0], F_OK) != 0) return ang_fail(err, ANG_INPUT, "%s: %s", paths[0], strerror(errno));
    for (size_t i = 0; i < count; i++)
        if (ang_is_dicom(paths[i])) return ang_dicom_survey(paths, count, options, report, sink, progress, err);
    if (!list_one(report, paths[0], err)) return false;
    sink->listed(sink->context, report);
    return true;
}
