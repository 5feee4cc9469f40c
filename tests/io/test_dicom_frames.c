/* Multi-frame images: functional groups and the fragments of frames. */
#define FOLDER  ANG_TEST_TMP "/frames"
#define SCRATCH ANG_TEST_TMP "/frames-nii"
#include "tests/io/dicom_sequences.h"

#include "tests/io/dcm2niix.h"

enum { most_frames = 8, pixels_of_frame = width * height };

/* What enhanced() writes; zero means the usual: one stack of frames at z = 0, 1, 2, ... with value 100 * (frame + 1).
 */
typedef struct enhanced_form {
    int frames, claimed, items; /* claimed, items: 0: as many as there are */
    double z[most_frames];
    bool places; /* z is given */
    const char *stack[most_frames], *intercept[most_frames], *type[most_frames];
    uint32_t temporal[most_frames], index[most_frames], in_stack[most_frames];
    const char *shared_intercept, *rescale_type, *concatenation;
    uint32_t first_frame;
    bool no_positions, implicit, short_pixels, defined_lengths;
    int instance;
    /* Encapsulated: run lengths, in so many fragments a frame. */
    int fragments;
    enum { NO_TABLE, BASIC, EXTENDED, WRONG } table;
} enhanced_form;

/* A group is a sequence of one item. */
typedef struct group {
    size_t sequence, item;
} group;

static group open_group(dicom_file *f, uint16_t tag_group, uint16_t element) {
    group g;
    g.sequence = open_sequence(f, tag_group, element);
    g.item = open_item(f);
    return g;
}

static void close_group(dicom_file *f, group g, bool defined) {
    close_length(f, g.item, 0xE00D, defined);
    close_length(f, g.sequence, 0xE0DD, defined);
}

static double place(const enhanced_form *form, int i) { return form->places ? form->z[i] : i; }

static void add_frame_groups(dicom_file *f, const enhanced_form *form, int i) {
    bool defined = form->defined_lengths;
    char text[64];
    if (form->type[i]) {
        group g = open_group(f, 0x18, 0x9329);
        add_text(f, 0x08, 0x9007, "CS", form->type[i]);
        close_group(f, g, defined);
    }
    group g = open_group(f, 0x20, 0x9111);
    if (form->stack[i]) add_text(f, 0x20, 0x9056, "SH", form->stack[i]);
    if (form->in_stack[i]) add_long(f, 0x20, 0x9057, form->in_stack[i]);
    if (form->temporal[i]) add_long(f, 0x20, 0x9128, form->temporal[i]);
    if (form->index[i]) {
        uint8_t index[8] = {7, 0, 0, 0, (uint8_t)form->index[i]};
        add(f, 0x20, 0x9157, "UL", index, 8);
    }
    close_group(f, g, defined);
    if (!form->no_positions) {
        g = open_group(f, 0x20, 0x9113);
        snprintf(text, sizeof text, "-1\\-2\\%g", place(form, i));
        add_text(f, 0x20, 0x32, "DS", text);
        close_group(f, g, defined);
    }
    if (form->intercept[i]) {
        g = open_group(f, 0x28, 0x9145);
        add_text(f, 0x28, 0x1052, "DS", form->intercept[i]);
        add_text(f, 0x28, 0x1053, "DS", "1");
        close_group(f, g, defined);
    }
}

