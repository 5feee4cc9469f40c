/* A DICOMDIR beside the files that it names, and others that it does not. */
#include "io/dicom/directory.h"
#include "tests/fuzz/fuzz.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_file("IM1", "no image", 8);
    fuzz_file("im2", "no image", 8);
    const char *path = fuzz_file("DICOMDIR", data, size), *folder = fuzz_folder();
    ang_dicom_directory directory = ang_dicom_read_directory(path);
    for (size_t i = 0; i < directory.count; i++)
        fuzz_expect(strncmp(directory.paths[i], folder, strlen(folder)) == 0, "a file of another folder");
    ang_dicom_directory_clear(&directory);
    fuzz_load(&path, 1);
    return 0;
}
