/* The report as its readers find it: whole, consistent, self-contained, and cheap to repeat. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
/* after them */
#include <cjson/cJSON.h>
#include <cmocka.h>
#include <glob.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/app/program.h"

#define TMP     ANG_TEST_TMP "/report-verb"
#define PHANTOM TMP "/secret-name"
#define DIR     TMP "/out"
#define SCENE   PHANTOM " --preset cta-head --size 32x32 --view 20,10"

/* A file as a string; fails where there is none. */
static char *read_file(const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file) fail_msg("there is no %s", path);
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    char *text = malloc((size_t)size + 1);
    assert_non_null(text);
    text[fread(text, 1, (size_t)size, file)] = '\0';
    fclose(file);
    return text;
}

static int make_report(void **state) {
    (void)state;
    mkdir(TMP, 0777);
    (void)!system("rm -rf " TMP "/*");
    if (run("phantom -o " PHANTOM " --dims 40x40x16 --quiet")) return -1;
    int code = run("report " SCENE " -o " DIR " --quiet 2>&1");
    if (code) print_message("report: exit code %d: %s\n", code, output);
    return code;
}

static void all_files_are_there(void **state) {
    (void)state;
    static const char *const files[] = {"report.html", "report.csv", "report.json"};
    static const char *const plots[] = {"error-max.svg", "error-p999.svg", "error-rms.svg", "orders.svg",
                                        "samples.svg"};
    char path[512];
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        snprintf(path, sizeof path, "%s/%s", DIR, files[i]);
        if (!exists(path)) fail_msg("there is no %s", path);
    }
    char *html = read_file(DIR "/report.html");
    bool without = strstr(html, "there are no plots") != NULL;
    for (size_t i = 0; i < sizeof plots / sizeof *plots; i++) {
        snprintf(path, sizeof path, "%s/%s", DIR, plots[i]);
        if (exists(path) == without) fail_msg("%s %s, and the page says otherwise", path, without ? "is" : "is not");
    }
    free(html);
}

/* Field `index` of a CSV line, into `out`. */
static void field(const char *line, int index, char out[64]) {
    bool quoted = false;
    const char *at = line;
    for (; index > 0 && *at && *at != '\n'; at++) {
        if (*at == '"') quoted = !quoted;
        if (*at == ',' && !quoted) index--;
    }
    size_t length = strcspn(at, ",\n");
    snprintf(out, 64, "%.*s", (int)length, at);
}

static int column(const char *csv, const char *name) {
    char found[64];
    for (int i = 0; i < 64; i++) {
        field(csv, i, found);
        if (strcmp(found, name) == 0) return i;
    }
    fail_msg("no column %s", name);
    return -1;
}

static int columns_of(const char *line) {
    int count = 1;
    bool quoted = false;
    for (; *line && *line != '\n'; line++) {
        if (*line == '"') quoted = !quoted;
        count += *line == ',' && !quoted;
    }
    return count;
}

static const char *next_line(const char *line) {
    const char *end = strchr(line, '\n');
    return end && end[1] ? end + 1 : NULL;
}

static void every_row_of_the_csv_is_whole(void **state) {
    (void)state;
    char *csv = read_file(DIR "/report.csv");
    int wanted = columns_of(csv), rows = 0;
    for (const char *line = csv; line; line = next_line(line), rows++) assert_int_equal(columns_of(line), wanted);
    assert_true(rows > 20);
    free(csv);
}

static void the_reference_has_no_error(void **state) {
    (void)state;
    char *csv = read_file(DIR "/report.csv"), value[64];
    const char *line = next_line(csv);
    field(line, 0, value);
    assert_string_equal(value, "reference");
    static const char *const errors[] = {"max", "p999", "rms", "flipped"};
    for (size_t i = 0; i < sizeof errors / sizeof *errors; i++) {
        field(line, column(csv, errors[i]), value);
        assert_string_equal(value, "0");
    }
    field(line, column(csv, "psnr"), value);
    assert_string_equal(value, "inf");
    free(csv);
}

