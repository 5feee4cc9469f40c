/* What the fuzz targets share. Each target is one file with the function that libFuzzer calls with an input. */
#ifndef ANG_TESTS_FUZZ_FUZZ_H
#define ANG_TESTS_FUZZ_FUZZ_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Writes `size` bytes to a file of this plain name in a folder of this process, in memory where the system has such a
 * place, and returns its path, valid until the process ends. The folder goes with the process. */
const char *fuzz_file(const char *name, const void *data, size_t size);
/* The folder. */
const char *fuzz_folder(void);

/* Ends the process, so that the input is kept, where `ok` is false. */
void fuzz_expect(int ok, const char *what);

/* `size` bytes as text with a NUL behind them. Free with free(). */
char *fuzz_text(const uint8_t *data, size_t size);

/* Loads the file as the program would, writes the report both ways and drops everything. */
void fuzz_load(const char *const *paths, size_t count);

#endif
