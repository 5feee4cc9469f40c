/* The verb presets as scripts use it: import, export, colours, the sheet. */
#include "tests/core/fixtures.h"

#include "io/image/image_io.h"
#include "io/preset/preset.h"
#include "io/preset/preset_own.h"
#include "tests/app/program.h"

#include <string.h>
#include <unistd.h>

#define FOLDER ANG_TEST_TMP "/presets-verb"
#define OWN    FOLDER "/angioscope/presets"

static const char xml[] =
    "<MRML><VolumeProperty name='CT/A' scalarOpacity='4 100 0 300 1' colorTransfer='8 100 1 0 0 300 0 1 0'/>"
    "<VolumeProperty name='CT-B' shade='1' gradientOpacity='4 0 0 255 1' scalarOpacity='4 100 0 300 1' "
    "colorTransfer='4 100 1 1 1'/></MRML>";

static void write_file(const char *path, const char *text) {
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

static void imported_presets_are_found(void **state) {
    (void)state;
    write_file(FOLDER "/presets.xml", xml);
    expect(0, "presets import " FOLDER "/presets.xml 2>&1");
    assert_non_null(strstr(output, "CT-B: its gradient opacity, from 0 to 1, is left out"));
    assert_non_null(strstr(output, "1 mm"));
    assert_true(exists(OWN "/CT-A.json") && exists(OWN "/CT-B.json"));
    expect(0, "presets show CT-A");
    expect(0, "presets list " OWN);
    assert_non_null(strstr(output, "CT-B"));
    assert_null(strstr(output, "ct-bone"));
    assert_null(strchr(output, 27)); /* no colours: this is no terminal */
    /* Nothing is written over unless that is said. */
    expect(2, "presets import " FOLDER "/presets.xml 2>&1");
    assert_non_null(strstr(output, "--replace"));
    expect(0, "presets import --replace " FOLDER "/presets.xml CT-B -q 2>&1");
    assert_string_equal(output, "");
    expect(2, "presets import " FOLDER "/presets.xml -o " FOLDER "/x.json 2>&1");
    assert_non_null(strstr(output, "CT/A, CT-B"));
    expect(2, "presets import " FOLDER "/presets.xml CT-C 2>&1");
    expect(0, "presets import " FOLDER "/presets.xml CT-B -q -o " FOLDER "/x.json");
    ang_preset *preset = ang_preset_load(FOLDER "/x.json", NULL);
    assert_non_null(preset);
    assert_close(ang_transfer_opacity(preset->transfer, 150), 0.25, 1e-12);
    ang_preset_free(preset);
    expect(2, "presets import " FOLDER "/none.vp 2>&1");
    expect(2, "presets show " FOLDER "/presets.xml 2>&1");
    assert_non_null(strstr(output, "presets import"));
    expect(2, "presets import " ANG_PRESETS "/ct-bone.json 2>&1");
    expect(7, "presets import " FOLDER "/presets.xml CT-B -o " FOLDER "/no/x.json 2>&1");
}

static void names_are_cut_between_characters_and_kept_apart(void **state) {
    (void)state;
    char text[1024], name[64 + 8], path[1024];
    /* 62 bytes and a character of two, which does not fit. */
    memset(name, 'x', 62);
    strcpy(name + 62, "\xC3\xB6");
    snprintf(text, sizeof text,
             "<MRML><VolumeProperty name='%s' scalarOpacity='4 100 0 300 1' colorTransfer='4 100 1 1 1'/></MRML>",
             name);
    write_file(FOLDER "/long.xml", text);
    expect(0, "presets import " FOLDER "/long.xml -q 2>&1");
    snprintf(path, sizeof path, OWN "/%.62s.json", name);
    assert_true(exists(path));
    write_file(FOLDER "/twice.xml",
               "<MRML><VolumeProperty name='a/b' scalarOpacity='4 1 0 3 1' colorTransfer='4 1 1 1 1'/>"
               "<VolumeProperty name='a-b' scalarOpacity='4 1 0 3 1' colorTransfer='4 1 1 1 1'/></MRML>");
    expect(2, "presets import " FOLDER "/twice.xml 2>&1");
    assert_non_null(strstr(output, "twice.xml: two of its presets would be called \"a-b\""));
    assert_false(exists(OWN "/a-b.json"));
}

static void exported_presets_come_back(void **state) {
    (void)state;
    static const char *const endings[] = {"vp", "vp.json", "xml"};
    for (int i = 0; i < 3; i++) {
        char command[1024];
        snprintf(command, sizeof command, "presets export cta-head -q -o " FOLDER "/e.%s", endings[i]);
        expect(0, command);
        snprintf(command, sizeof command, "presets import " FOLDER "/e.%s -q -o " FOLDER "/back.json", endings[i]);
        expect(0, command);
        ang_preset *back = ang_preset_load(FOLDER "/back.json", NULL);
        ang_preset *shipped = ang_preset_load(ANG_PRESETS "/cta-head.json", NULL);
        assert_true(back && shipped && ang_transfer_same(back->transfer, shipped->transfer));
        ang_preset_free(back);
        ang_preset_free(shipped);
    }
    expect(0, "presets export cta-head ct-mip -o " FOLDER "/two.xml 2>&1");
    assert_non_null(strstr(output, "mode mip is left out"));
    expect(2, "presets export cta-head ct-mip -o " FOLDER "/two.vp 2>&1");
    assert_false(exists(FOLDER "/two.vp"));
    expect(2, "presets export cta-head 2>&1");
    expect(2, "presets export cta-head -o " FOLDER "/x.png 2>&1");
    expect(2, "presets export no-such-preset -o " FOLDER "/x.vp 2>&1");
}

/* In a terminal that script(1) makes. */
static void colours_are_for_terminals(void **state) {
    (void)state;
    if (system("script --version > /dev/null 2>&1") != 0) {
        printf("script(1) is not here: colours are not checked\n");
        return;
    }
    static const struct {
        const char *environment, *sign;
    } cases[] = {{"TERM=xterm-256color COLORTERM=truecolor", "\033[48;2;"},
                 {"TERM=xterm-256color", "\033[48;5;"},
                 {"TERM=xterm-256color COLORTERM=truecolor NO_COLOR=1", NULL},
                 {"TERM=dumb COLORTERM=truecolor", NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char command[2048];
        snprintf(command, sizeof command,
                 "env -u NO_COLOR -u COLORTERM %s script -qec '" ANG_PROGRAM " presets list " ANG_PRESETS "' /dev/null",
                 cases[i].environment);
        FILE *pipe = popen(command, "r");
        assert_non_null(pipe);
        output[fread(output, 1, sizeof output - 1, pipe)] = '\0';
        assert_int_equal(pclose(pipe), 0);
        assert_non_null(strstr(output, "cta-head"));
        if (cases[i].sign)
            assert_non_null(strstr(output, cases[i].sign));
        else
            assert_null(strchr(output, 27));
    }
}

/* Each picture of the sheet is the one that render makes. */
static void the_sheet_shows_every_preset(void **state) {
    (void)state;
    expect(0, "phantom -q --dims 48x48x12 -o " FOLDER "/series");
    expect(0, "presets sheet " FOLDER "/series -q --size 64x64 --view left --zoom 1.5 -o " FOLDER "/sheet.png");
    expect(0, "presets list " ANG_PRESETS " | tail -n +2 | cut -d' ' -f1");
    char names[8192];
    snprintf(names, sizeof names, "CT-A\nCT-B\n%.8000s", output);
    ang_image sheet;
    assert_true(ang_picture_read(FOLDER "/sheet.png", &sheet, NULL));
    int gap = 4, across = 64 + gap, down = 64 + 11 * 7 / 4 + gap, columns = (sheet.width - gap) / across, i = 0;
    for (char *name = strtok(names, "\n"); name; name = strtok(NULL, "\n"), i++) {
        char command[1024];
        snprintf(command, sizeof command,
                 "render " FOLDER "/series -q --method cpu --size 64x64 --view left --zoom 1.5 --preset %s -o " FOLDER
                 "/one.png",
                 name);
        expect(0, command);
        ang_image one;
        assert_true(ang_picture_read(FOLDER "/one.png", &one, NULL));
        for (int y = 0; y < 64; y++)
            assert_memory_equal(one.rgba + 4 * 64 * (size_t)y,
                                sheet.rgba + 4 * ((size_t)(i / columns * down + gap + y) * (size_t)sheet.width +
                                                  (size_t)(i % columns * across + gap)),
                                4 * 64 * sizeof(float));
        ang_image_clear(&one);
    }
    assert_true(i > 15 && sheet.height >= (i - 1) / columns * down + down);
    ang_image_clear(&sheet);
    expect(2, "presets sheet " FOLDER "/series 2>&1");
    expect(2, "presets sheet " FOLDER "/series -o " FOLDER "/sheet.doc 2>&1");
    expect(3, "presets sheet " FOLDER "/none -o " FOLDER "/sheet.png 2>&1");
}

/* Of the first picture: what is not black. */
static int lit(const char *path) {
    ang_image sheet;
    int count = 0;
    assert_true(ang_picture_read(path, &sheet, NULL));
    for (int y = 4; y < 4 + 64; y++)
        for (int x = 4; x < 4 + 64; x++) count += sheet.rgba[4 * ((size_t)y * (size_t)sheet.width + (size_t)x)] > 0;
    ang_image_clear(&sheet);
    return count;
}

/* A head with air around it is larger than at 1, where all of the box is in the picture however it is turned. */
static void the_sheet_fills_its_pictures(void **state) {
    (void)state;
    expect(0, "phantom -q --dims 48x48x12 -o " FOLDER "/series");
    expect(0, "presets sheet " FOLDER "/series -q --size 64x64 --view left -o " FOLDER "/large.png");
    expect(0, "presets sheet " FOLDER "/series -q --size 64x64 --view left --zoom 1 -o " FOLDER "/small.png");
    int large = lit(FOLDER "/large.png"), small = lit(FOLDER "/small.png");
    if (large <= small * 3 / 2) fail_msg("%d pixels instead of %d", large, small);
}

int main(void) {
    if (system("rm -rf " FOLDER " && mkdir -p " FOLDER) != 0) return 1;
    setenv("XDG_CONFIG_HOME", FOLDER, 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(imported_presets_are_found),
        cmocka_unit_test(names_are_cut_between_characters_and_kept_apart),
        cmocka_unit_test(exported_presets_come_back),
        cmocka_unit_test(colours_are_for_terminals),
        cmocka_unit_test(the_sheet_shows_every_preset),
        cmocka_unit_test(the_sheet_fills_its_pictures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
