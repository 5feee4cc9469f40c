/* What the viewer remembers between runs. */
#include "io/session/preferences.h"
#include "tests/fuzz/fuzz.h"

#include <stdio.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ang_error err = {0};
    ang_preferences preferences;
    ang_preferences_read(fuzz_file("viewer.json", data, size), &preferences, &err);
    fuzz_expect(preferences.recent_count >= 0 && preferences.recent_count <= ANG_RECENT_FILES, "too many files");
    for (int i = 0; i < preferences.recent_count; i++)
        fuzz_expect(memchr(preferences.recent[i], 0, ANG_RECENT_PATH) != NULL, "a path without an end");
    fuzz_expect(preferences.split_across >= 0 && preferences.split_across <= 1, "a share that is none");
    return 0;
}
