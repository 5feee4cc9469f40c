#include "io/report.h"

#include "io/json.h"
#include "io/text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void ang_load_report_name(const ang_load_report *report, char name[32]) {
    const ang_series_info *info = report->series_count ? &report->series[report->chosen] : NULL;
    int used = snprintf(name, 32, "%08x-%d", (unsigned)report->stored_crc32, info ? info->number : 0);
    if (info && info->phases > 1) snprintf(name + used, 32 - (size_t)used, ".%d", report->phase);
}

/* Text of the file for JSON and the table, in `out`. */
static const char *clean(const char *text, char *out, size_t size) {
    snprintf(out, size, "%s", text ? text : "");
    ang_text_clean(out);
    return out;
}

static const char *or_dash(const char *text) { return text && text[0] ? text : "-"; }

static void print_notes(FILE *out, const char *title, const ang_notes *notes, bool keep_phi) {
    if (notes->count == 0) return;
    bool hidden = false;
    for (size_t i = 0; i < notes->count; i++) hidden = hidden || (notes->file[i] && !keep_phi);
    fprintf(out, "%s%s\n", title, hidden ? " (--keep-phi names the files)" : "");
    for (size_t i = 0; i < notes->count; i++) {
        char text[ANG_NOTES_LINE];
        ang_notes_line(notes, i, keep_phi, text, sizeof text);
        ang_text_clean(text);
        fprintf(out, "  - %s\n", text);
    }
}

/* The phases of a series of several; `shown`, from 1, is the one that is loaded. */
static void print_phases(FILE *out, const ang_series_info *info, int shown) {
    for (int phase = 1; info->phases > 1 && phase <= info->phases; phase++) {
        char text[ANG_NOTES_LINE];
        fprintf(out, "      %c phase %d%s%s\n", phase == shown ? '*' : ' ', phase,
                ang_series_phase_text(info, phase)[0] ? ": " : "",
                clean(ang_series_phase_text(info, phase), text, sizeof text));
    }
}

static void print_series(FILE *out, const ang_volume *volume, const ang_load_report *report, bool keep_phi) {
    fprintf(out, "Series (* is the one shown)\n");
    fprintf(out, "    no. kind   columns x rows x slices   spacing mm            remark\n");
    for (size_t i = 0; i < report->series_count; i++) {
        const ang_series_info *info = &report->series[i];
        char size[48], spacing[64], description[ANG_NOTES_LINE];
        snprintf(size, sizeof size, "%d x %d x %d", info->width, info->height, info->slices);
        snprintf(spacing, sizeof spacing, "%.3f x %.3f x %.3f", info->spacing_mm[0], info->spacing_mm[1],
                 info->spacing_mm[2]);
        bool known = info->width > 0; /* of what has not been read yet, perhaps */
        bool chosen = volume && (int)i == report->chosen;
        clean(keep_phi ? info->description : NULL, description, sizeof description);
        fprintf(out, "  %c %3d %-6s %-25s %-21s %s%s%s%s\n", chosen ? '*' : ' ', info->number, info->modality,
                known ? size : "not read yet", known ? spacing : "-",
                info->loadable ? "" : "not a volume: ", or_dash(info->remark), description[0] ? "; " : "", description);
        print_phases(out, info, chosen ? report->phase : 0);
    }
}

/* The letter of the patient's side that a direction points to most (PS3.3 C.7.6.1.1.1). */
static char side(ang_vec3 d) {
    double x = fabs(d.x), y = fabs(d.y), z = fabs(d.z);
    if (x >= y && x >= z) return d.x > 0 ? 'L' : 'R';
    if (y >= z) return d.y > 0 ? 'P' : 'A';
    return d.z > 0 ? 'H' : 'F';
}

/* Adds to what is in `text`, as far as there is room. */
static void append(char *text, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));
static void append(char *text, size_t size, const char *format, ...) {
    size_t used = strlen(text);
    va_list args;
    va_start(args, format);
    vsnprintf(text + used, size - used, format, args);
    va_end(args);
}

