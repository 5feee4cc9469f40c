#include "io/survey.h"

#include "io/archive/archive.h"
#include "io/dicom/dicom.h"
#include "io/formats.h"
#include "io/volumes.h"

static bool look(const char *const *paths, size_t count, const ang_load_options *options, ang_load_report *report,
                 const ang_survey_sink *sink, const ang_progress *progress, ang_error *err) {
    ang_found found;
    if (!ang_kind_find(paths, count, options, progress, &found, err)) return false;
    bool dicom = found.volume[0].kind == ANG_KIND_DICOM, ok = dicom || ang_volumes_list(&found, report, err);
    ang_found_clear(&found);
    if (dicom) return ang_dicom_survey(paths, count, options, report, sink, progress, err);
    if (ok) sink->listed(sink->context, report);
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
