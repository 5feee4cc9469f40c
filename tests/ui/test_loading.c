/* Loading beside the window: progress, results, errors and stopping. */
#include "tests/core/fixtures.h"

#ifdef ANG_WITH_WINDOW

#include "ui/host/loading.h"
#include "ui/host/surveying.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

static int released;

/* "forever" goes on until it is told to stop, slice after slice; "bad" fails; others give a volume. */
static bool load(void *context, const ang_source *source, const ang_slice_sink *slices, ang_study *study,
                 const ang_progress *progress, ang_error *err) {
    (void)context;
    const char *path = source->paths[0];
    const uint16_t values[] = {0, 40, 80, 120};
    ang_raw_slice slice = {.values = values, .width = 2, .height = 2, .slope = 1, .hounsfield = true};
    slice.pixel_aspect = 1;
    slice.count = 10;
    if (strcmp(path, "bad") == 0) return ang_fail(err, ANG_INPUT, "bad: is no volume");
    struct timespec while_reading = {0, 1000000};
    for (int i = 0; strcmp(path, "forever") == 0 || i < 10; i++) {
        if (!ang_progress_update(progress, "reading slices", i % 10 / 10.0))
            return ang_fail(err, ANG_INTERRUPTED, "interrupted");
        slice.index = (size_t)i % 10;
        slices->take(slices->context, &slice);
        nanosleep(&while_reading, NULL);
    }
    study->volume = ang_volume_create((int[]){2, 2, 2}, err);
    return study->volume != NULL;
}

static void release(void *context, ang_study *study) {
    (void)context;
    ang_volume_free(study->volume);
    released++;
}

static const ang_viewer_host host = {.load = load, .release = release};

static bool start(ang_loading *loading, const char *path, ang_error *err) {
    ang_source source = ang_source_make(&path, 1, 0);
    return ang_loading_start(loading, &host, &source, err);
}

/* True where it finished within ten seconds. */
static bool take(ang_loading *loading, bool *done, ang_study *study, ang_error *err) {
    struct timespec pause = {0, 2000000};
    for (int i = 0; i < 5000; i++) {
        ang_source source = {0};
        bool finished = ang_loading_take(loading, done, &source, study, err);
        ang_source_clear(&source);
        if (finished) return true;
        nanosleep(&pause, NULL);
    }
    return false;
}

static void results_and_errors_arrive(void **state) {
    (void)state;
    ang_loading loading = {0};
    bool done = false;
    ang_study study = {0};
    ang_source none = {0};
    ang_error err = {0};
    assert_false(ang_loading_take(&loading, &done, &none, &study, &err));
    assert_true(start(&loading, "good", &err));
    assert_true(take(&loading, &done, &study, &err));
    assert_true(done && study.volume);
    ang_volume_free(study.volume);
    assert_false(ang_loading_take(&loading, &done, &none, &study, &err));
    assert_true(start(&loading, "bad", &err));
    assert_true(take(&loading, &done, &study, &err));
    assert_false(done);
    assert_int_equal(err.code, ANG_INPUT);
    assert_string_equal(err.message, "bad: is no volume");
}

static void long_work_stops_when_told(void **state) {
    (void)state;
    ang_loading loading = {0};
    bool done = true;
    ang_study study = {0};
    ang_source none = {0};
    ang_error err = {0};
    char what[64] = "";
    assert_true(start(&loading, "forever", &err));
    struct timespec pause = {0, 1000000};
    for (int i = 0; i < 5000 && !what[0]; i++) {
        assert_true(ang_loading_progress(&loading, what) < 1);
        nanosleep(&pause, NULL);
    }
    assert_string_equal(what, "reading slices");
    assert_false(ang_loading_take(&loading, &done, &none, &study, &err));
    /* Slices come one by one, a new one only after the last has been taken. */
    ang_preview *preview = calloc(1, sizeof *preview);
    assert_non_null(preview);
    size_t index = 99, count = 0, seen = 0;
    for (int i = 0; i < 5000 && seen < 3; i++) {
        seen += ang_loading_preview(&loading, preview, &index, &count);
        nanosleep(&pause, NULL);
    }
    assert_int_equal(seen, 3);
    assert_true(index < 10 && count == 10);
    assert_true(preview->width == 2 && preview->height == 2 && preview->grey[1] == 128);
    free(preview);
    assert_false(ang_loading_stopping(&loading));
    ang_loading_stop(&loading);
    assert_true(ang_loading_stopping(&loading));
    assert_true(take(&loading, &done, &study, &err));
    assert_false(done);
    assert_int_equal(err.code, ANG_INTERRUPTED);
}

