/* Series of an input without loading one; several paths as one input; slices handed out while they are read. */
#include "tests/core/fixtures.h"

#include "io/phantom.h"
#include "io/replace.h"
#include "io/survey.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FOLDER ANG_TEST_TMP "/survey"

static void write_text(const char *path, const char *text) {
    assert_true(ang_file_replace(path, text, strlen(text), NULL));
}

static void write_phantom(const char *folder, int size, int slices) {
    ang_phantom_params params = ang_phantom_params_default;
    params.dims[0] = params.dims[1] = size;
    params.dims[2] = slices;
    ang_error err = {0};
    if (!ang_phantom_write(folder, &params, 0, NULL, &err)) fail_msg("%s", err.message);
}

/* In "a" 20 slices of 32 x 32; in "b" 13 of 24 x 24; beside them what is no image. */
static int setup(void **state) {
    (void)state;
    if (system("rm -rf " FOLDER) != 0) return -1;
    write_phantom(FOLDER "/a", 32, 20);
    write_phantom(FOLDER "/b", 24, 13);
    write_text(FOLDER "/notes.txt", "no picture");
    return 0;
}

enum { MOST = 8 };
typedef struct seen {
    size_t listed, looked_at;
    bool picture[MOST], refused[MOST];
    int warnings[MOST], width[MOST];
    uint16_t *values[MOST];
} seen;

static void listed(void *context, const ang_load_report *report) {
    seen *seen = context;
    assert_int_equal(seen->looked_at, 0);
    seen->listed = report->series_count;
}

static void looked_at(void *context, size_t index, const ang_raw_slice *middle, const ang_notes *warnings,
                      const char *refusal) {
    seen *seen = context;
    assert_int_equal(index, seen->looked_at++);
    assert_true(index < MOST);
    seen->picture[index] = middle != NULL;
    seen->refused[index] = refusal != NULL;
    seen->warnings[index] = (int)warnings->count;
    if (!middle) return;
    size_t bytes = (size_t)middle->width * (size_t)middle->height * sizeof *middle->values;
    seen->width[index] = middle->width;
    seen->values[index] = malloc(bytes);
    assert_non_null(seen->values[index]);
    memcpy(seen->values[index], middle->values, bytes);
}

static bool survey_all(const char *const *paths, size_t count, seen *seen, const ang_progress *progress,
                       ang_error *err) {
    ang_load_report report = {0};
    ang_survey_sink sink = {listed, looked_at, seen};
    bool done = ang_survey(paths, count, NULL, &report, &sink, progress, err);
    ang_load_report_clear(&report);
    return done;
}

static bool survey(const char *path, seen *seen, const ang_progress *progress, ang_error *err) {
    return survey_all(&path, 1, seen, progress, err);
}

static void clear(seen *seen) {
    for (int i = 0; i < MOST; i++) free(seen->values[i]);
    *seen = (struct seen){0};
}

/* Each series' picture is the middle plane of what loading it gives. */
static void a_survey_shows_the_middle_of_each_series(void **state) {
    (void)state;
    seen seen = {0};
    ang_error err = {0};
    if (!survey(FOLDER, &seen, NULL, &err)) fail_msg("%s", err.message);
    assert_int_equal(seen.listed, 2);
    assert_int_equal(seen.looked_at, 2);
    for (int i = 0; i < 2; i++) {
        char number[4];
        ang_load_report report = {0};
        snprintf(number, sizeof number, "%d", i + 1);
        ang_volume *volume = ang_load(FOLDER, &(ang_load_options){.series = number}, &report, NULL, &err);
        assert_non_null(volume);
        assert_true(seen.picture[i] && !seen.refused[i]);
        assert_int_equal(seen.width[i], volume->dims[0]);
        assert_int_equal(seen.warnings[i], (int)report.warnings.count);
        size_t plane = (size_t)volume->dims[0] * (size_t)volume->dims[1];
        const uint16_t *middle = volume->data + plane * (size_t)(volume->dims[2] / 2);
        /* Loading may have moved padding; the map of the phantom is its slices'. */
        assert_memory_equal(seen.values[i], middle, plane * sizeof *middle);
        ang_volume_free(volume);
        ang_load_report_clear(&report);
    }
    clear(&seen);
}

/* Of several inputs DICOM is listed wherever it stands, as it is loaded. */
static void what_is_listed_is_what_is_loaded(void **state) {
    (void)state;
    static const char header[] = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n\nx";
    static const char *const paths[] = {ANG_TEST_TMP "/survey-one.nrrd", FOLDER};
    FILE *file = fopen(paths[0], "wb");
    assert_non_null(file);
    fwrite(header, 1, sizeof header - 1, file);
    fclose(file);
    seen seen = {0};
    ang_error err = {0};
    ang_load_report report = {0};
    assert_true(survey_all(paths, 2, &seen, NULL, &err));
    ang_volume *volume = ang_load_all(paths, 2, NULL, &report, NULL, &err);
    assert_non_null(volume);
    assert_string_equal(report.format, "DICOM");
    assert_int_equal(seen.listed, report.series_count);
    assert_int_equal(seen.looked_at, 2);
    ang_volume_free(volume);
    ang_load_report_clear(&report);
    clear(&seen);
}

