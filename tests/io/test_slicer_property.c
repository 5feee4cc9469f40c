/* Volume properties of 3D Slicer and VTK: what is read, what becomes of it, what is written, and damaged files. */
#include "tests/core/fixtures.h"

#include "io/preset/preset.h"
#include "io/preset/slicer/property.h"
#include "tests/io/shipped_presets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* As Slicer writes it: two points that stand for a step are one unit in the last place apart. */
static const char vp[] = "1\n1\n0.9\n0.1\n0.2\n10\n"
                         "8 -1000 0 100 0 100.00000000000001 0.5 300 1\n"
                         "4 0 1 255 1\n"
                         "12 -1000 0 0 0 200 1 0.5 0.25 400 1 1 1\n";

static const char xml[] =
    "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<MRML>\n<!-- <VolumeProperty name=\"no\"/> -->\n"
    " <Other name='a > b'/>\n"
    " <VolumeProperty selected=\"false\" name=\"A &amp; &#66;&#xE4;\" interpolation=\"0\" shade=\"0\" diffuse=\"1.5\""
    " gradientOpacity=\"4 0 0 255 1\" scalarOpacity=\"4 0 0 100 1\" colorTransfer=\"8 0 1 0 0 100 0 0 1\"/>\n"
    " <VolumeProperty name='second' scalarOpacity='4 100 0 0 1' colorTransfer='4 50 1 1 "
    "1'></VolumeProperty>\n</MRML>\n";

static const char json[] =
    "{\"@schema\": \"https://example.org/volume-property-schema-v1.0.0.json#\", \"volumeProperties\": [{"
    "\"isoSurfaceValues\": [300, 400], \"interpolationType\": \"linear\", \"components\": [{\"shade\": true,"
    "\"lighting\": {\"ambient\": 0.3, \"diffuse\": 0.6, \"specular\": 0.5, \"specularPower\": 40},"
    "\"scalarOpacityUnitDistance\": 2.5,"
    "\"scalarOpacity\": {\"points\": [{\"x\": 0, \"y\": 0, \"midpoint\": 0.25, \"sharpness\": 0},"
    "{\"x\": 100, \"y\": 1, \"midpoint\": 0.5, \"sharpness\": 0}]},"
    "\"gradientOpacity\": {\"points\": [{\"x\": 0, \"y\": 0, \"midpoint\": 0.5, \"sharpness\": 0}]},"
    "\"disableGradientOpacity\": true,"
    "\"rgbTransferFunction\": {\"points\": [{\"x\": 0, \"color\": [1, 0, 0], \"midpoint\": 0.5, \"sharpness\": 0}]}"
    "}]}]}";

static ang_property_list parse(ang_property_form form, const char *file, const char *text) {
    ang_property_list list;
    ang_error err = {0};
    if (!ang_property_parse(form, file, text, strlen(text), &list, &err)) fail_msg("%s", err.message);
    return list;
}

static bool says(const ang_notes *notes, const char *word) {
    for (size_t i = 0; i < notes->count; i++)
        if (strstr(notes->text[i], word)) return true;
    return false;
}

static void nine_lines_are_read(void **state) {
    (void)state;
    ang_property_list list = parse(ANG_PROPERTY_VP, "some/where/AAA.vp", vp);
    ang_notes notes = {0};
    assert_int_equal(list.count, 1);
    const ang_property *p = &list.item[0];
    assert_string_equal(p->name, "AAA");
    assert_true(p->shade && !p->nearest);
    assert_close(p->diffuse, 0.9, 0); /* before ambient: as Slicer reads it */
    assert_close(p->ambient, 0.1, 0);
    assert_close(p->specular, 0.2, 0);
    assert_close(p->power, 10, 0);
    ang_preset *preset = ang_property_to_preset(p, &notes, NULL);
    assert_non_null(preset);
    const ang_transfer *t = preset->transfer;
    /* At -1000, 100 (below and from it on), 200, 300, 400. */
    assert_int_equal(t->count, 6);
    assert_close(t->points[1].hu, 100, 0);
    assert_close(t->points[2].hu, 100, 0);
    assert_close(t->points[1].opacity, 0, 0);
    assert_close(t->points[2].opacity, 0.5, 0);
    assert_close(ang_transfer_opacity(t, 200), 0.75, 1e-12);
    assert_close(ang_transfer_opacity(t, 350), 1, 0);
    double colour[3];
    ang_transfer_colour(t, 100, colour);
    assert_close(colour[0], 1100.0 / 1200, 1e-12);
    assert_close(colour[1], 0.5 * 1100 / 1200, 1e-12);
    ang_transfer_colour(t, 300, colour);
    assert_close(colour[2], 0.625, 1e-12);
    assert_close(t->unit_distance, 1, 0);
    assert_true(says(&notes, "1 mm"));
    assert_int_equal(notes.count, 1); /* a gradient opacity of 1 is none */
    /* From where opacity begins to where it is greatest. */
    assert_close(preset->window_centre, 200, 1e-9);
    assert_close(preset->window_width, 200, 1e-9);
    ang_preset_free(preset);
    ang_notes_clear(&notes);
    ang_property_list_clear(&list);
}