/* Slices as they were read, and where they are not the volume's planes, how these were made of them. */
static void add_read_slices(const ang_volume *volume, const ang_load_report *report, ang_facts *facts) {
    char text[256] = "";
    append(text, sizeof text, "%d read", report->slices_read);
    if (report->slices_duplicate)
        append(text, sizeof text, ", %d duplicate%s dropped", report->slices_duplicate,
               ang_plural(report->slices_duplicate));
    ang_facts_add(facts, "slices", "%s", text);
    if (report->slice_gap_median_mm > 0) {
        snprintf(text, sizeof text, "%.3f to %.3f mm, median %.3f mm", report->slice_gap_min_mm,
                 report->slice_gap_max_mm, report->slice_gap_median_mm);
        if (report->gap_count)
            append(text, sizeof text, ", mean %.3f mm", report->series[report->chosen].spacing_mm[2]);
        ang_facts_add(facts, "distances", "%s", text);
    }
    for (size_t i = 0; i < report->gap_count; i++) {
        const ang_gap *gap = &report->gaps[i];
        snprintf(text, sizeof text, "after slice %d: %.3f mm, ", gap->after + 1, gap->mm);
        if (gap->missing)
            append(text, sizeof text, "%d missing", gap->missing);
        else
            append(text, sizeof text, "irregular");
        ang_facts_add(facts, "", "%s", text);
    }
    double distance = ang_volume_slice_distance(volume);
    if (report->resampled)
        ang_facts_add(facts, "planes", "%d in the volume, %.3f mm apart: resampled from the %d slices read",
                      volume->dims[2], distance, report->slices_read);
    else if (report->slices_missing)
        ang_facts_add(facts, "planes", "%d in the volume, %.3f mm apart: the %d slices read and %d interpolated",
                      volume->dims[2], distance, report->slices_read, report->slices_missing);
}

static void add_geometry_facts(const ang_volume *volume, const ang_load_report *report, ang_facts *facts) {
    ang_facts_heading(facts, "Geometry");
    ang_facts_add(facts, "size", "%d x %d x %d voxels", volume->dims[0], volume->dims[1], volume->dims[2]);
    ang_facts_add(facts, "voxel", "%.4f x %.4f x %.4f mm", ang_volume_spacing(volume, 0), ang_volume_spacing(volume, 1),
                  ang_volume_slice_distance(volume));
    ang_vec3 axis[3];
    for (int i = 0; i < 3; i++) axis[i] = ang_mat4_column(&volume->affine, i);
    ang_facts_add(facts, "axes", "columns run to %c, rows to %c, slices to %c", side(axis[0]), side(axis[1]),
                  side(axis[2]));
    ang_facts_add(facts, "first voxel", "%.2f, %.2f, %.2f mm (left, posterior, head)", volume->affine.m[0][3],
                  volume->affine.m[1][3], volume->affine.m[2][3]);
    char tilt[96];
    snprintf(tilt, sizeof tilt, "%.2f degrees%s", report->tilt_deg, report->tilt_deg > 0 ? ", kept as a shear" : "");
    if (isfinite(report->tilt_nominal_deg))
        append(tilt, sizeof tilt, " (the scanner says %.2f)", report->tilt_nominal_deg);
    ang_facts_add(facts, "gantry tilt", "%s", tilt);
    add_read_slices(volume, report, facts);
}

static void add_padding(const ang_volume *volume, const ang_load_report *report, const char *unit, ang_facts *facts) {
    char text[192];
    if (volume->padding_count == 0) return;
    snprintf(text, sizeof text, "%g%s (%s)", report->padding_hu, unit,
             report->padding_declared ? "declared" : "found in the corners");
    if (report->padding_declared && report->padding_found)
        append(text, sizeof text, " and %g%s (found in the corners)", report->padding_found_hu, unit);
    ang_facts_add(facts, "padding", "%s, %.1f %% of the voxels, shown as %g%s", text,
                  100.0 * (double)volume->padding_count / (double)ang_volume_count(volume),
                  ang_volume_hu(volume, ang_volume_padding_value(volume)), unit);
}

static void add_value_facts(const ang_volume *volume, const ang_load_report *report, ang_facts *facts) {
    bool hounsfield = ang_load_report_hounsfield(report);
    const char *unit = hounsfield ? " HU" : "";
    ang_facts_heading(facts, "Values");
    ang_facts_add(facts, "range", "%g to %g%s%s", ang_volume_hu(volume, volume->minimum),
                  ang_volume_hu(volume, volume->maximum), unit, report->resampled ? ", after resampling" : "");
    /* Of the values that the file holds where one map does for all, else of the volume's own. */
    bool common = isfinite(report->slope);
    double slope = common ? report->slope : volume->slope, intercept = common ? report->intercept : volume->intercept;
    ang_facts_add(facts, hounsfield ? "HU" : "value", "= %.10g x %s %c %.10g%s; stored in %d bits, %s", slope,
                  common ? "stored" : "the volume's value", intercept < 0 ? '-' : '+', fabs(intercept),
                  common ? "" : ", as slices have different rescale", report->bits_stored,
                  report->signed_stored ? "signed" : "unsigned");
    add_padding(volume, report, unit, facts);
    if (report->rescale_error_hu > 0)
        ang_facts_add(facts, "rescale", "off by up to %.3g%s", report->rescale_error_hu, unit);
    if (report->quantisation_hu > 0)
        ang_facts_add(facts, "quantised", "in steps of %.4g%s", report->quantisation_hu, unit);
    if (report->nan_count || report->inf_count)
        ang_facts_add(facts, "not numbers", "%llu NaN, %llu infinite", (unsigned long long)report->nan_count,
                      (unsigned long long)report->inf_count);
    if (isfinite(report->window_centre) && isfinite(report->window_width))
        ang_facts_add(facts, "window", "centre %g, width %g%s", report->window_centre, report->window_width, unit);
    ang_facts_add(facts, "checksum", "%08x (CRC-32 of the stored values)", (unsigned)report->stored_crc32);
}

