#include "app/view_load.h"

#ifdef ANG_WITH_WINDOW

#include "app/verbs.h"
#include "io/report.h"
#include "io/survey.h"
#include "io/text.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static void copy_notes(const ang_load_report *report, ang_study *study) {
    ang_notes_append(&study->notes, &report->warnings);
    study->warnings = (int)study->notes.count;
    ang_notes_append(&study->notes, &report->assumptions);
}

static void write_label(const ang_load_report *report, ang_study *study) {
    const ang_series_info *info = &report->series[report->chosen];
    bool named = strcmp(info->modality, "?") != 0;
    char phase[24] = "";
    if (info->phases > 1) snprintf(phase, sizeof phase, ", phase %d", report->phase);
    snprintf(study->label, sizeof study->label, "%s series %d%s", named ? info->modality : report->format, info->number,
             phase);
    snprintf(study->phase_text, sizeof study->phase_text, "%s", ang_series_phase_text(info, report->phase));
    if (info->description) snprintf(study->description, sizeof study->description, "%s", info->description);
    if (info->patient) ang_person_name_print(info->patient, study->patient, sizeof study->patient);
}

static char *print_report(const ang_volume *volume, const ang_load_report *report, bool keep_phi) {
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    ang_load_report_print(out, volume, report, keep_phi);
    fclose(out);
    return text;
}

void ang_view_release(ang_study *study) {
    ang_volume_free(study->volume);
    ang_notes_clear(&study->notes);
    ang_facts_clear(&study->facts);
    free(study->report);
    if (study->handle) ang_load_report_clear(study->handle);
    free(study->handle);
    *study = (ang_study){0};
}

bool ang_view_load(const ang_load_options *how, bool keep_phi, const ang_source *source, const ang_slice_sink *slices,
                   ang_study *study, const ang_progress *progress, ang_error *err) {
    char number[16];
    ang_load_options options = *how;
    snprintf(number, sizeof number, "%d", source->series);
    if (source->series > 0) options.series = number;
    if (source->series > 0) options.phase = source->phase;
    options.slices = *slices;
    options.series_choice = "File > Series (key F3)";
    options.phase_choice = "Slices > Next phase (key Ctrl+])";
    *study = (ang_study){0};
    ang_load_report *report = calloc(1, sizeof *report);
    if (!report) return ang_fail(err, ANG_LIMIT, "no memory for a report");
    study->handle = report;
    study->volume = ang_load_all((const char *const *)source->paths, source->count, &options, report, progress, err);
    if (!study->volume) {
        int found = (int)report->series_count;
        ang_view_release(study);
        study->series_count = found;
        return false;
    }
    study->hounsfield = ang_load_report_hounsfield(report);
    study->window_centre = report->window_centre;
    study->window_width = report->window_width;
    study->series = report->chosen + 1;
    study->series_count = (int)report->series_count;
    study->phase = report->phase;
    study->phases = report->series[report->chosen].phases;
    study->report = print_report(study->volume, report, keep_phi);
    ang_load_report_facts(study->volume, report, &study->facts);
    write_label(report, study);
    copy_notes(report, study);
    return true;
}

typedef struct survey {
    const ang_series_sink *sink;
    ang_series_list list;
} survey;

static void describe(const ang_series_info *info, ang_series_entry *entry) {
    entry->number = info->number;
    entry->loadable = info->loadable;
    entry->dims[0] = info->width;
    entry->dims[1] = info->height;
    entry->dims[2] = info->slices;
    entry->phases = info->phases;
    memcpy(entry->spacing_mm, info->spacing_mm, sizeof entry->spacing_mm);
    snprintf(entry->modality, sizeof entry->modality, "%s", info->modality);
    snprintf(entry->date, sizeof entry->date, "%s", info->date);
    snprintf(entry->description, sizeof entry->description, "%.90s", info->description ? info->description : "");
    ang_text_clean(entry->description);
    snprintf(entry->remark, sizeof entry->remark, "%.390s", info->remark ? info->remark : "");
}

static void listed(void *context, const ang_load_report *report) {
    survey *survey = context;
    if (!ang_series_list_make(&survey->list, report->series_count)) return;
    for (size_t i = 0; i < report->series_count; i++) describe(&report->series[i], &survey->list.entry[i]);
    survey->sink->listed(survey->sink->context, &survey->list);
}

static void looked_at(void *context, size_t index, const ang_raw_slice *middle, const ang_notes *warnings,
                      const char *refusal) {
    survey *survey = context;
    if (index >= survey->list.count) return;
    ang_series_entry *entry = &survey->list.entry[index];
    entry->looked_at = true;
    entry->warnings = (int)warnings->count;
    if (refusal) {
        entry->loadable = false;
        snprintf(entry->remark, sizeof entry->remark, "%.390s", refusal);
    }
    if (middle) ang_series_entry_picture(entry, middle);
    survey->sink->looked_at(survey->sink->context, index, entry);
}

bool ang_view_survey(const ang_options *options, const ang_source *source, const ang_series_sink *sink,
                     const ang_progress *progress, ang_error *err) {
    survey survey = {.sink = sink};
    ang_survey_sink within = {listed, looked_at, &survey};
    ang_load_options how = ang_app_load_options(options);
    ang_load_report report = {0};
    bool done = ang_survey((const char *const *)source->paths, source->count, &how, &report, &within, progress, err);
    ang_load_report_clear(&report);
    ang_series_list_clear(&survey.list);
    return done;
}

bool ang_view_list_folder(const char *path, ang_file_list *list, ang_error *err) {
    DIR *directory = opendir(path);
    if (!directory) return ang_fail(err, ANG_INPUT, "%s: %s", path, strerror(errno));
    for (struct dirent *entry; (entry = readdir(directory));) {
        struct stat status;
        const char *name = entry->d_name;
        if (strcmp(name, ".") == 0 || strcmp(name, "..") == 0) continue;
        if (fstatat(dirfd(directory), name, &status, 0) != 0) continue; /* a link that leads nowhere */
        if (S_ISDIR(status.st_mode) || S_ISREG(status.st_mode))
            ang_file_list_add(list, name, S_ISDIR(status.st_mode), (long long)status.st_size);
    }
    closedir(directory);
    return true;
}

#endif
