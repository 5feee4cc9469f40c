/* Cost models in the user's cache. */
#include "io/costs.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>
#include <string.h>

/* What measures is not linked, since reading does not call it. */
const char *ang_gl_renderer(const ang_gl *gl) { return gl ? "" : NULL; }
bool ang_costs_measure(ang_gl *gl, ang_costs *costs, const ang_progress *progress, ang_error *err) {
    (void)gl, (void)costs, (void)progress;
    return ang_fail(err, ANG_INTERRUPTED, "nothing is measured here");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ang_costs costs;
    bool read = ang_costs_read(fuzz_file("costs.json", data, size), "this machine", &costs);
    fuzz_expect(costs.count <= ANG_COSTS_MOST && (read || costs.count == 0), "models of a file that is refused");
    fuzz_expect(costs.ms >= 0 && isfinite(costs.ms), "a time that is none");
    for (size_t i = 0; i < costs.count; i++) {
        const ang_cost_model *model = &costs.of[i].model;
        fuzz_expect(memchr(costs.of[i].method, 0, sizeof costs.of[i].method) != NULL, "a name without an end");
        for (int t = 0; t < ANG_COST_TERMS; t++)
            fuzz_expect(model->term[t] >= 0 && isfinite(model->term[t]), "a cost that is none");
        fuzz_expect(ang_cost_grows(model), "pictures of any size for nothing");
    }
    return 0;
}
