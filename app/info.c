/* angioscope info: what is in a folder or file, and what was assumed in reading it. */
#include "app/verbs.h"
#include "io/load.h"
#include "io/report.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>

int ang_app_info(const ang_options *options, ang_error *err) {
    if (!ang_app_arguments(options, 1, "info: give one file or folder to read", err)) return ANG_USAGE;
    ang_load_options how = ang_app_load_options(options);
    ang_app_progress *progress = ang_app_progress_start(options->quiet);
    ang_load_report report = {0};
    ang_volume *volume = ang_load(options->arguments[0], &how, &report, ang_app_progress_sink(progress), err);
    ang_app_progress_end(progress);
    /* What is not loaded is listed all the same (dicom-rules 1). */
    bool listed = volume || (report.series_count > 0 && err->code != ANG_INTERRUPTED);
    if (!listed) {
        if (!options->quiet) ang_app_say(&report.warnings, "warning: ", err);
    } else if (options->json_flag) {
        cJSON *root = cJSON_CreateObject();
        cJSON_AddStringToObject(root, "version", ANG_VERSION);
        cJSON_AddItemToObject(root, "input", ang_load_report_json(volume, &report, options->keep_phi));
        char *text = cJSON_Print(root);
        puts(text ? text : "null");
        free(text);
        cJSON_Delete(root);
    } else {
        ang_load_report_print(stdout, volume, &report, options->keep_phi);
    }
    fflush(stdout); /* the table before the error */
    int code = volume ? ANG_OK : (int)err->code;
    ang_load_report_clear(&report);
    ang_volume_free(volume);
    return code;
}
