#include "io/volumes.h"

#include "core/base/memory.h"
#include "io/formats.h"
#include "io/voxels/volume_header.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool ends_with(const char *text, const char *end) {
    size_t a = strlen(text), b = strlen(end);
    return b > 0 && a >= b && strcmp(text + a - b, end) == 0;
}

bool ang_volumes_choose(const ang_found *found, const ang_load_options *options, size_t *index, ang_error *err) {
    *index = 0;
    if (!options->series) return true;
    char *rest;
    long number = strtol(options->series, &rest, 10);
    if (rest != options->series && !*rest && number >= 1 && (size_t)number <= found->count) {
        *index = (size_t)number - 1;
        return true;
    }
    if (options->series_remembered) return true;
    if (found->count == 1)
        return ang_fail(err, ANG_INPUT, "--series %s: %s holds one volume, series 1", options->series,
                        ang_base_name(found->volume[0].path));
    for (; *index < found->count; ++*index)
        if (ends_with(found->volume[*index].path, options->series)) return true;
    return ang_fail(err, ANG_INPUT, "--series %s: there are volumes 1 to %zu, and no file's name ends so",
                    options->series, found->count);
}

/* What is known of a volume without its file being read. */
static bool describe(ang_series_info *info, const char *path, const char *remark, bool loadable, ang_error *err) {
    *info = (ang_series_info){.modality = "?",
                              .description = strdup(ang_base_name(path)),
                              .patient = strdup(""),
                              .uid = strdup(""),
                              .remark = strdup(remark),
                              .phases = 1,
                              .loadable = loadable};
    return (info->description && info->patient && info->uid && info->remark) ||
           ang_fail(err, ANG_LIMIT, "no memory for the list of series");
}

/* A volume whose header tells its size and phases. False where the header is wrong. */
static bool describe_header(ang_series_info *info, const char *path, ang_header_parser *parse, ang_error *err) {
    ang_volume_header header = {0};
    ang_load_report listed;
    ang_load_report_start(&listed);
    bool ok = ang_volume_header_read(path, parse, &header, err) && ang_volume_header_list(&header, path, &listed, err);
    if (ok) {
        *info = *listed.series;
        listed.series_count = 0; /* moved */
    }
    ang_volume_header_clear(&header);
    ang_load_report_clear(&listed);
    return ok;
}

static bool describe_volume(ang_series_info *info, const ang_found_volume *volume, ang_error *err) {
    if (volume->kind == ANG_KIND_NRRD) return describe_header(info, volume->path, ang_nrrd_parse, err);
    if (volume->kind == ANG_KIND_METAIMAGE) return describe_header(info, volume->path, ang_metaimage_parse, err);
    return describe(info, volume->path, "", true, err);
}

/* Says of an entry which format it is: most have nothing else to be told apart by. */
static bool name_format(ang_series_info *info, ang_kind kind, ang_error *err) {
    static const char *const names[] = {[ANG_KIND_NIFTI] = "NIfTI-1",
                                        [ANG_KIND_NRRD] = "NRRD",
                                        [ANG_KIND_METAIMAGE] = "MetaImage",
                                        [ANG_KIND_PICTURES] = "pictures",
                                        [ANG_KIND_RAW] = "raw"};
    if (info->remark[0] || kind < ANG_KIND_NIFTI) return true;
    free(info->remark);
    info->remark = strdup(names[kind]);
    return info->remark || ang_fail(err, ANG_LIMIT, "no memory for the list of series");
}

bool ang_volumes_list(const ang_found *found, ang_load_report *report, ang_error *err) {
    report->series = ang_alloc(found->count, sizeof *report->series, "list of series", err);
    if (!report->series) return false;
    for (size_t i = 0; i < found->count; i++) {
        ang_error why = {0};
        ang_series_info *info = &report->series[i];
        report->series_count = i + 1;
        bool ok = describe_volume(info, &found->volume[i], &why);
        if (!ok && (found->count == 1 || why.code == ANG_LIMIT)) {
            if (err) *err = why;
            return false;
        }
        if (!ok && !describe(info, found->volume[i].path, why.message, false, err)) return false;
        info->number = (int)i + 1;
        if (found->count > 1 && !name_format(info, found->volume[i].kind, err)) return false;
    }
    return true;
}

bool ang_volumes_list_around(const ang_found *found, size_t index, ang_load_report *report, ang_error *err) {
    ang_load_report all = {0};
    bool ok = ang_volumes_list(found, &all, err) && name_format(report->series, found->volume[index].kind, err);
    if (ok) {
        ang_series_info known = *report->series;
        known.number = (int)index + 1;
        *report->series = all.series[index]; /* changes places, and goes */
        all.series[index] = known;
        ang_series_info *alone = report->series;
        report->series = all.series;
        report->series_count = all.series_count;
        report->chosen = (int)index;
        all.series = alone;
        all.series_count = 1;
    }
    ang_load_report_clear(&all);
    return ok;
}