static double number(const cJSON *object, const char *name) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    if (!cJSON_IsNumber(item)) fail_msg("no number %s", name);
    return item->valuedouble;
}

static const char *text_of(const cJSON *object, const char *name) {
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, name));
    return text ? text : "";
}

static cJSON *parse_report(const char *path) {
    char *text = read_file(path);
    cJSON *json = cJSON_Parse(text);
    if (!json) fail_msg("%s is no JSON", path);
    free(text);
    return json;
}

/* numerics.md: order 1.8 to 2 where the transfer function has kinks, so that halving the step takes at least 2.5 times
 * off the RMS error, over the whole range 250 times and more, until rounding. */
static void errors_fall_with_the_step(void **state) {
    (void)state;
    cJSON *json = parse_report(DIR "/report.json");
    double first = 0, last = 0, step = INFINITY;
    int count = 0;
    const cJSON *one;
    cJSON_ArrayForEach(one, cJSON_GetObjectItemCaseSensitive(json, "runs")) {
        if (strcmp(text_of(one, "method"), "singlepass") != 0 || strcmp(text_of(one, "group"), "orders") != 0) continue;
        double rms = number(one, "subset_rms");
        assert_true(number(one, "step_voxels") < step);
        step = number(one, "step_voxels");
        assert_true(number(one, "termination") == 1);
        if (count++ == 0) first = rms;
        if (count > 1 && !(rms < last)) fail_msg("step %g: RMS %g after %g", step, rms, last);
        last = rms;
    }
    assert_int_equal(count, 7);
    if (!(first > 250 * last)) fail_msg("RMS %g at first, %g at last", first, last);
    cJSON_Delete(json);
}

/* By brute force over the points that the report itself lists, the exact method among them; errors within 1 % are
 * equal.
 */
static void the_front_holds(void **state) {
    (void)state;
    cJSON *json = parse_report(DIR "/report.json");
    const cJSON *runs = cJSON_GetObjectItemCaseSensitive(json, "runs"), *a, *b;
    double exact = number(cJSON_GetObjectItemCaseSensitive(json, "reference"), "time_ms");
    int on = 0, off = 0;
    cJSON_ArrayForEach(a, runs) {
        bool twice = strcmp(text_of(a, "pixels"), "subset") == 0 && number(a, "step_voxels") >= 0.125;
        if (strcmp(text_of(a, "group"), "steps") != 0 || twice) continue;
        double time = number(cJSON_GetObjectItemCaseSensitive(a, "time_ms"), "median");
        bool beaten = exact <= time;
        double rms = number(cJSON_GetObjectItemCaseSensitive(a, "error"), "rms");
        cJSON_ArrayForEach(b, runs) {
            bool again = strcmp(text_of(b, "pixels"), "subset") == 0 && number(b, "step_voxels") >= 0.125;
            if (strcmp(text_of(b, "group"), "steps") != 0 || again) continue;
            double other_time = number(cJSON_GetObjectItemCaseSensitive(b, "time_ms"), "median");
            double other_rms = number(cJSON_GetObjectItemCaseSensitive(b, "error"), "rms");
            beaten =
                beaten || (other_time < time && other_rms <= 1.01 * rms) || (other_time <= time && other_rms < rms);
        }
        const cJSON *front = cJSON_GetObjectItemCaseSensitive(a, "front");
        bool said = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(front, "rms"));
        assert_true(said == !beaten);
        on += said;
        off += !said;
    }
    assert_true(on > 1 && off > 1);
    cJSON_Delete(json);
}

