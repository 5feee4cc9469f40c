/* Series of several volumes at the same positions: listed as phases of one series, one of which is loaded. */
#define FOLDER ANG_TEST_TMP "/phases"
#include "tests/io/small_dicom.h"

#include "io/dicom/choose.h"
#include "io/dicom/phases.h"
#include "tests/io/slice_record.h"

/* All slices hold the same pixels: air. */
static ang_dicom_likeness all_same(void *context, size_t a, size_t b, ang_error *err) {
    (void)context, (void)a, (void)b, (void)err;
    return ANG_DICOM_SAME;
}

static ang_dicom_groups grouped(const ang_dicom_slice *s, size_t n) {
    ang_dicom_groups groups;
    ang_error err = {0};
    if (!ang_dicom_group_slices(s, n, all_same, NULL, &groups, &err)) fail_msg("%s", err.message);
    return groups;
}

/* `positions` slices of each of `phases` phases, in order of position. */
static size_t stacks(ang_dicom_slice *s, int positions, int phases) {
    size_t n = 0;
    for (int z = 0; z < positions; z++) {
        for (int p = 0; p < phases; p++, n++) {
            s[n] = slice_at(z, (int)n);
            s[n].file = n;
        }
    }
    return n;
}

static void test_order_is_that_of_the_key(void **state) {
    (void)state;
    ang_dicom_slice s[48];
    size_t n = stacks(s, 3, 12);
    for (size_t i = 0; i < n; i++) { /* 12 to 1: as text 10 would come before 2 */
        s[i].has_temporal_position = true;
        s[i].temporal_position = 12 - (int)(i % 12);
    }
    ang_dicom_groups groups = grouped(s, n);
    assert_int_equal(groups.count, 12);
    assert_int_equal(groups.series_count, 1);
    for (int p = 0; p < 12; p++) {
        const ang_dicom_group *group = &groups.group[p];
        char text[64];
        snprintf(text, sizeof text, "temporal position %d", p + 1);
        assert_string_equal(group->phase_text, text);
        assert_int_equal(group->phase, p + 1);
        assert_int_equal(group->phases, 12);
        assert_int_equal(group->count, 3); /* equal pixels are no duplicates here */
        assert_int_equal(group->duplicates, 0);
        assert_string_equal(group->remark, "12 phases at the same positions");
        for (size_t i = 0; i < group->count; i++) assert_int_equal(s[group->order[i]].temporal_position, p + 1);
    }
    ang_error err = {0};
    size_t chosen;
    assert_true(ang_dicom_choose(s, &groups, NULL, &chosen, &err));
    assert_int_equal(chosen, 0);
    assert_false(ang_dicom_choose(s, &groups, "2", &chosen, &err));
    ang_dicom_groups_clear(&groups);
}

static void expect_texts(const ang_dicom_slice *s, size_t n, const char *first, const char *second) {
    ang_dicom_groups groups = grouped(s, n);
    assert_int_equal(groups.series_count, 1);
    assert_int_equal(groups.count, 2);
    assert_string_equal(groups.group[0].phase_text, first);
    assert_string_equal(groups.group[1].phase_text, second);
    ang_dicom_groups_clear(&groups);
}

static void test_what_tells_phases_apart(void **state) {
    (void)state;
    ang_dicom_slice s[8];
    size_t n = stacks(s, 4, 2);
    for (size_t i = 0; i < n; i++) {
        s[i].has_trigger_time = true;
        s[i].trigger_time = i % 2 ? 62.5 : 512;
    }
    expect_texts(s, n, "trigger time 62.5 ms", "trigger time 512 ms");
    n = stacks(s, 4, 2);
    for (size_t i = 0; i < n; i++) {
        s[i].has_cardiac_phase = true;
        s[i].cardiac_phase = i % 2 ? 40 : 75;
    }
    expect_texts(s, n, "40 % of the cardiac cycle", "75 % of the cardiac cycle");
    n = stacks(s, 4, 2);
    for (size_t i = 0; i < n; i++) strcpy(s[i].dimensions, i % 2 ? "1\\10" : "1\\9");
    expect_texts(s, n, "dimension index 1\\9", "dimension index 1\\10");
    n = stacks(s, 4, 2);
    for (size_t i = 0; i < n; i++) {
        s[i].has_acquisition_number = true;
        s[i].acquisition_number = i % 2 ? 3 : 7;
    }
    expect_texts(s, n, "acquisition 3", "acquisition 7");
}

static void test_times_of_day_do_not_show(void **state) {
    (void)state;
    char text[64];
    ang_dicom_slice a = slice_at(0, 0), b = a;
    strcpy(a.acquisition_time, "20240517 235958.5");
    strcpy(b.acquisition_time, "20240517 235959.75");
    ang_dicom_phase_words(ANG_DICOM_BY_ACQUISITION_TIME, &b, &a, 2, text, sizeof text);
    assert_string_equal(text, "acquired 1.25 s after the first");
    ang_dicom_phase_words(ANG_DICOM_BY_ACQUISITION_TIME, &a, &a, 1, text, sizeof text);
    assert_string_equal(text, "acquired first");
    strcpy(b.acquisition_time, "20240518 000001");
    ang_dicom_phase_words(ANG_DICOM_BY_ACQUISITION_TIME, &b, &a, 2, text, sizeof text);
    assert_string_equal(text, "acquired later");
}

