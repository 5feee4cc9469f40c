/* What the tests of loading share. */
#ifndef ANG_TESTS_IO_LOADING_H
#define ANG_TESTS_IO_LOADING_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "io/load.h"
#include "io/report.h"

#include <dirent.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

static inline bool have_data(void) {
    if (access(ANG_SHARED_DATA "/README.md", R_OK) == 0) return true;
    print_message("skipped: no real data at %s\n", ANG_SHARED_DATA);
    return false;
}

static inline ang_volume *load(const char *path, ang_load_report *report) {
    ang_error err = {0};
    ang_volume *volume = ang_load(path, NULL, report, NULL, &err);
    if (!volume) print_message("%s: %s\n", path, err.message);
    assert_non_null(volume);
    return volume;
}

static inline void must_fail(const char *path, ang_code code, const char *needle) {
    ang_load_report report;
    ang_error err = {0};
    ang_volume *volume = ang_load(path, NULL, &report, NULL, &err);
    assert_null(volume);
    assert_int_equal(err.code, code);
    if (!strstr(err.message, needle)) print_message("%s\n", err.message);
    assert_non_null(strstr(err.message, needle));
    assert_null(strchr(err.message, '\n'));
    ang_load_report_clear(&report);
}

/* An empty folder of this name; each test program needs its own. */
static inline void fresh_folder(const char *folder) {
    char command[1024];
    snprintf(command, sizeof command, "rm -rf '%s' && mkdir -p '%s'", folder, folder);
    assert_int_equal(system(command), 0);
}

#endif
