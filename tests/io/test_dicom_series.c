/* Which slices make a volume, over synthetic slice records: no files. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "io/dicom/choose.h"
#include "io/dicom/terms.h"
#include "tests/io/slice_record.h"

#include <stdio.h>
#include <string.h>

/* Slices of equal thickness stand for slices with the same pixels; one below 0 for one that cannot be decoded. */
static ang_dicom_likeness same_by_tag(void *context, size_t a, size_t b, ang_error *err) {
    const ang_dicom_slice *slices = context;
    (void)err;
    if (slices[a].thickness < 0) return ANG_DICOM_FIRST_UNREADABLE;
    if (slices[b].thickness < 0) return ANG_DICOM_SECOND_UNREADABLE;
    return slices[a].thickness == slices[b].thickness ? ANG_DICOM_SAME : ANG_DICOM_DIFFERENT;
}

static ang_dicom_likeness out_of_memory(void *context, size_t a, size_t b, ang_error *err) {
    (void)context, (void)a, (void)b;
    ang_fail(err, ANG_LIMIT, "no memory");
    return ANG_DICOM_NOT_COMPARED;
}

static void test_grouping(void **state) {
    (void)state;
    ang_dicom_slice s[16];
    size_t n = 0;
    for (int i = 0; i < 5; i++) s[n++] = slice_at(5 - i, i);
    s[n] = slice_at(0, 9); /* a scout in the same series */
    s[n].row = (ang_vec3){0, 1, 0};
    s[n++].column = (ang_vec3){0, 0, -1};
    for (int i = 0; i < 3; i++) { /* another series */
        s[n] = slice_at(i, i);
        strcpy(s[n++].series_uid, "1.2.4");
    }
    s[n] = slice_at(0, 1);
    strcpy(s[n].series_uid, "1.2.5");
    strcpy(s[n++].image_type, "ORIGINAL\\PRIMARY\\LOCALIZER");
    s[n] = slice_at(6, 10); /* the vendor's fourth value does not split a volume */
    strcpy(s[n++].image_type, "ORIGINAL\\PRIMARY\\AXIAL\\ADD");
    for (size_t i = 0; i < n; i++) s[i].file = i;

    ang_dicom_groups groups;
    ang_error err = {0};
    assert_true(ang_dicom_group_slices(s, n, NULL, NULL, &groups, &err));
    assert_int_equal(groups.count, 4);
    assert_int_equal(groups.group[0].count, 6);
    assert_true(groups.group[0].loadable);
    assert_int_equal(groups.group[1].count, 1);
    assert_false(groups.group[1].loadable);
    assert_non_null(strstr(groups.group[1].remark, "localizer"));
    assert_int_equal(groups.group[2].count, 3);
    assert_false(groups.group[3].loadable);
    assert_string_equal(groups.group[3].remark, "localizer");

    size_t chosen;
    assert_true(ang_dicom_choose(s, &groups, NULL, &chosen, &err));
    assert_int_equal(chosen, 0);
    assert_true(ang_dicom_choose(s, &groups, "3", &chosen, &err));
    assert_int_equal(chosen, 2);
    assert_true(ang_dicom_choose(s, &groups, ".2.4", &chosen, &err));
    assert_int_equal(chosen, 2);
    assert_false(ang_dicom_choose(s, &groups, "4", &chosen, &err));
    assert_int_equal(err.code, ANG_INPUT);
    assert_false(ang_dicom_choose(s, &groups, "17", &chosen, &err));
    ang_dicom_groups_clear(&groups);
}

static void test_ct_wins(void **state) {
    (void)state;
    ang_dicom_slice s[9];
    for (int i = 0; i < 9; i++) {
        s[i] = slice_at(i, i);
        if (i < 6) {
            strcpy(s[i].series_uid, "1.2.1");
            strcpy(s[i].modality, "MR");
        }
    }
    ang_dicom_groups groups;
    ang_error err = {0};
    size_t chosen;
    assert_true(ang_dicom_group_slices(s, 9, NULL, NULL, &groups, &err));
    assert_true(ang_dicom_choose(s, &groups, NULL, &chosen, &err));
    assert_int_equal(groups.group[chosen].count, 3);
    ang_dicom_groups_clear(&groups);
}

