/* Presets as JSON. What was read and written again must read as the same. */
#include "io/preset/preset.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = fuzz_text(data, size);
    ang_error err = {0};
    ang_preset *preset = ang_preset_parse("a.json", text, &err);
    fuzz_expect(preset || err.message[0], "refused without a reason");
    if (preset) {
        char *once = ang_preset_print(preset, &err);
        ang_preset *again = once ? ang_preset_parse("a.json", once, &err) : NULL;
        fuzz_expect(again != NULL, "a preset that was written is not read");
        char *twice = ang_preset_print(again, &err);
        fuzz_expect(twice && strcmp(once, twice) == 0, "a preset changes as it is written and read");
        free(once);
        free(twice);
        ang_preset_free(again);
        ang_preset_free(preset);
    }
    free(text);
    return 0;
}
