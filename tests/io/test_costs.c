/* Cost models in the cache: measured once, read again, and measured anew where the file is no good. */
#include "tests/core/fixtures.h"

#include "io/costs.h"
#include "io/json.h"
#include "io/replace.h"

#include <string.h>
#include <unistd.h>

static void assert_same(const ang_costs *a, const ang_costs *b, const char *method) {
    const ang_cost_model *left = ang_costs_of(a, method), *right = ang_costs_of(b, method);
    assert_non_null(left);
    for (int i = 0; i < ANG_COST_TERMS; i++) assert_close(left->term[i], right->term[i], 1e-12 * right->term[i]);
}

static void models_are_kept(void **state) {
    (void)state;
    char folder[] = ANG_TEST_TMP "/costs-XXXXXX";
    assert_non_null(mkdtemp(folder));
    assert_int_equal(setenv("XDG_CACHE_HOME", folder, 1), 0);
    ang_costs first, again;
    ang_costs_origin origin;
    assert_true(ang_costs_load(NULL, &first, &origin, NULL, NULL));
    assert_false(origin.cached);
    size_t without_gl = 0;
    for (size_t i = 0; ang_methods()[i]; i++) without_gl += !ang_methods()[i]->needs_gl;
    assert_int_equal(first.count, without_gl);
    assert_non_null(ang_costs_of(&first, "reference"));
    assert_non_null(ang_costs_of(&first, "cpu"));
    assert_null(ang_costs_of(&first, "envelope"));
    ang_cost_work work = {100, 1e4, 0, 0};
    for (size_t i = 0; i < first.count; i++) {
        assert_true(ang_cost_predict(&first.of[i].model, &work) > 0);
        assert_true(ang_cost_grows(&first.of[i].model));
    }
    assert_true(strncmp(origin.path, folder, strlen(folder)) == 0);
    assert_true(ang_costs_load(NULL, &again, &origin, NULL, NULL));
    assert_true(origin.cached);
    assert_int_equal(again.count, first.count);
    assert_same(&again, &first, "cpu");
    assert_same(&again, &first, "reference");

    /* A model that was dropped is measured anew, the others stay. */
    assert_false(ang_costs_forget(&origin, "envelope"));
    assert_true(ang_costs_forget(&origin, "reference"));
    assert_false(ang_costs_forget(&origin, "reference"));
    assert_true(ang_costs_load(NULL, &again, &origin, NULL, NULL));
    assert_false(origin.cached);
    assert_int_equal(again.count, first.count);
    assert_same(&again, &first, "cpu");
    assert_non_null(ang_costs_of(&again, "reference"));
    assert_true(ang_costs_load(NULL, &again, &origin, NULL, NULL));
    assert_true(origin.cached);

    /* A model that promises pictures of any size for nothing is not taken from anywhere. */
    ang_json json;
    assert_true(ang_json_open(origin.path, &json, NULL));
    cJSON *terms = cJSON_GetObjectItem(cJSON_GetArrayItem(cJSON_GetObjectItem(json.root, "methods"), 0), "terms");
    for (int i = 1; i < 3; i++) cJSON_SetNumberValue(cJSON_GetArrayItem(terms, i), 0);
    char *text = cJSON_Print(json.root);
    assert_true(ang_file_replace(origin.path, text, strlen(text), NULL));
    free(text);
    ang_json_close(&json);
    assert_true(ang_costs_load(NULL, &again, &origin, NULL, NULL));
    assert_false(origin.cached);

    static const char *const broken[] = {"", "{}", "{\"of\": \"another machine\", \"methods\": []}", "nonsense"};
    for (size_t i = 0; i < 2; i++) {
        assert_true(ang_file_replace(origin.path, broken[2 * i + 1], strlen(broken[2 * i + 1]), NULL));
        assert_true(ang_costs_load(NULL, &again, &origin, NULL, NULL));
        assert_false(origin.cached);
    }
    unlink(origin.path);
    char below[600];
    snprintf(below, sizeof below, "%s/angioscope", folder);
    rmdir(below);
    rmdir(folder);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(models_are_kept)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