static void test_lossless_wins_at_equal_size(void **state) {
    (void)state;
    ang_dicom_slice s[16];
    for (int i = 0; i < 15; i++) { /* series 1 to 5, three slices each; one slice of 1, all of 2 and 5 are lossy */
        s[i] = slice_at(i % 3, i);
        snprintf(s[i].series_uid, sizeof s[i].series_uid, "1.2.%d", i / 3 + 1);
        s[i].lossy = i == 1 || i / 3 == 1 || i / 3 == 4;
    }
    ang_dicom_groups groups;
    ang_error err = {0};
    size_t chosen;
    assert_true(ang_dicom_group_slices(s, 15, NULL, NULL, &groups, &err));
    assert_true(ang_dicom_choose(s, &groups, NULL, &chosen, &err));
    assert_int_equal(chosen, 2);
    ang_dicom_groups_clear(&groups);
    s[15] = slice_at(3, 15); /* size comes first */
    strcpy(s[15].series_uid, "1.2.5");
    assert_true(ang_dicom_group_slices(s, 16, NULL, NULL, &groups, &err));
    assert_true(ang_dicom_choose(s, &groups, NULL, &chosen, &err));
    assert_int_equal(chosen, 4);
    ang_dicom_groups_clear(&groups);
}

static void test_duplicates_and_phases(void **state) {
    (void)state;
    ang_dicom_slice s[8];
    for (int i = 0; i < 8; i++) {
        s[i] = slice_at(i % 4 + (i >= 4 ? 5e-4 : 0), i);
        s[i].thickness = i % 4;
        s[i].file = (size_t)i;
    }
    ang_dicom_groups groups;
    ang_error err = {0};
    assert_true(ang_dicom_group_slices(s, 8, same_by_tag, s, &groups, &err));
    assert_int_equal(groups.count, 1);
    assert_int_equal(groups.group[0].count, 4);
    assert_int_equal(groups.group[0].duplicates, 4);
    ang_dicom_groups_clear(&groups);

    for (int i = 0; i < 8; i++) { /* other pixels, and an acquisition time that tells them apart */
        s[i].thickness = i;
        snprintf(s[i].acquisition_time, sizeof s[i].acquisition_time, "1200%02d", i >= 4 ? 30 : 0);
        s[i].instance_number = 100 - i;
    }
    assert_true(ang_dicom_group_slices(s, 8, same_by_tag, s, &groups, &err));
    assert_int_equal(groups.count, 2);
    for (size_t g = 0; g < 2; g++) {
        assert_int_equal(groups.group[g].count, 4);
        assert_int_equal(groups.group[g].phases, 2);
        bool late = groups.group[g].order[0] >= 4;
        for (int i = 0; i < 4; i++) assert_int_equal(groups.group[g].order[i] >= 4, late);
    }
    ang_dicom_groups_clear(&groups);

    for (int i = 0; i < 8; i++) s[i].acquisition_time[0] = 0; /* nothing tells: by instance number */
    assert_true(ang_dicom_group_slices(s, 8, same_by_tag, s, &groups, &err));
    assert_int_equal(groups.count, 2);
    assert_int_equal(groups.group[0].count, 4);
    ang_dicom_groups_clear(&groups);
}

static void test_unreadable_doubles(void **state) {
    (void)state;
    ang_dicom_slice s[9];
    for (int i = 0; i < 9; i++) { /* three positions, three slices each: bad, good, bad; then good, bad, good again */
        s[i] = slice_at(i / 3, i);
        s[i].file = (size_t)i;
        s[i].thickness = i / 3 == 0 ? (i % 3 == 1 ? 1 : -1) : i % 3 == 1 ? -1 : 1;
    }
    ang_dicom_groups groups;
    ang_error err = {0};
    assert_true(ang_dicom_group_slices(s, 9, same_by_tag, s, &groups, &err));
    assert_int_equal(groups.count, 1);
    assert_int_equal(groups.group[0].count, 3);
    assert_int_equal(groups.group[0].phases, 1);
    assert_int_equal(groups.group[0].duplicates, 2);
    size_t expected[] = {1, 3, 6};
    assert_memory_equal(groups.group[0].order, expected, sizeof expected);
    ang_dicom_groups_clear(&groups);
    s[0].thickness = s[1].thickness = s[2].thickness = -1; /* none can be read: one is left for the decoder to report */
    assert_true(ang_dicom_group_slices(s, 9, same_by_tag, s, &groups, &err));
    assert_int_equal(groups.count, 1);
    assert_int_equal(groups.group[0].count, 3);
    ang_dicom_groups_clear(&groups);
    assert_false(ang_dicom_group_slices(s, 9, out_of_memory, s, &groups, &err));
    assert_int_equal(err.code, ANG_LIMIT);
    assert_int_equal(groups.count, 0);
}

