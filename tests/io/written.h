/* Small volumes that tests write in formats of headers and bytes: 4 x 3 x 2 voxels of the values of `expected`. Define
 * FOLDER before including this. */
#ifndef ANG_TESTS_IO_WRITTEN_H
#define ANG_TESTS_IO_WRITTEN_H

#include "tests/io/loading.h"

enum { columns = 4, rows = 3, planes = 2, voxels = columns * rows * planes };

/* Distinct, of both signs, and of both bytes. */
static inline int expected(int x, int y, int z, int phase) { return 700 * z + 90 * y + 7 * x - 500 + 1000 * phase; }

/* The values as 16 bits, of `phases` phases one after another, in either byte order. */
static inline void fill_words(uint8_t *out, int phases, bool big) {
    for (int i = 0; i < voxels * phases; i++) {
        int x = i % columns, y = i / columns % rows, z = i / (columns * rows) % planes;
        uint16_t word = (uint16_t)expected(x, y, z, i / voxels);
        out[2 * i + (big ? 1 : 0)] = (uint8_t)word;
        out[2 * i + (big ? 0 : 1)] = (uint8_t)(word >> 8);
    }
}

static inline void write_parts(const char *name, const char *text, const void *bytes, size_t size) {
    char path[1024];
    snprintf(path, sizeof path, FOLDER "/%s", name);
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fwrite(bytes, 1, size, out), size);
    fclose(out);
}

static inline void write_gzip(const char *name, const void *bytes, size_t size) {
    char path[1024];
    snprintf(path, sizeof path, FOLDER "/%s", name);
    gzFile out = gzopen(path, "wb");
    assert_int_equal(gzwrite(out, bytes, (unsigned)size), size);
    gzclose(out);
}

static inline ang_volume *load_phase(const char *path, int phase, ang_load_report *report) {
    ang_error err = {0};
    ang_load_options options = {.phase = phase};
    ang_volume *volume = ang_load(path, &options, report, NULL, &err);
    if (!volume) fail_msg("%s: %s", path, err.message);
    return volume;
}

/* Values, and, where `affine` is not NULL, where the voxels lie: three rows of four. */
static inline void expect_volume(const char *name, int phase, const double *affine) {
    char path[1024];
    ang_load_report report;
    snprintf(path, sizeof path, FOLDER "/%s", name);
    ang_volume *v = load_phase(path, phase, &report);
    assert_int_equal(v->dims[0], columns);
    assert_int_equal(v->dims[1], rows);
    assert_int_equal(v->dims[2], planes);
    for (int i = 0; i < voxels; i++) {
        int x = i % columns, y = i / columns % rows, z = i / (columns * rows);
        double value = ang_volume_hu(v, v->data[i]);
        if (fabs(value - expected(x, y, z, phase > 0 ? phase - 1 : 0)) > 1e-9)
            fail_msg("%s: voxel %d %d %d is %g", name, x, y, z, value);
    }
    for (int i = 0; affine && i < 12; i++)
        if (fabs(v->affine.m[i / 4][i % 4] - affine[i]) > 1e-6)
            fail_msg("%s: row %d, column %d of the affine is %g, not %g", name, i / 4, i % 4, v->affine.m[i / 4][i % 4],
                     affine[i]);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static inline bool told(const ang_notes *notes, const char *needle) {
    for (size_t i = 0; i < notes->count; i++)
        if (strstr(notes->text[i], needle)) return true;
    return false;
}

/* Loading says this among its warnings (or assumptions). */
static inline void expect_note(const char *name, bool warning, const char *needle) {
    char path[1024];
    ang_load_report report;
    snprintf(path, sizeof path, FOLDER "/%s", name);
    ang_volume *v = load_phase(path, 0, &report);
    if (!told(warning ? &report.warnings : &report.assumptions, needle))
        fail_msg("%s: says nothing of %s", name, needle);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

#endif