void ang_load_report_facts(const ang_volume *volume, const ang_load_report *report, ang_facts *facts) {
    add_geometry_facts(volume, report, facts);
    add_value_facts(volume, report, facts);
}

static void print_facts(FILE *out, const ang_facts *facts) {
    for (size_t i = 0; i < facts->count; i++) {
        const ang_fact *fact = &facts->fact[i];
        if (!fact->value)
            fprintf(out, "%s\n", fact->name);
        else if (fact->name[0])
            fprintf(out, "  %-12s %s\n", fact->name, fact->value);
        else
            fprintf(out, "    %s\n", fact->value);
    }
}

void ang_load_report_print(FILE *out, const ang_volume *volume, const ang_load_report *report, bool keep_phi) {
    char name[32];
    ang_load_report_name(report, name);
    fprintf(out, "Input          %s, %s\n", report->format[0] ? report->format : "?", volume ? name : "not loaded");
    if (report->series_count) print_series(out, volume, report, keep_phi);
    if (volume) {
        ang_facts facts = {0};
        ang_load_report_facts(volume, report, &facts);
        print_facts(out, &facts);
        ang_facts_clear(&facts);
    }
    print_notes(out, "Assumed", &report->assumptions, keep_phi);
    print_notes(out, "Warnings", &report->warnings, keep_phi);
}

static void add_numbers(cJSON *object, const char *name, const double *values, int count) {
    cJSON_AddItemToObject(object, name, cJSON_CreateDoubleArray(values, count));
}

static void add_notes(cJSON *object, const char *name, const ang_notes *notes, bool keep_phi) {
    cJSON *array = cJSON_AddArrayToObject(object, name);
    for (size_t i = 0; i < notes->count; i++) {
        char text[ANG_NOTES_LINE];
        ang_notes_line(notes, i, keep_phi, text, sizeof text);
        ang_text_clean(text);
        cJSON_AddItemToArray(array, cJSON_CreateString(text));
    }
}

static void add_series(cJSON *input, const ang_volume *volume, const ang_load_report *report, bool keep_phi) {
    cJSON *array = cJSON_AddArrayToObject(input, "series");
    for (size_t i = 0; i < report->series_count; i++) {
        const ang_series_info *info = &report->series[i];
        cJSON *item = cJSON_CreateObject();
        cJSON_AddNumberToObject(item, "number", info->number);
        cJSON_AddStringToObject(item, "modality", info->modality);
        cJSON_AddNumberToObject(item, "columns", info->width);
        cJSON_AddNumberToObject(item, "rows", info->height);
        cJSON_AddNumberToObject(item, "slices", info->slices);
        add_numbers(item, "spacing_mm", info->spacing_mm, 3);
        cJSON_AddBoolToObject(item, "loadable", info->loadable);
        cJSON_AddBoolToObject(item, "chosen", volume && (int)i == report->chosen);
        cJSON_AddStringToObject(item, "remark", info->remark ? info->remark : "");
        cJSON *phases = cJSON_AddArrayToObject(item, "phases");
        for (int phase = 1; phase <= info->phases; phase++) {
            char text[ANG_NOTES_LINE];
            clean(ang_series_phase_text(info, phase), text, sizeof text);
            cJSON_AddItemToArray(phases, cJSON_CreateString(text));
        }
        if (keep_phi) {
            char text[ANG_NOTES_LINE];
            cJSON_AddStringToObject(item, "description", clean(info->description, text, sizeof text));
            cJSON_AddStringToObject(item, "uid", clean(info->uid, text, sizeof text));
        }
        cJSON_AddItemToArray(array, item);
    }
}