static void test_phases_without_orientation(void **state) {
    (void)state;
    ang_dicom_slice s[8];
    for (int i = 0; i < 8; i++) {
        s[i] = slice_at(i % 4, i);
        s[i].thickness = i;
        s[i].has_orientation = false;
        s[i].row = s[i].column = (ang_vec3){0, 0, 0};
    }
    ang_dicom_groups groups;
    ang_error err = {0};
    assert_true(ang_dicom_group_slices(s, 8, same_by_tag, s, &groups, &err));
    assert_int_equal(groups.count, 2);
    assert_int_equal(groups.group[0].phases, 2);
    assert_int_equal(groups.group[0].count, 4);
    ang_dicom_groups_clear(&groups);
}

static void test_doubles_without_positions(void **state) {
    (void)state;
    ang_dicom_slice s[5];
    for (int i = 0; i < 5; i++) { /* instances 0, 1, 2, 1, 2: one double with the same pixels, one with other pixels */
        s[i] = slice_at(0, i < 3 ? i : i - 2);
        s[i].has_position = false;
        s[i].thickness = i == 4 ? 9 : s[i].instance_number;
    }
    ang_dicom_groups groups;
    ang_error err = {0};
    assert_true(ang_dicom_group_slices(s, 5, same_by_tag, s, &groups, &err));
    assert_int_equal(groups.count, 1);
    assert_int_equal(groups.group[0].count, 4);
    assert_int_equal(groups.group[0].duplicates, 1);
    ang_dicom_groups_clear(&groups);
    for (int i = 0; i < 5; i++) s[i].has_instance_number = false; /* nothing says that these are doubles */
    for (int i = 0; i < 5; i++) s[i].thickness = 1;
    assert_true(ang_dicom_group_slices(s, 5, same_by_tag, s, &groups, &err));
    assert_int_equal(groups.group[0].count, 5);
    ang_dicom_groups_clear(&groups);
}

/* `count` slices from `z` mm on, `step` apart, of one acquisition. */
static size_t add_stack(ang_dicom_slice *s, size_t n, int count, double z, double step, int acquisition) {
    for (int i = 0; i < count; i++, n++) {
        s[n] = slice_at(z + step * i, (int)n);
        s[n].has_acquisition_number = true;
        s[n].acquisition_number = acquisition;
        snprintf(s[n].acquisition_time, sizeof s[n].acquisition_time, "10%02d00", acquisition % 60);
        s[n].file = n;
    }
    return n;
}

static ang_dicom_groups grouped(const ang_dicom_slice *s, size_t count) {
    ang_dicom_groups groups;
    ang_error err = {0};
    assert_true(ang_dicom_group_slices(s, count, NULL, NULL, &groups, &err));
    return groups;
}

static void expect_volumes(const ang_dicom_slice *s, size_t n, size_t first, size_t second, const char *remark) {
    ang_dicom_groups groups = grouped(s, n);
    assert_int_equal(groups.count, second ? 2 : 1);
    assert_int_equal(groups.group[0].count, first);
    if (second) {
        assert_int_equal(groups.group[1].count, second);
        assert_string_equal(groups.group[1].remark, remark);
        for (size_t i = 1; i < second; i++)
            assert_true(s[groups.group[1].order[i]].position.z > s[groups.group[1].order[i - 1]].position.z);
    }
    ang_dicom_groups_clear(&groups);
}

static void test_acquisitions_are_told_apart(void **state) {
    (void)state;
    static const char remark[] = "one of 2 acquisitions in its series";
    ang_dicom_slice s[64];
    size_t n = add_stack(s, 0, 10, 0, 1, 1); /* interleaved */
    n = add_stack(s, n, 10, 0.5, 1, 2);
    expect_volumes(s, n, 10, 10, remark);
    for (size_t i = 0; i < n; i++) strcpy(s[i].modality, "MR"); /* even slices after odd ones: one volume */
    expect_volumes(s, n, 20, 0, NULL);
    n = add_stack(s, 0, 10, 0, 1, 1); /* overlapping */
    n = add_stack(s, n, 9, 5.3, 1, 2);
    expect_volumes(s, n, 10, 9, remark);
    for (size_t i = 0; i < n; i++) s[i].has_acquisition_number = false; /* told by time alone */
    expect_volumes(s, n, 10, 9, remark);
    n = add_stack(s, 0, 10, 0, 1, 1); /* far apart, or with another spacing */
    n = add_stack(s, n, 9, 309, 1, 2);
    expect_volumes(s, n, 10, 9, remark);
    n = add_stack(s, 0, 10, 0, 1, 1);
    n = add_stack(s, n, 9, 10, 3, 2);
    expect_volumes(s, n, 10, 9, remark);
}