static void add_shared(dicom_file *f, const enhanced_form *form) {
    group all = open_group(f, 0x5200, 0x9229);
    group g = open_group(f, 0x20, 0x9116);
    add_text(f, 0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0");
    close_group(f, g, form->defined_lengths);
    g = open_group(f, 0x28, 0x9110);
    add_text(f, 0x18, 0x50, "DS", "7");
    add_text(f, 0x28, 0x30, "DS", "0.5\\0.25");
    close_group(f, g, form->defined_lengths);
    g = open_group(f, 0x28, 0x9145);
    add_text(f, 0x28, 0x1052, "DS", form->shared_intercept ? form->shared_intercept : "-1024");
    add_text(f, 0x28, 0x1053, "DS", "1");
    add_text(f, 0x28, 0x1054, "LO", form->rescale_type ? form->rescale_type : "HU");
    close_group(f, g, form->defined_lengths);
    close_group(f, all, form->defined_lengths);
}

static void add_dimensions(dicom_file *f) {
    static const uint16_t pointers[2][2] = {{0x20, 0x9057}, {0x18, 0x9087}};
    size_t sequence = open_sequence(f, 0x20, 0x9222);
    for (int i = 0; i < 2; i++) {
        size_t item = open_item(f);
        uint8_t pointer[4] = {(uint8_t)pointers[i][0], (uint8_t)(pointers[i][0] >> 8), (uint8_t)pointers[i][1],
                              (uint8_t)(pointers[i][1] >> 8)};
        add(f, 0x20, 0x9165, "AT", pointer, 4);
        close_length(f, item, 0xE00D, false);
    }
    close_length(f, sequence, 0xE0DD, false);
}

static int value_of(int frame, int pixel) { return 100 * (frame + 1) + pixel; }

/* One frame in run lengths: two segments of literal bytes, high ones first; `cut` pieces of it. */
static size_t run_lengths(int frame, uint8_t out[128]) {
    memset(out, 0, 128);
    out[0] = 2;
    out[4] = 64;
    out[8] = 64 + 16;
    for (int segment = 0; segment < 2; segment++) {
        uint8_t *p = out + 64 + 16 * segment;
        *p++ = pixels_of_frame - 1;
        for (int i = 0; i < pixels_of_frame; i++) *p++ = (uint8_t)(value_of(frame, i) >> (segment ? 0 : 8));
    }
    return 96;
}

static void add_fragments(dicom_file *f, const enhanced_form *form) {
    uint8_t stream[128];
    size_t length = run_lengths(0, stream), piece = length / (size_t)form->fragments;
    uint32_t step = (uint32_t)(length + 8 * (size_t)form->fragments);
    if (form->table == EXTENDED) {
        tag(f, 0x7FE0, 0x0001);
        raw(f, "OV\0\0", 4);
        raw32(f, (uint32_t)(8 * form->frames));
        for (int i = 0; i < form->frames; i++) {
            raw32(f, (uint32_t)i * step);
            raw32(f, 0);
        }
    }
    tag(f, 0x7FE0, 0x0010);
    raw(f, "OB\0\0", 4);
    raw32(f, 0xFFFFFFFFu);
    bool basic = form->table == BASIC || form->table == WRONG;
    tag(f, 0xFFFE, 0xE000);
    raw32(f, basic ? (uint32_t)(4 * form->frames) : 0);
    for (int i = 0; basic && i < form->frames; i++)
        raw32(f, (uint32_t)i * step + (form->table == WRONG && i == 1 ? 2 : 0));
    for (int i = 0; i < form->frames; i++) {
        run_lengths(i, stream);
        for (int k = 0; k < form->fragments; k++) {
            tag(f, 0xFFFE, 0xE000);
            raw32(f, (uint32_t)piece);
            raw(f, stream + (size_t)k * piece, piece);
        }
    }
    tag(f, 0xFFFE, 0xE0DD);
    raw32(f, 0);
}

static void enhanced(const char *name, const enhanced_form *form) {
    dicom_file f = {.size = 132};
    memcpy(f.bytes + 128, "DICM", 4);
    char text[64];
    put_text(&f, 2, 0x10, "UI",
             form->fragments  ? "1.2.840.10008.1.2.5"
             : form->implicit ? "1.2.840.10008.1.2"
                              : "1.2.840.10008.1.2.1");
    implicit = form->implicit;
    add_text(&f, 8, 0x08, "CS", "ORIGINAL\\PRIMARY\\VOLUME\\NONE");
    add_text(&f, 8, 0x16, "UI", "1.2.840.10008.5.1.4.1.1.2.1");
    add_text(&f, 8, 0x60, "CS", "CT");
    add_text(&f, 0x20, 0x0E, "UI", "1.2.3.4");
    snprintf(text, sizeof text, "%d", form->instance);
    add_text(&f, 0x20, 0x13, "IS", text);
    if (form->concatenation) add_text(&f, 0x20, 0x9161, "UI", form->concatenation);
    if (form->index[0]) add_dimensions(&f);
    if (form->first_frame) add_long(&f, 0x20, 0x9228, form->first_frame);
    add_text(&f, 0x28, 0x04, "CS", "MONOCHROME2");
    snprintf(text, sizeof text, "%d", form->claimed ? form->claimed : form->frames);
    add_text(&f, 0x28, 0x08, "IS", text);
    add_word(&f, 0x28, 0x10, height);
    add_word(&f, 0x28, 0x11, width);
    add_word(&f, 0x28, 0x100, 16);
    add_word(&f, 0x28, 0x101, 16);
    add_word(&f, 0x28, 0x102, 15);
    add_word(&f, 0x28, 0x103, 0);
    add_shared(&f, form);
    int items = form->items ? form->items : form->frames;
    size_t sequence = open_sequence(&f, 0x5200, 0x9230);
    for (int i = 0; i < items; i++) {
        size_t item = open_item(&f);
        add_frame_groups(&f, form, i % most_frames);
        close_length(&f, item, 0xE00D, form->defined_lengths);
    }
    close_length(&f, sequence, 0xE0DD, form->defined_lengths);
    if (form->fragments) {
        add_fragments(&f, form);
    } else {
        uint8_t pixels[2 * pixels_of_frame * most_frames];
        size_t count = (size_t)(pixels_of_frame * form->frames);
        for (size_t i = 0; i < count; i++) {
            int value = value_of((int)i / pixels_of_frame, (int)i % pixels_of_frame);
            pixels[2 * i] = (uint8_t)value;
            pixels[2 * i + 1] = (uint8_t)(value >> 8);
        }
        add(&f, 0x7FE0, 0x10, "OW", pixels, 2 * count - (form->short_pixels ? 2 : 0));
    }
    write_small(name, &f, 0);
}

static void start(void) { fresh_folder(FOLDER); }

static ang_volume *load_one(const enhanced_form *form, ang_load_report *report) {
    start();
    enhanced("a.dcm", form);
    return load(FOLDER "/a.dcm", report);
}

/* Plane z is frame `frame`, whole. */
static void expect_plane(const ang_volume *v, int z, int frame, double intercept) {
    for (int i = 0; i < pixels_of_frame; i++)
        assert_true(fabs(hu_at(v, i % width, i / width, z) - (value_of(frame, i) + intercept)) < 1e-9);
}

static void finish(ang_volume *v, ang_load_report *report) {
    ang_volume_free(v);
    ang_load_report_clear(report);
}

static void test_frames_are_sorted_by_position(void **state) {
    (void)state;
    for (int form_of = 0; form_of < 3; form_of++) {
        enhanced_form form = {
            .frames = 4, .places = true, .z = {3, 0, 6, 9}, .implicit = form_of == 1, .defined_lengths = form_of == 2};
        ang_load_report report;
        ang_volume *v = load_one(&form, &report);
        assert_int_equal(v->dims[2], 4);
        static const int frame[] = {1, 0, 2, 3};
        for (int z = 0; z < 4; z++) expect_plane(v, z, frame[z], -1024);
        assert_float_equal(ang_volume_spacing(v, 0), 0.25, 1e-12);
        assert_float_equal(ang_volume_spacing(v, 1), 0.5, 1e-12);
        assert_float_equal(ang_volume_spacing(v, 2), 3, 1e-12);
        assert_float_equal(v->affine.m[2][3], 0, 1e-12);
        assert_int_equal(report.warnings.count, 0);
        finish(v, &report);
    }
}

static void test_own_groups_win(void **state) {
    (void)state;
    enhanced_form form = {.frames = 3, .intercept = {NULL, "-500", NULL}, .shared_intercept = "-1000"};
    ang_load_report report;
    ang_volume *v = load_one(&form, &report);
    expect_plane(v, 0, 0, -1000);
    expect_plane(v, 1, 1, -500);
    expect_plane(v, 2, 2, -1000);
    finish(v, &report);
}

static void test_stacks_are_series(void **state) {
    (void)state;
    enhanced_form form = {.frames = 5, .stack = {"1", "2", "1", "2", "1"}};
    start();
    enhanced("a.dcm", &form);
    ang_load_report report;
    ang_error err = {0};
    ang_volume *v = ang_load(FOLDER "/a.dcm", &(ang_load_options){.series = "2"}, &report, NULL, &err);
    assert_non_null(v);
    assert_int_equal(report.series_count, 2);
    assert_int_equal(report.series[0].slices, 3);
    assert_int_equal(v->dims[2], 2);
    expect_plane(v, 0, 1, -1024);
    expect_plane(v, 1, 3, -1024);
    finish(v, &report);
}

static void expect_phases(const enhanced_form *form, const char *second) {
    start();
    enhanced("a.dcm", form);
    ang_load_report report;
    ang_error err = {0};
    ang_volume *v = ang_load(FOLDER "/a.dcm", &(ang_load_options){.phase = 2}, &report, NULL, &err);
    if (!v) fail_msg("%s", err.message);
    assert_int_equal(report.series[0].phases, 2);
    assert_string_equal(ang_series_phase_text(&report.series[0], 2), second);
    assert_int_equal(v->dims[2], 2);
    expect_plane(v, 0, 0, -1024);
    expect_plane(v, 1, 2, -1024);
    finish(v, &report);
}

static void test_frames_of_several_phases(void **state) {
    (void)state;
    enhanced_form form = {.frames = 4, .places = true, .z = {0, 0, 1, 1}, .temporal = {11, 9, 11, 9}};
    expect_phases(&form, "temporal position 11");
    form.implicit = true;
    expect_phases(&form, "temporal position 11");
    form = (enhanced_form){.frames = 4, .places = true, .z = {0, 0, 1, 1}, .index = {2, 1, 2, 1}};
    expect_phases(&form, "dimension index 2");
}

static void test_two_objects_are_two_phases(void **state) {
    (void)state;
    start();
    enhanced_form form = {.frames = 3, .instance = 4};
    enhanced("a.dcm", &form);
    form = (enhanced_form){.frames = 3, .instance = 2, .shared_intercept = "-24"};
    enhanced("b.dcm", &form);
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_int_equal(report.series[0].phases, 2);
    assert_string_equal(ang_series_phase_text(&report.series[0], 1), "multi-frame object 2");
    expect_plane(v, 0, 0, -24);
    finish(v, &report);
}

static void test_concatenation_is_one_volume(void **state) {
    (void)state;
    start();
    enhanced_form form = {.frames = 3, .places = true, .z = {0, 1, 2}, .concatenation = "1.2.9"};
    enhanced("b.dcm", &form);
    form = (enhanced_form){
        .frames = 2, .places = true, .z = {3, 4}, .concatenation = "1.2.9", .first_frame = 3, .instance = 2};
    enhanced("a.dcm", &form);
    ang_load_report report;
    ang_volume *v = load(FOLDER, &report);
    assert_int_equal(report.series_count, 1);
    assert_int_equal(v->dims[2], 5);
    for (int z = 0; z < 5; z++) expect_plane(v, z, z % 3, -1024);
    finish(v, &report);
}

static void test_order_without_positions(void **state) {
    (void)state;
    enhanced_form form = {.frames = 3, .no_positions = true, .in_stack = {3, 1, 2}};
    ang_load_report report;
    ang_volume *v = load_one(&form, &report);
    static const int frame[] = {1, 2, 0};
    for (int z = 0; z < 3; z++) expect_plane(v, z, frame[z], -1024);
    assert_float_equal(ang_volume_spacing(v, 2), 7, 1e-12); /* SliceThickness: nothing better is there */
    assert_true(report.warnings.count > 0);
    finish(v, &report);
}

static void test_types_and_units(void **state) {
    (void)state;
    enhanced_form form = {.frames = 4, .type = {[3] = "ORIGINAL\\PRIMARY\\LOCALIZER\\NONE"}, .rescale_type = "US"};
    ang_load_report report;
    ang_volume *v = load_one(&form, &report);
    assert_int_equal(v->dims[2], 3);
    assert_string_equal(report.series[1].remark, "localizer");
    assert_int_equal(report.warnings.count, 1);
    assert_non_null(strstr(report.warnings.text[0], "RescaleType"));
    finish(v, &report);
}

static void test_fragments(void **state) {
    (void)state;
    for (int fragments = 1; fragments <= 3; fragments++) {
        for (int table = NO_TABLE; table <= WRONG; table++) {
            enhanced_form form = {.frames = 3, .places = true, .z = {2, 1, 0}, .fragments = fragments};
            form.table = table;
            bool sound = table == BASIC || table == EXTENDED;
            if (fragments > 1 && !sound) {
                start();
                enhanced("a.dcm", &form);
                must_fail(FOLDER "/a.dcm", ANG_INPUT, "nothing says which of its");
                continue;
            }
            ang_load_report report;
            ang_volume *v = load_one(&form, &report);
            for (int z = 0; z < 3; z++) expect_plane(v, z, 2 - z, -1024);
            assert_int_equal(report.warnings.count, table == WRONG);
            finish(v, &report);
        }
    }
}

static void test_dcm2niix_reads_the_same(void **state) {
    (void)state;
    need_dcm2niix();
    start();
    enhanced_form form = {.frames = 5, .places = true, .z = {6, 0, 3, 12, 9}, .in_stack = {3, 1, 2, 5, 4}};
    enhanced("a.dcm", &form);
    compare_dcm2niix(FOLDER, "out", "out");
}

static void test_one_frame(void **state) {
    (void)state;
    enhanced_form form = {.frames = 1};
    ang_load_report report;
    ang_volume *v = load_one(&form, &report);
    assert_int_equal(v->dims[2], 1);
    expect_plane(v, 0, 0, -1024);
    assert_float_equal(ang_volume_spacing(v, 2), 7, 1e-12);
    finish(v, &report);
}

static void test_claims_are_checked(void **state) {
    (void)state;
    start();
    enhanced_form form = {.frames = 3, .claimed = 70000};
    enhanced("a.dcm", &form);
    must_fail(FOLDER "/a.dcm", ANG_INPUT, "(0028,0008) NumberOfFrames is 70000");
    form.claimed = 60000;
    enhanced("a.dcm", &form);
    must_fail(FOLDER "/a.dcm", ANG_INPUT, "Rows x Columns x NumberOfFrames need 1800000");
    form = (enhanced_form){.frames = 3, .short_pixels = true};
    enhanced("a.dcm", &form);
    must_fail(FOLDER "/a.dcm", ANG_INPUT, "NumberOfFrames need 90");
    form = (enhanced_form){.frames = 3, .items = 2};
    enhanced("a.dcm", &form);
    must_fail(FOLDER "/a.dcm", ANG_INPUT, "has 2 items that can be read, (0028,0008) NumberOfFrames is 3");
    form.items = 5;
    enhanced("a.dcm", &form);
    must_fail(FOLDER "/a.dcm", ANG_INPUT, "has more than 3 items");
    form = (enhanced_form){.frames = 3, .fragments = 1, .claimed = 4, .items = 4};
    enhanced("a.dcm", &form);
    must_fail(FOLDER "/a.dcm", ANG_INPUT, "which of its 3 fragments belong to which of 4 frames");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frames_are_sorted_by_position),
        cmocka_unit_test(test_own_groups_win),
        cmocka_unit_test(test_stacks_are_series),
        cmocka_unit_test(test_frames_of_several_phases),
        cmocka_unit_test(test_two_objects_are_two_phases),
        cmocka_unit_test(test_concatenation_is_one_volume),
        cmocka_unit_test(test_order_without_positions),
        cmocka_unit_test(test_types_and_units),
        cmocka_unit_test(test_fragments),
        cmocka_unit_test(test_dcm2niix_reads_the_same),
        cmocka_unit_test(test_one_frame),
        cmocka_unit_test(test_claims_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
