/* Lines and parts of JSON text, which are found again by walking it: the first line is the path, the rest the text. */
#include "io/json.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = fuzz_text(data, size), *rest = strchr(text, '\n');
    ang_json json;
    ang_error err = {0};
    if (rest) *rest++ = '\0';
    if (rest && ang_json_parse("a.json", rest, &json, &err)) {
        int line = ang_json_line(json.text, text);
        fuzz_expect(line >= 1 && (size_t)line <= size, "a line that is not there");
        free(ang_json_part(&json, text));
        ang_json_close(&json);
    }
    free(text);
    return 0;
}