/* Closing the window while something is being read, or has been read but not yet shown. */
static void ending_lets_go_of_everything(void **state) {
    (void)state;
    ang_loading loading = {0};
    assert_true(start(&loading, "forever", NULL));
    ang_loading_end(&loading);
    assert_int_equal(released, 0);
    assert_true(start(&loading, "good", NULL));
    struct timespec pause = {0, 200000000};
    nanosleep(&pause, NULL);
    ang_loading_end(&loading);
    assert_true(released <= 1); /* 0 where it was slow enough to be stopped */
    ang_loading_end(&loading);
}

/* "forever" lists two series and looks at the first until it is told to stop. */
static bool survey(void *context, const ang_source *source, const ang_series_sink *sink, const ang_progress *progress,
                   ang_error *err) {
    (void)context;
    if (strcmp(source->paths[0], "bad") == 0) return ang_fail(err, ANG_INPUT, "bad: holds nothing");
    ang_series_list list = {0};
    ang_series_list_make(&list, 2);
    list.entry[0].number = 1;
    list.entry[1].number = 2;
    sink->listed(sink->context, &list);
    struct timespec while_reading = {0, 1000000};
    bool going = true;
    do {
        for (size_t i = 0; i < 2 && going; i++) {
            list.entry[i].looked_at = true;
            sink->looked_at(sink->context, i, &list.entry[i]);
            going = ang_progress_update(progress, "looking", 0);
        }
        nanosleep(&while_reading, NULL);
    } while (going && strcmp(source->paths[0], "forever") == 0);
    ang_series_list_clear(&list);
    return going || ang_fail(err, ANG_INTERRUPTED, "interrupted");
}

static const ang_viewer_host surveyor = {.survey = survey};

/* Takes what comes until it has finished; how many entries have been filled in. */
static int take_all(ang_surveying *surveying, ang_series_list *list, ang_error *err) {
    struct timespec pause = {0, 1000000};
    int filled = 0;
    for (int i = 0; i < 5000; i++) {
        bool listed;
        while (ang_surveying_take(surveying, list, &listed) >= 0 || listed) filled += !listed;
        if (ang_surveying_finished(surveying, err)) return filled;
        nanosleep(&pause, NULL);
    }
    return -1;
}

static void series_arrive_one_by_one(void **state) {
    (void)state;
    ang_surveying surveying = {0};
    ang_series_list list = {0};
    ang_error err = {0};
    const char *path = "good";
    ang_source source = ang_source_make(&path, 1, 2);
    assert_true(ang_surveying_start(&surveying, &surveyor, &source, &err));
    assert_true(take_all(&surveying, &list, &err) >= 1); /* one may come with the list */
    assert_int_equal(err.code, ANG_OK);
    assert_int_equal(list.count, 2);
    assert_true(list.entry[0].looked_at && list.entry[1].looked_at && list.entry[1].number == 2);
    ang_source_clear(&source);
    path = "bad";
    source = ang_source_make(&path, 1, 0);
    assert_true(ang_surveying_start(&surveying, &surveyor, &source, &err));
    assert_int_equal(take_all(&surveying, &list, &err), 0);
    assert_string_equal(err.message, "bad: holds nothing");
    ang_source_clear(&source);
    path = "forever";
    source = ang_source_make(&path, 1, 0);
    assert_true(ang_surveying_start(&surveying, &surveyor, &source, &err));
    ang_surveying_end(&surveying);
    assert_false(surveying.running);
    ang_source_clear(&source);
    ang_series_list_clear(&list);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(results_and_errors_arrive),
        cmocka_unit_test(long_work_stops_when_told),
        cmocka_unit_test(ending_lets_go_of_everything),
        cmocka_unit_test(series_arrive_one_by_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#else

int main(void) {
    print_message("skipped: this build has no window\n");
    return 0;
}

#endif