static void add_geometry(cJSON *input, const ang_volume *volume, const ang_load_report *report) {
    double spacing[3] = {ang_volume_spacing(volume, 0), ang_volume_spacing(volume, 1),
                         ang_volume_slice_distance(volume)};
    cJSON_AddItemToObject(input, "dims", cJSON_CreateIntArray(volume->dims, 3));
    add_numbers(input, "spacing_mm", spacing, 3);
    ang_json_add_number(input, "tilt_deg", report->tilt_deg);
    ang_json_add_number(input, "tilt_nominal_deg", report->tilt_nominal_deg);
    cJSON *rows = cJSON_AddArrayToObject(input, "affine");
    for (int r = 0; r < 4; r++) cJSON_AddItemToArray(rows, cJSON_CreateDoubleArray(volume->affine.m[r], 4));
    double range[2] = {ang_volume_hu(volume, volume->minimum), ang_volume_hu(volume, volume->maximum)};
    add_numbers(input, "hu_range", range, 2);
    ang_json_add_number(input, "slope", report->slope);
    ang_json_add_number(input, "intercept", report->intercept);
    cJSON *map = cJSON_AddObjectToObject(input, "volume_map");
    ang_json_add_number(map, "slope", volume->slope);
    ang_json_add_number(map, "intercept", volume->intercept);
    cJSON_AddNumberToObject(input, "stored_crc32", report->stored_crc32);
    cJSON *padding = cJSON_AddObjectToObject(input, "padding");
    bool any = volume->padding_count > 0;
    cJSON_AddBoolToObject(padding, "declared", report->padding_declared);
    cJSON_AddBoolToObject(padding, "found", report->padding_found);
    ang_json_add_number(padding, "hu", any ? report->padding_hu : NAN);
    ang_json_add_number(padding, "found_hu", report->padding_found_hu);
    ang_json_add_number(padding, "shown_hu", any ? ang_volume_hu(volume, ang_volume_padding_value(volume)) : NAN);
    cJSON_AddNumberToObject(padding, "voxels", (double)volume->padding_count);
}

static void add_slices(cJSON *input, const ang_load_report *report) {
    cJSON_AddNumberToObject(input, "slices_read", report->slices_read);
    cJSON_AddNumberToObject(input, "slices_missing", report->slices_missing);
    cJSON_AddNumberToObject(input, "duplicates", report->slices_duplicate);
    cJSON_AddBoolToObject(input, "resampled", report->resampled);
    cJSON *distance = cJSON_AddObjectToObject(input, "slice_gap_mm");
    ang_json_add_number(distance, "median", report->slice_gap_median_mm);
    ang_json_add_number(distance, "min", report->slice_gap_min_mm);
    ang_json_add_number(distance, "max", report->slice_gap_max_mm);
    cJSON *gaps = cJSON_AddArrayToObject(input, "gaps");
    for (size_t i = 0; i < report->gap_count; i++) {
        cJSON *gap = cJSON_CreateObject();
        cJSON_AddNumberToObject(gap, "after", report->gaps[i].after);
        ang_json_add_number(gap, "mm", report->gaps[i].mm);
        cJSON_AddNumberToObject(gap, "missing", report->gaps[i].missing);
        cJSON_AddItemToArray(gaps, gap);
    }
}

cJSON *ang_load_report_json(const ang_volume *volume, const ang_load_report *report, bool keep_phi) {
    cJSON *input = cJSON_CreateObject();
    if (!input) return NULL;
    char name[32];
    ang_load_report_name(report, name);
    if (volume)
        cJSON_AddStringToObject(input, "name", name);
    else
        cJSON_AddNullToObject(input, "name");
    cJSON_AddStringToObject(input, "format", report->format);
    if (volume) cJSON_AddNumberToObject(input, "phase", report->phase);
    if (volume) add_geometry(input, volume, report);
    add_series(input, volume, report, keep_phi);
    add_slices(input, report);
    cJSON_AddNumberToObject(input, "bits_stored", report->bits_stored);
    cJSON_AddBoolToObject(input, "signed", report->signed_stored);
    cJSON_AddNumberToObject(input, "rescale_error_hu", report->rescale_error_hu);
    cJSON_AddNumberToObject(input, "quantisation_hu", report->quantisation_hu);
    cJSON_AddNumberToObject(input, "nan_count", (double)report->nan_count);
    cJSON_AddNumberToObject(input, "inf_count", (double)report->inf_count);
    ang_json_add_number(input, "window_centre", report->window_centre);
    ang_json_add_number(input, "window_width", report->window_width);
    add_notes(input, "assumptions", &report->assumptions, keep_phi);
    add_notes(input, "warnings", &report->warnings, keep_phi);
    return input;
}
