/* Volume properties of 3D Slicer: the first byte chooses the form. What becomes a preset can be written in every form
 * and is read again. */
#include "io/preset/slicer/property.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

static void write_again(const ang_preset *preset) {
    static const ang_property_form forms[] = {ANG_PROPERTY_VP, ANG_PROPERTY_XML, ANG_PROPERTY_JSON};
    for (int i = 0; i < 3; i++) {
        ang_error err = {0};
        ang_notes notes = {0};
        ang_property property;
        if (!ang_property_from_preset(preset, forms[i] == ANG_PROPERTY_JSON, &property, &notes, &err)) continue;
        ang_property_list list = {&property, 1}, again = {0};
        char *text = ang_property_print(forms[i], &list, &notes, &err);
        if (text) {
            bool read = ang_property_parse(forms[i], "a", text, strlen(text), &again, &err);
            fuzz_expect(read || err.code == ANG_LIMIT || strstr(err.message, "more than"), err.message);
            ang_property_list_clear(&again);
        }
        free(text);
        ang_property_clear(&property);
        ang_notes_clear(&notes);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size < 1) return 0;
    ang_property_form form = data[0] % 3 == 0   ? ANG_PROPERTY_VP
                             : data[0] % 3 == 1 ? ANG_PROPERTY_XML
                                                : ANG_PROPERTY_JSON;
    char *text = fuzz_text(data + 1, size - 1);
    ang_property_list list = {0};
    ang_error err = {0};
    if (ang_property_parse(form, "a", text, size - 1, &list, &err)) {
        for (size_t i = 0; i < list.count && i < 4; i++) {
            ang_notes notes = {0};
            ang_preset *preset = ang_property_to_preset(&list.item[i], &notes, &err);
            fuzz_expect(preset || err.message[0], "refused without a reason");
            if (preset) write_again(preset);
            ang_preset_free(preset);
            ang_notes_clear(&notes);
        }
        ang_property_list_clear(&list);
    } else {
        fuzz_expect(err.message[0] && !strchr(err.message, '\n'), "refused without a sentence");
    }
    free(text);
    return 0;
}