static void test_slabs_of_one_scan_stay_together(void **state) {
    (void)state;
    ang_dicom_slice s[64];
    size_t n = 0;
    for (int k = 0; k < 6; k++) n = add_stack(s, n, 4, 4 * k, 1, k + 1); /* step and shoot */
    expect_volumes(s, n, 24, 0, NULL);
    memmove(s + 4, s + 5, (n - 5) * sizeof *s); /* a slab has lost its first slice */
    expect_volumes(s, n - 1, 23, 0, NULL);
    n = 0;
    for (int k = 0; k < 20; k++) n = add_stack(s, n, 1, k < 10 ? k : 1.7 * k, 1, k + 1); /* a number for every slice */
    expect_volumes(s, n, 20, 0, NULL);
    n = add_stack(s, 0, 20, 0, 1, 1);
    for (size_t i = 0; i < n; i++) { /* written as they got ready, by two machines */
        s[i].has_acquisition_number = false;
        s[i].acquisition_time[0] = 0;
        snprintf(s[i].content_time, sizeof s[i].content_time, "1000%02d", (int)(i % 2));
    }
    expect_volumes(s, n, 20, 0, NULL);
}

static void test_far_stacks_are_split(void **state) {
    (void)state;
    ang_dicom_slice s[64];
    size_t n = add_stack(s, 0, 10, 0, 1, 1); /* 29 missing between 19 slices: nothing else tells them apart */
    n = add_stack(s, n, 9, 39, 1, 1);
    expect_volumes(s, n, 10, 9, "one of 2 stacks far apart in its series");
    n = add_stack(s, 0, 10, 0, 1, 1); /* 9 missing */
    n = add_stack(s, n, 9, 19, 1, 1);
    expect_volumes(s, n, 19, 0, NULL);
    n = add_stack(s, 0, 10, 0, 1, 1);
    n = add_stack(s, n, 1, 90, 1, 1);
    expect_volumes(s, n, 10, 1, "a single slice far from the others of its series");
}

static void test_a_slice_sent_again(void **state) {
    (void)state;
    ang_dicom_slice s[8];
    for (int i = 0; i < 6; i++) { /* the last at the place of the third, with other pixels */
        s[i] = slice_at(i < 5 ? i : 2, i);
        s[i].thickness = i;
        s[i].file = (size_t)i;
    }
    ang_dicom_groups groups;
    ang_error err = {0};
    assert_true(ang_dicom_group_slices(s, 6, same_by_tag, s, &groups, &err));
    assert_int_equal(groups.count, 2);
    assert_string_equal(groups.group[1].remark, "another slice at the same position as one of its series");
    assert_false(groups.group[1].loadable);
    ang_dicom_groups_clear(&groups);
}

static void test_terms(void **state) {
    (void)state;
    assert_string_equal(ang_dicom_modality("CT"), "CT");
    assert_string_equal(ang_dicom_modality("XC"), "XC");
    assert_string_equal(ang_dicom_modality("DOE^JOHN"), "other");
    assert_string_equal(ang_dicom_image_kind("LOCALIZER"), "LOCALIZER");
    assert_string_equal(ang_dicom_image_kind("DOE^JOHN"), "other");
    assert_string_equal(ang_dicom_class_name("1.2.840.10008.5.1.4.1.1.104.1"), "Encapsulated PDF");
    assert_string_equal(ang_dicom_class_name("1.2.840.10008.5.1.4.1.1.19650101"), "other");
    assert_true(ang_dicom_is_transfer_syntax("1.2.840.10008.1.2"));
    assert_true(ang_dicom_is_transfer_syntax("1.2.840.10008.1.2.4.106.1"));
    assert_false(ang_dicom_is_transfer_syntax("1.2.840.10008.1.2.19650101"));
    assert_false(ang_dicom_is_transfer_syntax("1.2.840.10008.1.2 DOE"));
    assert_false(ang_dicom_is_transfer_syntax(""));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_grouping),
        cmocka_unit_test(test_ct_wins),
        cmocka_unit_test(test_lossless_wins_at_equal_size),
        cmocka_unit_test(test_duplicates_and_phases),
        cmocka_unit_test(test_unreadable_doubles),
        cmocka_unit_test(test_phases_without_orientation),
        cmocka_unit_test(test_doubles_without_positions),
        cmocka_unit_test(test_acquisitions_are_told_apart),
        cmocka_unit_test(test_slabs_of_one_scan_stay_together),
        cmocka_unit_test(test_far_stacks_are_split),
        cmocka_unit_test(test_a_slice_sent_again),
        cmocka_unit_test(test_terms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
