/* Codecs where the program has them: behind the wall, where what is wrong in them does not end the search. */
#include "io/sandbox/sandbox.h"
#include "tests/fuzz/fuzz.h"

ang_sandbox *fuzz_sandbox(void);

ang_sandbox *fuzz_sandbox(void) {
    static ang_sandbox *sandbox;
    if (!sandbox) sandbox = ang_sandbox_create(ANG_GDCM_MODULE, NULL);
    fuzz_expect(sandbox != NULL, "no sandbox");
    return sandbox;
}