/* Two stacks far apart, each in two phases: two series of two phases. */
static void test_stacks_of_phases(void **state) {
    (void)state;
    ang_dicom_slice s[80];
    size_t n = 0;
    for (int z = 0; z < 20; z++) {
        for (int p = 0; p < 2; p++, n++) {
            s[n] = slice_at(z < 10 ? z : z + 500, (int)n);
            s[n].file = n;
            s[n].has_temporal_position = true;
            s[n].temporal_position = p + 1;
        }
    }
    ang_dicom_groups groups = grouped(s, n);
    assert_int_equal(groups.series_count, 2);
    assert_int_equal(groups.count, 4);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(groups.group[i].series, i / 2 + 1);
        assert_int_equal(groups.group[i].phase, i % 2 + 1);
        assert_int_equal(groups.group[i].count, 10);
    }
    assert_int_equal(ang_dicom_series_start(&groups, 2), 2);
    ang_dicom_groups_clear(&groups);
}

static void write_phases(void) {
    fresh_folder(FOLDER);
    for (int p = 0; p < 3; p++) {
        for (int z = 0; z < 4; z++) {
            char name[32], trigger[16];
            form f = form_at(z, 1000 * (p + 1) + 10 * z);
            f.instance = 10 * (3 - p) + z;
            snprintf(trigger, sizeof trigger, "%d", 100 * p);
            f.trigger_time = trigger;
            snprintf(name, sizeof name, "%d-%d.dcm", z, p);
            if (p < 2 || z < 3) small(name, &f); /* the last phase has lost a slice */
        }
    }
}

static void test_a_phase_is_loaded(void **state) {
    (void)state;
    write_phases();
    for (int phase = 0; phase <= 3; phase++) {
        ang_load_report report;
        ang_error err = {0};
        ang_volume *v = ang_load(FOLDER, &(ang_load_options){.phase = phase}, &report, NULL, &err);
        if (!v) fail_msg("%s", err.message);
        int shown = phase ? phase : 1;
        char name[32];
        ang_load_report_name(&report, name);
        assert_int_equal(report.series_count, 1);
        assert_int_equal(report.phase, shown);
        assert_int_equal(report.series[0].phases, 3);
        assert_string_equal(ang_series_phase_text(&report.series[0], 2), "trigger time 100 ms");
        assert_string_equal(ang_series_phase_text(&report.series[0], 3), "trigger time 200 ms, 3 slices");
        assert_int_equal(v->dims[2], shown == 3 ? 3 : 4);
        assert_true(fabs(hu_at(v, 0, 0, 1) - (1000 * shown + 10 - 1024)) < 1e-9);
        assert_int_equal(atoi(strchr(name, '.') + 1), shown);
        ang_volume_free(v);
        ang_load_report_clear(&report);
    }
    static const char *const choices[] = {NULL, "a key"}, *const told[] = {"; --phase picks another",
                                                                           "; a key picks another"};
    for (int i = 0; i < 2; i++) {
        ang_load_report report;
        ang_volume *v = ang_load(FOLDER, &(ang_load_options){.phase_choice = choices[i]}, &report, NULL, NULL);
        assert_non_null(v);
        bool found = false;
        for (size_t k = 0; k < report.assumptions.count; k++)
            found = found || strstr(report.assumptions.text[k], told[i]);
        assert_true(found);
        ang_volume_free(v);
        ang_load_report_clear(&report);
    }
    ang_load_report report;
    ang_error err = {0};
    assert_null(ang_load(FOLDER, &(ang_load_options){.phase = 4}, &report, NULL, &err));
    assert_int_equal(err.code, ANG_INPUT);
    assert_string_equal(err.message, "--phase 4: series 1 has phases 1 to 3");
    ang_load_report_clear(&report);
}

static void test_phases_are_listed(void **state) {
    (void)state;
    write_phases();
    ang_load_report report;
    ang_error err = {0};
    ang_volume *v = ang_load(FOLDER, &(ang_load_options){.phase = 2}, &report, NULL, &err);
    assert_non_null(v);
    cJSON *json = ang_load_report_json(v, &report, false);
    const cJSON *series = cJSON_GetArrayItem(cJSON_GetObjectItem(json, "series"), 0);
    const cJSON *phases = cJSON_GetObjectItem(series, "phases");
    assert_int_equal(cJSON_GetArraySize(phases), 3);
    assert_string_equal(cJSON_GetArrayItem(phases, 1)->valuestring, "trigger time 100 ms");
    assert_int_equal(cJSON_GetObjectItem(json, "phase")->valueint, 2);
    cJSON_Delete(json);
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    ang_load_report_print(out, v, &report, false);
    fclose(out);
    assert_non_null(strstr(text, "  phase 1: trigger time 0 ms\n"));
    assert_non_null(strstr(text, "* phase 2: trigger time 100 ms\n"));
    free(text);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void test_one_volume_has_one_phase(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    for (int z = 0; z < 3; z++) {
        char name[32];
        form f = form_at(z, 100 * z);
        snprintf(name, sizeof name, "%d.dcm", z);
        small(name, &f);
    }
    ang_load_report report;
    ang_error err = {0};
    assert_null(ang_load(FOLDER, &(ang_load_options){.phase = 2}, &report, NULL, &err));
    assert_int_equal(err.code, ANG_INPUT);
    assert_string_equal(err.message, "--phase 2: series 1 is one volume, phase 1");
    ang_load_report_clear(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order_is_that_of_the_key), cmocka_unit_test(test_what_tells_phases_apart),
        cmocka_unit_test(test_times_of_day_do_not_show), cmocka_unit_test(test_stacks_of_phases),
        cmocka_unit_test(test_a_phase_is_loaded),        cmocka_unit_test(test_phases_are_listed),
        cmocka_unit_test(test_one_volume_has_one_phase),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
