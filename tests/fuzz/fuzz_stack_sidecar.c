/* The JSON beside a stack of pictures. */
#include "io/voxels/stack_sidecar.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    ang_stack_form form = ang_stack_form_default();
    ang_error err = {0};
    bool read = ang_stack_form_read(fuzz_file("stack.json", data, size), &form, &err);
    fuzz_expect(read || err.message[0], "refused without a reason");
    for (int i = 0; read && i < 3; i++)
        fuzz_expect(isfinite(form.spacing[i]) && isfinite(form.origin[i]), "a number that is none");
    return 0;
}