/* What `check` says of the pictures that `render` makes is what the report says of them. */
static void errors_are_those_of_render_and_check(void **state) {
    (void)state;
    expect(0, "render " SCENE " -o " TMP "/truth.pfm --method reference --quiet --background 0,0,0,0");
    expect(0, "render " SCENE " -o " TMP "/half.pfm --method singlepass --step 0.5 --quiet --background 0,0,0,0");
    run("check " TMP "/truth.pfm " TMP "/half.pfm --json 2>/dev/null");
    cJSON *check = cJSON_Parse(output), *json = parse_report(DIR "/report.json");
    assert_non_null(check);
    int found = 0;
    const cJSON *one;
    cJSON_ArrayForEach(one, cJSON_GetObjectItemCaseSensitive(json, "runs")) {
        if (strcmp(text_of(one, "method"), "singlepass") != 0 || strcmp(text_of(one, "group"), "steps") != 0 ||
            number(one, "step_voxels") != 0.5)
            continue;
        const cJSON *error = cJSON_GetObjectItemCaseSensitive(one, "error");
        /* A .pfm file has no alpha, which here never differs most by more than colour by much. */
        assert_true(number(error, "max") >= number(check, "max") - 1e-4);
        assert_true(fabs(number(error, "ssim") - number(check, "ssim")) < 1e-6);
        found++;
    }
    assert_int_equal(found, 1);
    cJSON_Delete(check);
    cJSON_Delete(json);
}

static void the_page_needs_nothing_else_and_names_nobody(void **state) {
    (void)state;
    static const char *const files[] = {DIR "/report.html", DIR "/report.json", DIR "/report.csv"};
    static const char *const secrets[] = {"secret-name", "Phantom^", "PHANTOM", "20000101", TMP};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char *text = read_file(files[i]);
        for (size_t k = 0; k < sizeof secrets / sizeof *secrets; k++)
            if (strstr(text, secrets[k])) fail_msg("%s says %s", files[i], secrets[k]);
        free(text);
    }
    char *html = read_file(files[0]);
    static const char *const foreign[] = {"http", "<script", "url(", "@import", "<link"};
    for (size_t k = 0; k < sizeof foreign / sizeof *foreign; k++)
        if (strstr(html, foreign[k])) fail_msg("the page has %s", foreign[k]);
    for (const char *at = html; (at = strstr(at, "src=")); at++)
        if (strncmp(at, "src=\"data:", 10) != 0) fail_msg("the page has %.40s", at);
    for (const char *at = html; (at = strstr(at, "href=")); at++) assert_true(at[6] == '#');
    assert_non_null(strstr(html, "@media print"));
    free(html);
}

/* Times never come out the same twice. */
static void a_repeated_report_measures_nothing(void **state) {
    (void)state;
    char *before = read_file(DIR "/report.csv");
    expect(0, "report " SCENE " -o " DIR " --quiet 2>&1");
    char *after = read_file(DIR "/report.csv");
    assert_string_equal(before, after);
    free(before);
    free(after);
}

/* What a report of one method does not show is there for the next of all. */
static void a_narrower_report_takes_no_picture_away(void **state) {
    (void)state;
    (void)!system("rm -rf " TMP "/narrow; cp -r " DIR " " TMP "/narrow");
    expect(0, "report " SCENE " -o " TMP "/narrow --method raycast --quiet 2>&1");
    expect(0, "report " SCENE " -o " TMP "/narrow --quiet 2>&1");
    int pictures[2] = {0};
    static const char *const pages[] = {DIR "/report.html", TMP "/narrow/report.html"};
    for (int i = 0; i < 2; i++) {
        char *html = read_file(pages[i]);
        for (const char *at = html; (at = strstr(at, "src=\"data:image/png")); at++) pictures[i]++;
        free(html);
    }
    assert_true(pictures[0] > 3);
    assert_int_equal(pictures[1], pictures[0]);
}

static void another_scene_is_measured_anew(void **state) {
    (void)state;
    (void)!system("rm -rf " TMP "/copy; cp -r " DIR " " TMP "/copy");
    expect(0, "report " SCENE " --shift 50 --method envelope -o " TMP "/copy --quiet 2>&1");
    char *before = read_file(DIR "/report.csv"), *after = read_file(TMP "/copy/report.csv");
    const char *a = strstr(before, "\nsteps,envelope,2,"), *b = strstr(after, "\nsteps,envelope,2,");
    assert_non_null(a);
    assert_non_null(b);
    assert_true(strncmp(a, b, 60) != 0);
    assert_null(strstr(after, "singlepass"));
    free(before);
    free(after);
}

