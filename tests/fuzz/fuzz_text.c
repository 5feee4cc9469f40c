/* Text from files that goes to terminals and JSON. */
#include "io/text.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = fuzz_text(data, size), *clean = strdup(text);
    fuzz_expect(clean != NULL, "no memory");
    ang_text_clean(clean);
    fuzz_expect(strlen(clean) == strlen(text), "cleaning changes the length");
    for (const char *c = clean; *c; c++) fuzz_expect((unsigned char)*c >= ' ' && *c != 127, "a control character");
    size_t room = size ? 1 + data[0] % 64 : 1;
    char *out = malloc(room);
    fuzz_expect(out != NULL, "no memory");
    ang_text_from_latin1(text, out, room);
    ang_person_name_print(text, out, room);
    fuzz_expect(memchr(out, 0, room) != NULL, "a name without an end");
    free(out);
    free(clean);
    free(text);
    return 0;
}
