/* MetaImage files written here, byte by byte, against what was written. */
#define FOLDER ANG_TEST_TMP "/metaimage"
#include "tests/io/written.h"

#define HEAD "ObjectType = Image\nNDims = 3\nDimSize = 4 3 2\nElementType = MET_SHORT\nElementSpacing = 0.5 0.75 2\n"
/* The first axis runs to posterior, the second to the head, the third to the right. */
#define TURNED "TransformMatrix = 0 1 0 0 0 1 -1 0 0\nOffset = 10 20 30\nCenterOfRotation = 0 0 0\n"

static const double turned[12] = {0, 0, -2, 10, 0.5, 0, 0, 20, 0, 0.75, 0, 30};
static uint8_t little[4 * 2 * voxels], big[2 * voxels];

static int setup(void **state) {
    (void)state;
    fresh_folder(FOLDER);
    fill_words(little, 4, false);
    fill_words(big, 1, true);
    return 0;
}

static void in_one_file(void **state) {
    (void)state;
    write_parts("a.mha", HEAD TURNED "ElementDataFile = LOCAL\n", little, 2 * voxels);
    expect_volume("a.mha", 0, turned);
    write_parts("b.mha", HEAD TURNED "BinaryData = True\nElementByteOrderMSB = True\nElementDataFile = LOCAL\n", big,
                2 * voxels);
    expect_volume("b.mha", 0, turned);
    write_parts("c.mha", "NDims : 3\r\nDimSize : 4 3 2\r\nElementType : MET_SHORT\r\nElementDataFile : LOCAL\r\n",
                little, 2 * voxels);
    expect_volume("c.mha", 0, (const double[12]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
    expect_note("c.mha", true, "no ElementSpacing");
    expect_note("c.mha", true, "orientation is not known");
    write_parts("offset.mha", HEAD "TransformMatrix = 1 0 0 0 1 0 0 0 1\nElementDataFile = LOCAL\n", little,
                2 * voxels);
    expect_note("offset.mha", false, "no Offset");
    write_parts("size.mha",
                "NDims = 3\nDimSize = 4 3 2\nElementType = MET_SHORT\nElementSize = 0.5 0.75 2\n" TURNED
                "ElementDataFile = LOCAL\n",
                little, 2 * voxels);
    expect_volume("size.mha", 0, turned);
    char text[voxels * 8] = "";
    for (int i = 0; i < voxels; i++)
        snprintf(text + strlen(text), 8, "%d ", expected(i % columns, i / columns % rows, i / (columns * rows), 0));
    write_parts("t.mha", HEAD TURNED "BinaryData = False\nElementDataFile = LOCAL\n", text, strlen(text));
    expect_volume("t.mha", 0, turned);
}

static void packed(void **state) {
    (void)state;
    uint8_t zipped[1024];
    uLongf size = sizeof zipped;
    assert_int_equal(compress(zipped, &size, little, 2 * voxels), Z_OK);
    char header[1024];
    snprintf(header, sizeof header,
             HEAD TURNED "CompressedData = True\nCompressedDataSize = %lu\nElementDataFile = LOCAL\n",
             (unsigned long)size);
    write_parts("z.mha", header, zipped, size);
    expect_volume("z.mha", 0, turned);
    write_parts("z.zraw", "", zipped, size);
    write_parts("z.mhd", HEAD TURNED "CompressedData = True\nElementDataFile = z.zraw\n", "", 0);
    expect_volume("z.mhd", 0, turned);
    write_parts("cut.mha", header, zipped, size - 8);
    must_fail(FOLDER "/cut.mha", ANG_INPUT, "too few voxels");
    zipped[20] ^= 0xFF;
    write_parts("bad.mha", header, zipped, size);
    must_fail(FOLDER "/bad.mha", ANG_INPUT, "bad.mha");
}

/* HeaderSize counts from the begin of the file, where the voxels are in it too. */
static void behind_a_header_of_some_size(void **state) {
    (void)state;
    enum { begin = 400 };
    static const char head[] = HEAD TURNED "HeaderSize = 400\nElementDataFile = LOCAL\n";
    uint8_t rest[begin + 2 * voxels];
    size_t gap = begin - (sizeof head - 1);
    memset(rest, 'x', gap);
    memcpy(rest + gap, little, 2 * voxels);
    write_parts("sized.mha", head, rest, gap + 2 * voxels);
    expect_volume("sized.mha", 0, turned);
}

static void in_several_files(void **state) {
    (void)state;
    enum { plane = 2 * columns * rows };
    uint8_t headed[3 + 2 * voxels] = "abc";
    memcpy(headed + 3, little, 2 * voxels);
    write_parts("v.raw", "", headed, sizeof headed);
    write_parts("skip.mhd", HEAD TURNED "HeaderSize = 3\nElementDataFile = v.raw\n", "", 0);
    expect_volume("skip.mhd", 0, turned);
    write_parts("end.mhd", HEAD TURNED "HeaderSize = -1\nElementDataFile = v.raw\n", "", 0);
    expect_volume("end.mhd", 0, turned);
    write_parts("s1", "", little, plane);
    write_parts("s2", "", little + plane, plane);
    write_parts("list.mhd", HEAD TURNED "ElementDataFile = LIST\ns1\ns2\n", "", 0);
    expect_volume("list.mhd", 0, turned);
    write_parts("numbers.mhd", HEAD TURNED "ElementDataFile = s%d 1 2 1\n", "", 0);
    expect_volume("numbers.mhd", 0, turned);
    assert_true(ang_load_reads(FOLDER "/numbers.mhd", FOLDER "/s2"));
}

static void four_axes_are_phases(void **state) {
    (void)state;
    write_parts("4d.mha",
                "NDims = 4\nDimSize = 4 3 2 4\nElementType = MET_SHORT\nElementSpacing = 0.5 0.75 2 50\n"
                "TransformMatrix = 0 1 0 0 0 0 1 0 -1 0 0 0 0 0 0 1\nOffset = 10 20 30 100\nElementDataFile = LOCAL\n",
                little, sizeof little);
    for (int phase = 0; phase <= 4; phase++) expect_volume("4d.mha", phase, turned);
    ang_load_report report;
    ang_volume *v = load_phase(FOLDER "/4d.mha", 2, &report);
    assert_int_equal(report.series[0].phases, 4);
    assert_string_equal(ang_series_phase_text(&report.series[0], 2), "time 150");
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void intensities_are_mapped(void **state) {
    (void)state;
    write_parts("map.mha",
                HEAD TURNED "ElementToIntensityFunctionSlope = 2\nElementToIntensityFunctionOffset = -1000\n"
                            "ElementDataFile = LOCAL\n",
                little, 2 * voxels);
    ang_load_report report;
    ang_volume *v = load_phase(FOLDER "/map.mha", 0, &report);
    assert_float_equal(ang_volume_hu(v, v->data[0]), 2 * -500 - 1000, 1e-9);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

static void refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *needle;
        ang_code code;
    } cases[] = {
        {"NDims = 3\nDimSize = 65535 65535 65535\nElementType = MET_SHORT\nElementDataFile = LOCAL\n",
         "65535 x 65535 x 65535 voxels of 2 bytes (DimSize) do not fit a file", ANG_INPUT},
        {"NDims = 3\nDimSize = 65535 65535 65535\nElementType = MET_SHORT\nCompressedData = True\n"
         "ElementDataFile = LOCAL\n",
         "do not fit a file", ANG_INPUT},
        {"NDims = 3\nDimSize = 4 -3 2\nElementType = MET_SHORT\nElementDataFile = LOCAL\n", "an axis of -3", ANG_INPUT},
        {"NDims = 3\nDimSize = 4 3\n", "\"DimSize = 4 3\"", ANG_INPUT},
        {"ObjectType = Scene\nNDims = 3\n", "of type Scene", ANG_INPUT},
        {"NDims = 5\n", "5 axes", ANG_INPUT},
        {"ObjectType = Image\nDimSize = 4 3 2\n", "before NDims", ANG_INPUT},
        {HEAD "ElementNumberOfChannels = 3\n", "3 numbers in each voxel", ANG_INPUT},
        {HEAD, "no ElementDataFile", ANG_INPUT},
        {HEAD "nonsense\n", "no field", ANG_INPUT},
        {HEAD "ElementDataFile = LIST\n", "list of files is empty", ANG_INPUT},
        {HEAD "TransformMatrix = 1 0 0 2 0 0 0 0 1\nElementDataFile = LOCAL\n", "do not span", ANG_GEOMETRY}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_parts("bad.mhd", cases[i].text, "", 0);
        must_fail(FOLDER "/bad.mhd", cases[i].code, cases[i].needle);
    }
}

/* vmtk_aorta.mha: its size, spacing and flipped axes as its header, read here as text, says. */
static void real_file(void **state) {
    (void)state;
    if (!have_data()) return;
    ang_load_report report;
    ang_volume *v = load(ANG_SHARED_DATA "/volumes/vmtk_aorta.mha", &report);
    assert_string_equal(report.format, "MetaImage");
    assert_int_equal(v->dims[0], 157);
    assert_int_equal(v->dims[1], 393);
    assert_int_equal(v->dims[2], 34);
    assert_true(v->affine.m[0][0] < 0 && v->affine.m[1][1] < 0 && v->affine.m[2][2] > 0);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(in_one_file),
        cmocka_unit_test(packed),
        cmocka_unit_test(behind_a_header_of_some_size),
        cmocka_unit_test(in_several_files),
        cmocka_unit_test(four_axes_are_phases),
        cmocka_unit_test(intensities_are_mapped),
        cmocka_unit_test(refused),
        cmocka_unit_test(real_file),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