static void xml_holds_several(void **state) {
    (void)state;
    ang_property_list list = parse(ANG_PROPERTY_XML, "presets.xml", xml);
    ang_notes notes = {0};
    assert_int_equal(list.count, 2);
    assert_string_equal(list.item[0].name, "A & B\xc3\xa4");
    assert_string_equal(list.item[1].name, "second");
    ang_preset *preset = ang_property_to_preset(&list.item[0], &notes, NULL);
    assert_non_null(preset);
    assert_int_equal(preset->shading, ANG_SHADING_NONE);
    assert_close(preset->phong.diffuse, 1, 0);
    assert_true(says(&notes, "gradient opacity") && says(&notes, "diffuse") && says(&notes, "interpolated"));
    ang_preset_free(preset);
    /* Out of order, and colours that end elsewhere: end values hold. */
    preset = ang_property_to_preset(&list.item[1], &notes, NULL);
    assert_non_null(preset);
    assert_close(ang_transfer_opacity(preset->transfer, 25), 0.75, 1e-12);
    double colour[3];
    ang_transfer_colour(preset->transfer, -5, colour);
    assert_close(colour[1], 1, 0);
    ang_preset_free(preset);
    ang_notes_clear(&notes);
    ang_property_list_clear(&list);
}

static void json_tells_unit_iso_and_curves(void **state) {
    (void)state;
    ang_property_list list = parse(ANG_PROPERTY_JSON, "bone.vp.json", json);
    ang_notes notes = {0};
    assert_int_equal(list.count, 1);
    assert_string_equal(list.item[0].name, "bone");
    ang_preset *preset = ang_property_to_preset(&list.item[0], &notes, NULL);
    assert_non_null(preset);
    assert_close(preset->transfer->unit_distance, 2.5, 0);
    assert_close(preset->iso_hu, 300, 0);
    assert_close(preset->phong.power, 40, 0);
    /* A midpoint of 0.25: half of the way at a quarter, two lines. */
    assert_close(ang_transfer_opacity(preset->transfer, 12.5), 0.25, 1e-3);
    assert_close(ang_transfer_opacity(preset->transfer, 25), 0.5, 1e-3);
    assert_close(ang_transfer_opacity(preset->transfer, 62.5), 0.75, 1e-3);
    assert_true(says(&notes, "iso values") && says(&notes, "midpoint"));
    assert_false(says(&notes, "gradient") || says(&notes, "1 mm"));
    ang_preset_free(preset);
    ang_notes_clear(&notes);
    ang_property_list_clear(&list);
}

/* sharpness 1 is a step at the midpoint; between it is VTK's Hermite curve, whose middle is half of the way. */
static void sharp_pieces_are_vtk_s(void **state) {
    (void)state;
    ang_property_point points[2] = {{.x = 0, .y = {0.2}, .midpoint = 0.3, .sharpness = 1}, {.x = 10, .y = {0.8}}};
    ang_property_function function = {.points = points, .count = 2, .channels = 1};
    double y[3];
    ang_property_value(&function, 2.9, false, y);
    assert_close(y[0], 0.2, 0);
    ang_property_value(&function, 3.1, false, y);
    assert_close(y[0], 0.8, 0);
    points[0].sharpness = 0.5;
    ang_property_value(&function, 3, false, y);
    assert_close(y[0], 0.5, 1e-12);
    /* s = 0.25: 0.5 * 0.5^6 = 1/128; h2 + (h3 + h4) / 2 of the Hermite base there. */
    ang_property_value(&function, 1.5, false, y);
    double s = 1.0 / 128, h = 3 * s * s - 2 * s * s * s + 0.5 * (2 * s * s * s - 3 * s * s + s);
    assert_close(y[0], 0.2 + 0.6 * h, 1e-12);
}

