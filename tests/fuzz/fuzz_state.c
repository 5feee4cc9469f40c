/* States of the viewer as JSON, measures among them. */
#include "io/session/state.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = fuzz_text(data, size);
    ang_error err = {0};
    ang_state state;
    bool read = ang_state_parse("/tmp/a.json", text, &state, &err);
    fuzz_expect(read || err.message[0], "refused without a reason");
    if (read) {
        char *picture = ang_state_print(&state, "0", &err);
        fuzz_expect(picture != NULL, "a state cannot be written");
        free(picture);
        cJSON *json = ang_state_json(&state, "0", "/tmp/a.json", true, &err);
        char *whole = cJSON_Print(json);
        ang_state again;
        fuzz_expect(whole && ang_state_parse("/tmp/a.json", whole, &again, &err),
                    "a state that was written is not read");
        ang_state_clear(&again);
        cJSON_free(whole);
        cJSON_Delete(json);
        ang_state_clear(&state);
    }
    ang_state_probe(fuzz_file("a.json", data, size));
    free(text);
    return 0;
}
