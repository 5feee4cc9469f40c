/* What the file browser lists, and paths as text. */
#include "tests/core/fixtures.h"

#include "core/base/name_order.h"
#include "ui/state/file_list.h"

#include <stdlib.h>
#include <string.h>

static void names_are_in_the_order_that_people_expect(void **state) {
    (void)state;
    static const char *const order[] = {"", "a", "a1", "A2", "a10", "a10b", "B", "IM009", "im10", "z"};
    enum { count = sizeof order / sizeof *order };
    for (int i = 0; i < count; i++)
        for (int k = 0; k < count; k++) {
            int sign = ang_name_compare(order[i], order[k]);
            assert_int_equal((sign > 0) - (sign < 0), (i > k) - (i < k));
        }
    /* Names that differ in case or zeros alone are still two names. */
    assert_true(ang_name_compare("a", "A") != 0);
    assert_true(ang_name_compare("im1", "im01") != 0);
    assert_int_equal(ang_name_compare("999999999999999999999999", "1000000000000000000000000"), -1);
}

static void names_of_images_are_told(void **state) {
    (void)state;
    static const char *const images[] = {
        "IM0001",  "a.dcm", "A.DCM", "x.ima", "brain.nii", "brain.nii.gz", "v.hdr", "v.raw.gz", "1.2.840.113619.2.5",
        "00000012"};
    static const char *const others[] = {"notes.txt", "a.json",      "bone.vp",   "p.jpg",
                                         "x.dcm.bak", "archive.tar", "b.nii.bz2", "a."};
    for (size_t i = 0; i < sizeof images / sizeof *images; i++) assert_true(ang_name_could_be_image(images[i]));
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) assert_false(ang_name_could_be_image(others[i]));
    assert_true(ang_name_could_be_preset("bone.vp") && ang_name_could_be_preset("a.VP.json"));
    assert_true(ang_name_could_be_preset("presets.xml"));
    assert_false(ang_name_could_be_preset("bone.json") || ang_name_could_be_preset(".vp"));
}

static ang_file_list sample(void) {
    ang_file_list list = {0};
    ang_file_list_add(&list, "im10.dcm", false, 10);
    ang_file_list_add(&list, "im9.dcm", false, 9);
    ang_file_list_add(&list, "Study", true, 0);
    ang_file_list_add(&list, "readme.txt", false, 3);
    ang_file_list_add(&list, ".cache", true, 0);
    ang_file_list_add(&list, "stack", true, 0);
    ang_file_list_sort(&list);
    return list;
}

/* The names that are listed, one behind the other. */
static const char *listed(const ang_file_list *list, ang_file_filter filter, const char *typed) {
    static char text[256];
    size_t shown[16], count = ang_file_list_show(list, filter, typed, shown);
    text[0] = '\0';
    for (size_t i = 0; i < count; i++) {
        strcat(text, list->entry[shown[i]].name);
        strcat(text, " ");
    }
    return text;
}

static void lists_are_filtered_as_is_typed(void **state) {
    (void)state;
    ang_file_list list = sample();
    ang_file_filter few = {0}, all = {.all = true}, hidden = {.hidden = true};
    assert_string_equal(listed(&list, few, ""), "stack Study im9.dcm im10.dcm ");
    assert_string_equal(listed(&list, all, ""), "stack Study im9.dcm im10.dcm readme.txt ");
    assert_string_equal(listed(&list, hidden, ""), ".cache stack Study im9.dcm im10.dcm ");
    assert_string_equal(listed(&list, few, ".c"), ".cache ");
    assert_string_equal(listed(&list, few, "ST"), "stack Study ");
    assert_string_equal(listed(&list, few, "10"), "im10.dcm "); /* within, where none begins so */
    assert_string_equal(listed(&list, few, "nothing"), "");
    ang_file_list_clear(&list);
}

static void completion_goes_as_far_as_names_agree(void **state) {
    (void)state;
    static const struct {
        const char *typed, *completed;
    } cases[] = {{"im", "im"}, {"im1", "im10.dcm"}, {"stu", "Study/"}, {"sta", "stack/"}, {"no", "no"}, {"st", "st"}};
    ang_file_list list = sample();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char out[64];
        ang_file_list_complete(&list, (ang_file_filter){0}, cases[i].typed, out, sizeof out);
        assert_string_equal(out, cases[i].completed);
    }
    ang_file_list_clear(&list);
}

static void a_folder_of_images_alone_is_a_series(void **state) {
    (void)state;
    ang_file_list list = {0};
    assert_false(ang_file_list_is_series(&list));
    ang_file_list_add(&list, "notes.txt", false, 1);
    assert_false(ang_file_list_is_series(&list));
    ang_file_list_add(&list, "im1.dcm", false, 1);
    ang_file_list_add(&list, ".thumbnails", true, 0);
    assert_true(ang_file_list_is_series(&list));
    ang_file_list_add(&list, "more", true, 0);
    assert_false(ang_file_list_is_series(&list));
    ang_file_list_clear(&list);
}

static void paths_are_taken_apart(void **state) {
    (void)state;
    static const struct {
        const char *path, *above;
    } cases[] = {{"/a/b/", "/a/"}, {"/a/b", "/a/"}, {"/a/", "/"}, {"/", "/"}, {"/a//", "/"}};
    char path[64];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(path, sizeof path, "%s", cases[i].path);
        ang_path_up(path);
        assert_string_equal(path, cases[i].above);
    }
    snprintf(path, sizeof path, "/a/b//c//d/~x");
    assert_true(ang_path_restart(path));
    assert_string_equal(path, "/d/~x");
    snprintf(path, sizeof path, "/a/~/c");
    assert_true(ang_path_restart(path));
    assert_string_equal(path, "~/c");
    snprintf(path, sizeof path, "/a/b/");
    assert_false(ang_path_restart(path));
    assert_string_equal(path, "/a/b/");
    assert_int_equal(ang_path_name_at("/a/bc"), 3);
    assert_int_equal(ang_path_name_at("bc"), 0);
    ang_path_expand("~/x", "/home/me", path, sizeof path);
    assert_string_equal(path, "/home/me/x");
    ang_path_expand("~", "/home/me", path, sizeof path);
    assert_string_equal(path, "/home/me");
    ang_path_expand("~you/x", "/home/me", path, sizeof path);
    assert_string_equal(path, "~you/x");
    ang_path_expand("~/x", NULL, path, sizeof path);
    assert_string_equal(path, "~/x");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_in_the_order_that_people_expect),
        cmocka_unit_test(names_of_images_are_told),
        cmocka_unit_test(lists_are_filtered_as_is_typed),
        cmocka_unit_test(completion_goes_as_far_as_names_agree),
        cmocka_unit_test(a_folder_of_images_alone_is_a_series),
        cmocka_unit_test(paths_are_taken_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