static void assert_same(const ang_preset *a, const ang_preset *b, double within) {
    const ang_transfer *t = a->transfer;
    assert_int_equal(a->shading, b->shading);
    assert_close(a->phong.ambient, b->phong.ambient, 0);
    assert_close(a->phong.diffuse, b->phong.diffuse, 0);
    assert_close(a->phong.specular, b->phong.specular, 0);
    assert_close(a->phong.power, b->phong.power, 0);
    double low = t->points[0].hu - 10, high = t->points[t->count - 1].hu + 10;
    for (int i = 0; i <= 5000; i++) {
        double hu = low + (high - low) * i / 5000, x[3], y[3];
        double k = ang_transfer_extinction(t, hu), l = ang_transfer_extinction(b->transfer, hu);
        double unit = b->transfer->unit_distance;
        assert_close(-expm1(-k * unit), -expm1(-l * unit), within); /* opacities as the file has them */
        ang_transfer_colour(t, hu, x);
        ang_transfer_colour(b->transfer, hu, y);
        for (int c = 0; c < 3; c++) assert_close(x[c], y[c], 1e-12);
    }
}

/* Through a file of the form and back. */
static ang_preset *around(const ang_preset *preset, ang_property_form form, const char *file, ang_notes *notes) {
    ang_property_list list = {.item = calloc(1, sizeof *list.item), .count = 1}, read;
    ang_error err = {0};
    assert_non_null(list.item);
    assert_true(ang_property_from_preset(preset, form == ANG_PROPERTY_JSON, &list.item[0], notes, &err));
    char *text = ang_property_print(form, &list, notes, &err);
    assert_non_null(text);
    if (!ang_property_parse(form, file, text, strlen(text), &read, &err)) fail_msg("%s", err.message);
    ang_preset *back = ang_property_to_preset(&read.item[0], notes, &err);
    if (!back) fail_msg("%s", err.message);
    free(text);
    ang_property_list_clear(&list);
    ang_property_list_clear(&read);
    return back;
}

static const struct {
    ang_property_form form;
    const char *file;
} forms[] = {{ANG_PROPERTY_VP, "x.vp"}, {ANG_PROPERTY_XML, "x.xml"}, {ANG_PROPERTY_JSON, "x.vp.json"}};

static void shipped_presets_come_back(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof shipped / sizeof *shipped; i++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s.json", ANG_PRESETS, shipped[i]);
        ang_preset *preset = ang_preset_load(path, NULL);
        assert_non_null(preset);
        for (size_t k = 0; k < sizeof forms / sizeof *forms; k++) {
            ang_notes notes = {0};
            ang_preset *back = around(preset, forms[k].form, forms[k].file, &notes);
            /* The points themselves: nothing was added or moved. */
            assert_true(ang_transfer_same(preset->transfer, back->transfer));
            assert_same(preset, back, 0);
            ang_preset_free(back);
            ang_notes_clear(&notes);
        }
        ang_preset_free(preset);
    }
}

/* Units other than 1 mm, extinctions, steps, and a step at 0 HU, at random. */
static void made_presets_come_back(void **state) {
    (void)state;
    uint64_t r = 7;
    for (int round = 0; round < 60; round++) {
        ang_transfer_point points[12];
        size_t count = 2 + (size_t)(random_unit(&r) * 10);
        bool by_extinction = round % 3 == 2;
        double hu = -500 + 100 * (round % 5), unit = round % 2 ? 1 : 0.2 + 4 * random_unit(&r);
        for (size_t i = 0; i < count; i++) {
            hu = i > 0 && random_unit(&r) < 0.2 ? hu : hu + 1 + floor(300 * random_unit(&r));
            if (i == 2) hu = fmax(hu, 0);
            points[i] = (ang_transfer_point){.hu = hu, .opacity = random_unit(&r)};
            if (i >= 2 && points[i].hu <= points[i - 2].hu) points[i].hu = hu += 1;
            for (int c = 0; c < 3; c++) points[i].colour[c] = random_unit(&r);
        }
        ang_preset preset = {.name = (char *)"made", .iso_hu = NAN, .phong = ang_phong_default};
        preset.transfer = ang_transfer_create(points, count, unit, by_extinction, NULL, NULL);
        assert_non_null(preset.transfer);
        for (size_t k = 0; k < sizeof forms / sizeof *forms; k++) {
            ang_notes notes = {0};
            ang_preset *back = around(&preset, forms[k].form, forms[k].file, &notes);
            bool keeps = forms[k].form == ANG_PROPERTY_JSON;
            assert_close(back->transfer->unit_distance, keeps ? unit : 1, 0);
            assert_same(&preset, back, !by_extinction && (keeps || round % 2) ? 1e-12 : 1e-3);
            ang_preset_free(back);
            ang_notes_clear(&notes);
        }
        ang_transfer_free(preset.transfer);
    }
}