static void what_there_is_no_time_for_is_said(void **state) {
    (void)state;
    expect(0, "report " SCENE " --size 300x300 --time-limit 0.01 -o " TMP "/short 2>&1");
    assert_non_null(strstr(output, "left out or not timed"));
    assert_non_null(strstr(output, "subset of"));
    char *html = read_file(TMP "/short/report.html");
    assert_non_null(strstr(html, "time limit leaves"));
    free(html);
    cJSON *json = parse_report(TMP "/short/report.json");
    const cJSON *reference = cJSON_GetObjectItemCaseSensitive(json, "reference");
    assert_string_equal(text_of(reference, "pixels"), "subset");
    cJSON_Delete(json);
}

static size_t count_files(const char *pattern) {
    glob_t found = {0};
    size_t count = glob(pattern, 0, NULL, &found) == 0 ? found.gl_pathc : 0;
    globfree(&found);
    return count;
}

/* Interrupts a command once there are `count` such files; its exit code. */
static int interrupt_at(const char *pattern, size_t count, const char *command) {
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", command, (char *)NULL);
        _exit(127);
    }
    for (int i = 0; i < 6000 && count_files(pattern) < count; i++) usleep(10000);
    kill(child, SIGINT);
    int status = 0;
    assert_true(waitpid(child, &status, 0) == child && WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void an_interruption_leaves_nothing_half_written(void **state) {
    (void)state;
    const char *command =
        "exec " ANG_PROGRAM " report " SCENE " --size 256x256 --method singlepass -o " TMP "/broken 2>/dev/null";
    assert_int_equal(interrupt_at(TMP "/broken/cache/*.rgba", 3, command), 130);
    assert_false(exists(TMP "/broken/report.html"));
    assert_int_equal(system("find " TMP "/broken -name '*.part' | grep -q ."), 256);
    cJSON *results = parse_report(TMP "/broken/cache/results.json");
    assert_true(cJSON_GetArraySize(results) > 0);
    cJSON_Delete(results);
}

static void bad_requests_are_refused(void **state) {
    (void)state;
    expect(2, "report " PHANTOM " 2>&1");
    assert_non_null(strstr(output, "-o DIR"));
    expect(2, "report " SCENE " -o " TMP "/never --mode lookups 2>&1");
    expect(2, "report " SCENE " -o " TMP "/never --method reference --quiet 2>&1");
    assert_non_null(strstr(output, "--method reference"));
    expect(2, "report " SCENE " -o " TMP "/never --time-limit 0 2>&1");
    expect(5, "report " SCENE " -o " TMP "/never --method envelope --backend none --quiet 2>&1");
    assert_non_null(strstr(output, "--backend none"));
    expect(7, "report " SCENE " -o " DIR "/report.csv/deeper 2>&1");
    expect(3, "report " TMP "/nothing-here -o " TMP "/never 2>&1");
    assert_false(exists(TMP "/never/report.html"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_files_are_there),
        cmocka_unit_test(every_row_of_the_csv_is_whole),
        cmocka_unit_test(the_reference_has_no_error),
        cmocka_unit_test(errors_fall_with_the_step),
        cmocka_unit_test(the_front_holds),
        cmocka_unit_test(errors_are_those_of_render_and_check),
        cmocka_unit_test(the_page_needs_nothing_else_and_names_nobody),
        cmocka_unit_test(a_repeated_report_measures_nothing),
        cmocka_unit_test(a_narrower_report_takes_no_picture_away),
        cmocka_unit_test(another_scene_is_measured_anew),
        cmocka_unit_test(what_there_is_no_time_for_is_said),
        cmocka_unit_test(an_interruption_leaves_nothing_half_written),
        cmocka_unit_test(bad_requests_are_refused),
    };
    return cmocka_run_group_tests(tests, make_report, NULL);
}
