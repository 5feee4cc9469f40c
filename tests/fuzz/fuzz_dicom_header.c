/* One DICOM file: preamble, meta header, elements, sequences, deflated data sets. */
#include "io/dicom/header.h"
#include "tests/fuzz/fuzz.h"

#include <math.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static ang_dicom_reader reader;
    ang_dicom_slice slice = {.file = 7};
    ang_error err = {0};
    const char *path = fuzz_file("a.dcm", data, size);
    ang_dicom_slice *frames = NULL;
    ang_dicom_found found = ang_dicom_header(path, "a.dcm", &reader, &slice, &frames, &err);
    fuzz_expect(found != ANG_DICOM_BROKEN || err.message[0], "broken without a reason");
    if (found == ANG_DICOM_FOUND && slice.image && !slice.refusal[0]) {
        fuzz_expect(slice.rows > 0 && slice.columns > 0, "an image without pixels");
        fuzz_expect(slice.bits_stored >= 1 && slice.bits_stored <= 16, "bits that no value has");
        fuzz_expect(!slice.has_position || isfinite(slice.position.x), "a position that is no number");
    }
    for (int i = 0; frames && i < slice.frames; i++)
        fuzz_expect(frames[i].refusal[0] || frames[i].pixel_offset <= reader.size, "a frame beyond the file");
    free(frames);
    return 0;
}