static bool stop_at_last(void *context, const char *what, double fraction) {
    (void)what;
    const seen *seen = context;
    return fraction < 1 || seen->looked_at == 0;
}

static void surveys_stop_and_fail_as_loading_does(void **state) {
    (void)state;
    seen seen = {0};
    ang_error err = {0};
    ang_progress stop = {.update = stop_at_last, .context = &seen};
    assert_false(survey(FOLDER, &seen, &stop, &err));
    assert_int_equal(err.code, ANG_INTERRUPTED);
    clear(&seen);
    assert_false(survey(FOLDER "/none", &seen, NULL, &err));
    assert_int_equal(err.code, ANG_INPUT);
    assert_int_equal(seen.listed, 0);
    clear(&seen);
    /* Of a format that holds one volume nothing is read. */
    assert_true(survey(FOLDER "/notes.txt", &seen, NULL, &err));
    assert_int_equal(seen.listed, 1);
    assert_int_equal(seen.looked_at, 0);
}

static void several_paths_are_one_input(void **state) {
    (void)state;
    ang_load_report report = {0};
    ang_error err = {0};
    /* Three files, one of them twice, with one that is no image. */
    const char *files[] = {FOLDER "/a/IM0004.dcm", FOLDER "/a/IM0002.dcm", FOLDER "/notes.txt", FOLDER "/a/IM0003.dcm",
                           FOLDER "/a/IM0004.dcm"};
    ang_volume *volume = ang_load_all(files, 5, NULL, &report, NULL, &err);
    if (!volume) fail_msg("%s", err.message);
    assert_int_equal(volume->dims[2], 3);
    assert_int_equal(report.slices_duplicate, 0);
    ang_volume_free(volume);
    ang_load_report_clear(&report);
    const char *folders[] = {FOLDER "/b", FOLDER "/a"};
    volume = ang_load_all(folders, 2, NULL, &report, NULL, &err);
    assert_non_null(volume);
    assert_int_equal(report.series_count, 2);
    assert_int_equal(volume->dims[2], 20);
    ang_volume_free(volume);
    ang_load_report_clear(&report);
    const char *wrong[] = {FOLDER "/a", FOLDER "/none"};
    assert_null(ang_load_all(wrong, 2, NULL, &report, NULL, &err));
    assert_int_equal(err.code, ANG_INPUT);
    assert_non_null(strstr(err.message, "/none"));
    ang_load_report_clear(&report);
}

typedef struct taken {
    pthread_mutex_t lock;
    uint16_t *planes; /* in their places */
    int times[32];
    size_t count;
} taken;

static void take(void *context, const ang_raw_slice *slice) {
    taken *taken = context;
    size_t plane = (size_t)slice->width * (size_t)slice->height;
    pthread_mutex_lock(&taken->lock);
    taken->count = slice->count;
    if (slice->index < 32) {
        taken->times[slice->index]++;
        memcpy(taken->planes + slice->index * plane, slice->values, plane * sizeof *slice->values);
    }
    pthread_mutex_unlock(&taken->lock);
}

/* Every slice comes once, at its place, as it will stand in the volume. */
static void slices_are_handed_out_as_they_are_read(void **state) {
    (void)state;
    taken taken = {.lock = PTHREAD_MUTEX_INITIALIZER, .planes = calloc(32 * 32 * 32, sizeof(uint16_t))};
    ang_load_options options = {.slices = {take, &taken}};
    ang_load_report report = {0};
    ang_error err = {0};
    ang_volume *volume = ang_load(FOLDER "/a", &options, &report, NULL, &err);
    assert_true(volume && taken.planes);
    assert_int_equal(taken.count, 20);
    for (int i = 0; i < 20; i++) assert_int_equal(taken.times[i], 1);
    assert_memory_equal(taken.planes, volume->data, ang_volume_count(volume) * sizeof *volume->data);
    ang_volume_free(volume);
    ang_load_report_clear(&report);
    free(taken.planes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_listed_is_what_is_loaded),
        cmocka_unit_test(a_survey_shows_the_middle_of_each_series),
        cmocka_unit_test(surveys_stop_and_fail_as_loading_does),
        cmocka_unit_test(several_paths_are_one_input),
        cmocka_unit_test(slices_are_handed_out_as_they_are_read),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
