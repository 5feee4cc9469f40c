/* Both themes can be read: WCAG 2.1's contrasts, over every pair of roles. */
#include "tests/core/fixtures.h"

#include "ui/toolkit/theme.h"

#include <stddef.h>
#include <string.h>

typedef struct role {
    const char *name;
    size_t at;
} role;
#define ROLE(field)                                                                                                    \
    { #field, offsetof(ang_theme, field) }

static const role areas[] = {ROLE(panel),           ROLE(raised), ROLE(control), ROLE(control_hovered),
                             ROLE(control_pressed), ROLE(chosen), ROLE(plot)};
static const role texts[] = {ROLE(text), ROLE(dim), ROLE(accent), ROLE(warning), ROLE(bad), ROLE(good)};
static const role marks[] = {ROLE(curve), ROLE(before), ROLE(ring)};
static const role boxes[] = {ROLE(box)};
static const role quiet[] = {ROLE(bars), ROLE(gap), ROLE(edge), ROLE(line), ROLE(grid), ROLE(bar_grip)};
#define COUNT(list) (sizeof(list) / sizeof *(list))
/* A role that is added is looked at too. */
_Static_assert((COUNT(areas) + COUNT(texts) + COUNT(marks) + COUNT(boxes) + COUNT(quiet)) * sizeof(ang_ink) ==
                   offsetof(ang_theme, bar_grip) + sizeof(ang_ink) - offsetof(ang_theme, panel),
               "every role is in one of the lists");

static const ang_theme *const themes[] = {&ang_theme_dark, &ang_theme_light};

static ang_ink ink_of(const ang_theme *theme, const role *role) {
    ang_ink ink;
    memcpy(&ink, (const char *)theme + role->at, sizeof ink);
    return ink;
}

/* Examples of the definition: black on white is 21; #777777 on white 4.48, #767676 the first grey that passes 4.5. */
static void contrast_is_wcags(void **state) {
    (void)state;
    const ang_ink white = ANG_INK(255, 255, 255, 255);
    assert_close(ang_ink_contrast(ANG_INK(0, 0, 0, 255), white), 21, 1e-9);
    assert_close(ang_ink_contrast(white, white), 1, 1e-12);
    assert_close(ang_ink_contrast(white, ANG_INK(0x77, 0x77, 0x77, 255)), 4.48, 0.005);
    assert_close(ang_ink_contrast(ANG_INK(0x76, 0x76, 0x76, 255), white), 4.54, 0.005);
    assert_close(ang_ink_luminance(ANG_INK(255, 0, 0, 255)), 0.2126, 1e-9);
    assert_close(ang_ink_luminance(ANG_INK(0, 255, 0, 255)), 0.7152, 1e-9);
    assert_close(ang_ink_luminance(ANG_INK(0, 0, 255, 255)), 0.0722, 1e-9);
}

static void expect_contrast(const ang_theme *theme, const role *front, const role *back, double least) {
    double contrast = ang_ink_contrast(ink_of(theme, front), ink_of(theme, back));
    if (contrast < least)
        fail_msg("%s: %s on %s has a contrast of %.2f, not %.1f", theme->name, front->name, back->name, contrast,
                 least);
}

static void every_text_can_be_read_on_every_area(void **state) {
    (void)state;
    for (size_t t = 0; t < COUNT(themes); t++)
        for (size_t area = 0; area < COUNT(areas); area++)
            for (size_t text = 0; text < COUNT(texts); text++)
                expect_contrast(themes[t], &texts[text], &areas[area], 4.5);
}

static void marks_of_plots_can_be_seen(void **state) {
    (void)state;
    const role plot = ROLE(plot), bars = ROLE(bars), before = ROLE(before);
    for (size_t t = 0; t < COUNT(themes); t++) {
        for (size_t mark = 0; mark < COUNT(marks); mark++) expect_contrast(themes[t], &marks[mark], &plot, 3);
        expect_contrast(themes[t], &marks[0], &bars, 3);
        expect_contrast(themes[t], &before, &bars, 1.5);
        expect_contrast(themes[t], &bars, &plot, 1.3);
    }
}

/* Without a tick as well; its ground is a control's, whether the pointer is on it or not. */
static void check_boxes_can_be_seen(void **state) {
    (void)state;
    const role around[] = {ROLE(panel), ROLE(raised)};
    for (size_t t = 0; t < COUNT(themes); t++)
        for (size_t area = 0; area < COUNT(around); area++) expect_contrast(themes[t], &boxes[0], &around[area], 3);
}

/* On black as they stand, and on white with their dark outline. */
static void writing_on_pictures_can_be_read(void **state) {
    (void)state;
    const ang_ink black = ANG_INK(0, 0, 0, 255);
    assert_true(ang_ink_contrast(ANG_INK_TEXT, black) >= 4.5);
    assert_true(ang_ink_contrast(ANG_INK_DIM, black) >= 4.5);
    assert_true(ang_ink_contrast(ANG_INK_ACCENT, black) >= 4.5);
}

static void every_colour_is_opaque_and_the_themes_differ(void **state) {
    (void)state;
    const role *lists[] = {areas, texts, marks, boxes, quiet};
    const size_t counts[] = {COUNT(areas), COUNT(texts), COUNT(marks), COUNT(boxes), COUNT(quiet)};
    for (int list = 0; list < 5; list++)
        for (size_t i = 0; i < counts[list]; i++) {
            ang_ink dark = ink_of(&ang_theme_dark, &lists[list][i]), light = ink_of(&ang_theme_light, &lists[list][i]);
            assert_int_equal(dark >> 24, 255);
            assert_int_equal(light >> 24, 255);
            assert_int_not_equal(dark, light);
        }
    assert_string_equal(ang_theme_dark.name, "dark");
    assert_string_equal(ang_theme_light.name, "light");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contrast_is_wcags),
        cmocka_unit_test(every_text_can_be_read_on_every_area),
        cmocka_unit_test(marks_of_plots_can_be_seen),
        cmocka_unit_test(check_boxes_can_be_seen),
        cmocka_unit_test(writing_on_pictures_can_be_read),
        cmocka_unit_test(every_colour_is_opaque_and_the_themes_differ),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
