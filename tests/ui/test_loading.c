/* Loading beside the window: progress, results, errors and stopping. */
#include "tests/core/fixtures.h"

#ifdef ANG_WITH_WINDOW

#include "ui/loading.h"

#include <string.h>
#include <time.h>

static int released;

/* "forever" goes on until it is told to stop; "bad" fails; others give a volume. */
static bool load(void *context, const char *path, ang_study *study, const ang_progress *progress, ang_error *err) {
    (void)context;
    if (strcmp(path, "bad") == 0) return ang_fail(err, ANG_INPUT, "bad: is no volume");
    struct timespec while_reading = {0, 1000000};
    for (int i = 0; strcmp(path, "forever") == 0 || i < 10; i++) {
        if (!ang_progress_update(progress, "reading slices", i % 10 / 10.0))
            return ang_fail(err, ANG_INTERRUPTED, "interrupted");
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

/* True where it finished within ten seconds. */
static bool take(ang_loading *loading, bool *done, ang_study *study, ang_error *err) {
    struct timespec pause = {0, 2000000};
    for (int i = 0; i < 5000; i++) {
        if (ang_loading_take(loading, done, study, err)) return true;
        nanosleep(&pause, NULL);
    }
    return false;
}

static void results_and_errors_arrive(void **state) {
    (void)state;
    ang_loading loading = {0};
    bool done = false;
    ang_study study = {0};
    ang_error err = {0};
    assert_false(ang_loading_take(&loading, &done, &study, &err));
    assert_true(ang_loading_start(&loading, &host, "good", &err));
    assert_true(take(&loading, &done, &study, &err));
    assert_true(done && study.volume);
    ang_volume_free(study.volume);
    assert_false(ang_loading_take(&loading, &done, &study, &err));
    assert_true(ang_loading_start(&loading, &host, "bad", &err));
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
    ang_error err = {0};
    char what[64] = "";
    assert_true(ang_loading_start(&loading, &host, "forever", &err));
    struct timespec pause = {0, 1000000};
    for (int i = 0; i < 5000 && !what[0]; i++) {
        assert_true(ang_loading_progress(&loading, what) < 1);
        nanosleep(&pause, NULL);
    }
    assert_string_equal(what, "reading slices");
    assert_false(ang_loading_take(&loading, &done, &study, &err));
    ang_loading_stop(&loading);
    assert_true(take(&loading, &done, &study, &err));
    assert_false(done);
    assert_int_equal(err.code, ANG_INTERRUPTED);
}

/* Closing the window while something is being read, or has been read but not yet shown. */
static void ending_lets_go_of_everything(void **state) {
    (void)state;
    ang_loading loading = {0};
    assert_true(ang_loading_start(&loading, &host, "forever", NULL));
    ang_loading_end(&loading);
    assert_int_equal(released, 0);
    assert_true(ang_loading_start(&loading, &host, "good", NULL));
    struct timespec pause = {0, 200000000};
    nanosleep(&pause, NULL);
    ang_loading_end(&loading);
    assert_true(released <= 1); /* 0 where it was slow enough to be stopped */
    ang_loading_end(&loading);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(results_and_errors_arrive),
        cmocka_unit_test(long_work_stops_when_told),
        cmocka_unit_test(ending_lets_go_of_everything),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#else

int main(void) {
    print_message("skipped: this build has no window\n");
    return 0;
}

#endif