static void refuse(ang_property_form form, const char *text, const char *word) {
    ang_property_list list;
    ang_error err = {0};
    if (ang_property_parse(form, "f", text, strlen(text), &list, &err)) fail_msg("read: %s", text);
    assert_int_equal(err.code, ANG_USAGE);
    assert_null(list.item);
    if (!strstr(err.message, word)) fail_msg("\"%s\" does not say %s", err.message, word);
}

static void what_is_wrong_is_said(void **state) {
    (void)state;
    refuse(ANG_PROPERTY_VP, "", "line 1");
    refuse(ANG_PROPERTY_VP, "1\n1\n0.9\nx\n0.2\n10\n", "f:4: ambient");
    refuse(ANG_PROPERTY_VP, "1\n1\n.9\n.1\n.2\n10\n4 0 0 1\n", "f:7");
    refuse(ANG_PROPERTY_VP, "1\n1\n.9\n.1\n.2\n10\n3 0 0 1\n", "2 for each point");
    refuse(ANG_PROPERTY_VP, "1\n1\n.9\n.1\n.2\n10\n99999999999 0 0 1\n", "how many");
    refuse(ANG_PROPERTY_VP, "1\n1\n.9\n.1\n.2\n10\n2 0 nan\n", "finite");
    refuse(ANG_PROPERTY_VP, "1\n1\n.9\n.1\n.2\n10\n2 0 1 1\n", "more");
    refuse(ANG_PROPERTY_XML, "<MRML></MRML>", "VolumeProperty");
    refuse(ANG_PROPERTY_XML, "<MRML>\n<VolumeProperty/>", "f:2");
    refuse(ANG_PROPERTY_XML, "<VolumeProperty name=\"a\" shade=\"x\"/>", "shade");
    refuse(ANG_PROPERTY_XML, "<VolumeProperty name=\"a", "quotes");
    refuse(ANG_PROPERTY_XML, "<VolumeProperty name=\"&bogus;\"/>", "entity");
    refuse(ANG_PROPERTY_XML, "<!DOCTYPE x [<!ENTITY a \"b\">]><VolumeProperty name=\"&a;\"/>", "document type");
    refuse(ANG_PROPERTY_JSON, "{", "f");
    refuse(ANG_PROPERTY_JSON, "{\"volumeProperties\": []}", "volumeProperties");
    refuse(ANG_PROPERTY_JSON, "{\"volumeProperties\": [{}]}", "@schema");
    ang_property_list list = parse(ANG_PROPERTY_XML, "f", "<VolumeProperty name=\"a\"/>");
    ang_error err = {0};
    assert_null(ang_property_to_preset(&list.item[0], NULL, &err));
    assert_true(strstr(err.message, "opacity") != NULL);
    ang_property_list_clear(&list);
}

/* Cut anywhere, and with any byte another one: read or refused, never worse. */
static void damaged_files_do_no_harm(void **state) {
    (void)state;
    const char *const texts[] = {vp, xml, json};
    uint64_t r = 3;
    for (size_t k = 0; k < 3; k++) {
        size_t length = strlen(texts[k]);
        char *copy = malloc(length);
        assert_non_null(copy);
        for (size_t i = 0; i < 2 * length; i++) {
            ang_property_list list;
            ang_error err = {0};
            memcpy(copy, texts[k], length);
            size_t size = i < length ? i : length;
            if (i >= length) copy[i - length] = (char)(256 * random_unit(&r));
            if (!ang_property_parse(forms[k].form, forms[k].file, copy, size, &list, &err)) {
                assert_int_equal(err.code, ANG_USAGE);
                continue;
            }
            for (size_t n = 0; n < list.count; n++) {
                ang_notes notes = {0};
                ang_preset_free(ang_property_to_preset(&list.item[n], &notes, &err));
                ang_notes_clear(&notes);
            }
            ang_property_list_clear(&list);
        }
        free(copy);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nine_lines_are_read),
        cmocka_unit_test(xml_holds_several),
        cmocka_unit_test(json_tells_unit_iso_and_curves),
        cmocka_unit_test(sharp_pieces_are_vtk_s),
        cmocka_unit_test(shipped_presets_come_back),
        cmocka_unit_test(made_presets_come_back),
        cmocka_unit_test(what_is_wrong_is_said),
        cmocka_unit_test(damaged_files_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
