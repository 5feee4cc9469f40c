/* States that pictures carry: PNG where the first byte is even, else EXR. */
#include "io/image/image_io.h"
#include "io/session/state.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size == 0) return 0;
    const char *path = fuzz_file(data[0] % 2 ? "a.exr" : "a.png", data + 1, size - 1);
    ang_error err = {0};
    char *text = ang_image_state(path, &err);
    fuzz_expect(text || (err.code != ANG_OK && err.message[0]), "no state and no reason given");
    fuzz_expect(!strchr(err.message, '\n'), "an error of more than one line");
    free(text);
    ang_state state;
    err = (ang_error){0};
    bool read = ang_state_read(path, &state, &err);
    fuzz_expect(read || err.message[0], "refused without a reason");
    if (read) ang_state_clear(&state);
    return 0;
}
