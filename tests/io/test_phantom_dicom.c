#include "io/dicom/write.h"
#include "io/load.h"
#include "io/phantom.h"
#include "io/replace.h"

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#ifndef ANG_TEST_TMP
#define ANG_TEST_TMP "."
#endif

enum { W = 64, H = 48, D = 16 };
static char folder[512];

static void empty_folder(void) {
    DIR *dir = opendir(folder);
    for (struct dirent *entry; dir && (entry = readdir(dir));) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (entry->d_name[0] != '.') remove(path);
    }
    if (dir) closedir(dir);
    rmdir(folder);
}

static int setup(void **state) {
    (void)state;
    snprintf(folder, sizeof folder, ANG_TEST_TMP "/phantom-%ld", (long)getpid());
    return 0;
}

static int teardown(void **state) {
    (void)state;
    empty_folder();
    return 0;
}

static ang_phantom_params small(void) {
    ang_phantom_params params = ang_phantom_params_default;
    params.dims[0] = W;
    params.dims[1] = H;
    params.dims[2] = D;
    return params;
}

static void write_phantom(void) {
    ang_phantom_params params = small();
    ang_error err = {0};
    if (!ang_phantom_write(folder, &params, 0, NULL, &err)) {
#ifndef ANG_WITH_GDCM
        assert_int_equal(err.code, ANG_USAGE);
        skip();
#else
        fail_msg("%s", err.message);
#endif
    }
}

static size_t read_file(const char *name, char *buffer, size_t size) {
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t length = fread(buffer, 1, size, file);
    fclose(file);
    return length;
}

static void every_file_is_valid(void **state) {
    (void)state;
    write_phantom();
    if (system("command -v dciodvfy >/dev/null 2>&1") != 0) {
        print_message("dciodvfy (package dicom3tools) is missing: validity not checked\n");
        skip();
    }
    for (int i = 1; i <= D; i++) {
        char command[1024], line[1024];
        snprintf(command, sizeof command, "dciodvfy '%s/IM%04d.dcm' 2>&1", folder, i);
        FILE *pipe = popen(command, "r");
        assert_non_null(pipe);
        while (fgets(line, sizeof line, pipe)) {
            if (strncmp(line, "Error", 5) == 0 || strncmp(line, "Warning", 7) == 0) {
                pclose(pipe);
                fail_msg("IM%04d.dcm: %s", i, line);
            }
        }
        assert_int_equal(pclose(pipe), 0);
    }
}

static void same_volume_same_bytes(void **state) {
    (void)state;
    write_phantom();
    static char first[65536], second[65536];
    size_t a = read_file("IM0007.dcm", first, sizeof first);
    write_phantom();
    size_t b = read_file("IM0007.dcm", second, sizeof second);
    assert_true(a == b && a > 2 * W * H);
    assert_memory_equal(first, second, a);
    read_file("IM0008.dcm", second, sizeof second);
    assert_memory_not_equal(first, second, a);
}

static void truth_lies_beside(void **state) {
    (void)state;
    write_phantom();
    static char json[262144];
    size_t size = read_file("truth.json", json, sizeof json - 1);
    json[size] = '\0';
    assert_non_null(strstr(json, "\"aneurysm\""));
    assert_non_null(strstr(json, "\"stenosis\""));
    assert_non_null(strstr(json, "basilar artery"));
}

static void slices_of_another_series_stop_it(void **state) {
    (void)state;
    write_phantom();
    ang_phantom_params params = small();
    params.dims[2] = D - 1;
    ang_error err = {0};
    assert_false(ang_phantom_write(folder, &params, 0, NULL, &err));
    assert_int_equal(err.code, ANG_OUTPUT);
    assert_non_null(strstr(err.message, folder));
}

static void our_loader_reads_it_back(void **state) {
    (void)state;
    write_phantom();
    ang_phantom_params params = small();
    ang_error err = {0};
    ang_volume *made = ang_phantom_make(&params, 0, NULL, NULL, &err);
    assert_non_null(made);
    ang_load_options options = {0};
    ang_load_report report = {0};
    ang_volume *read = ang_load(folder, &options, &report, NULL, &err);
    if (!read) fail_msg("%s", err.message);
    assert_memory_equal(read->dims, made->dims, sizeof read->dims);
    for (size_t i = 0; i < ang_volume_count(made); i++) {
        double a = ang_volume_hu(made, made->data[i]), b = ang_volume_hu(read, read->data[i]);
        if (a != b) fail_msg("voxel %zu: %g HU instead of %g", i, b, a);
    }
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 4; c++) assert_true(fabs(read->affine.m[r][c] - made->affine.m[r][c]) < 1e-6);
    }
    assert_int_equal(report.slices_read, D);
    ang_volume_free(made);
    ang_volume_free(read);
    ang_load_report_clear(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_file_is_valid),      cmocka_unit_test(same_volume_same_bytes),
        cmocka_unit_test(truth_lies_beside),        cmocka_unit_test(slices_of_another_series_stop_it),
        cmocka_unit_test(our_loader_reads_it_back),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
