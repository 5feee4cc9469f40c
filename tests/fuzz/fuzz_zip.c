/* Archives: nothing may be written but below the folder. */
#include "io/archive/zip.h"
#include "tests/fuzz/fuzz.h"

#include <ftw.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

extern const ang_zip_functions ang_zip_module;

static int drop(const char *path, const struct stat *status, int kind, struct FTW *walk) {
    (void)status, (void)kind;
    if (walk->level > 0) remove(path);
    return 0;
}

static int files_beside;
static int count(const char *path, const struct stat *status, int kind, struct FTW *walk) {
    (void)path, (void)status;
    files_beside += kind == FTW_F && walk->level == 1;
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char below[128];
    snprintf(below, sizeof below, "%s/below", fuzz_folder());
    mkdir(below, 0700);
    const char *path = fuzz_file("a.zip", data, size);
    ang_notes warnings = {0};
    ang_error err = {0};
    bool done = ang_zip_module.unzip(path, "a.zip", below, &warnings, NULL, &err);
    fuzz_expect(done || err.message[0], "refused without a reason");
    files_beside = 0;
    nftw(fuzz_folder(), count, 8, FTW_PHYS);
    fuzz_expect(files_beside == 1, "a file beside the folder");
    nftw(below, drop, 8, FTW_DEPTH | FTW_PHYS);
    rmdir(below);
    ang_notes_clear(&warnings);
    return 0;
}
