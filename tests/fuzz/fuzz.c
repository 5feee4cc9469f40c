#include "tests/fuzz/fuzz.h"

#include "io/load.h"
#include "io/report.h"
#include "io/survey.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_FILES = 16 };

static char folder[64];
static char paths[MOST_FILES][128];
static size_t path_count;

void fuzz_expect(int ok, const char *what) {
    if (ok) return;
    fprintf(stderr, "fuzz: %s\n", what);
    abort();
}

static void clean_up(void) {
    for (size_t i = 0; i < path_count; i++) unlink(paths[i]);
    rmdir(folder);
}

const char *fuzz_folder(void) {
    if (folder[0]) return folder;
    static const char *const places[] = {"/dev/shm", "/tmp"};
    for (size_t i = 0; i < 2; i++) {
        snprintf(folder, sizeof folder, "%s/angioscope-fuzz-XXXXXX", places[i]);
        if (mkdtemp(folder)) break;
        folder[0] = '\0';
    }
    fuzz_expect(folder[0] != '\0', "no folder for files");
    atexit(clean_up);
    return folder;
}

const char *fuzz_file(const char *name, const void *data, size_t size) {
    char path[sizeof *paths];
    snprintf(path, sizeof path, "%s/%s", fuzz_folder(), name);
    size_t index = 0;
    while (index < path_count && strcmp(paths[index], path) != 0) index++;
    fuzz_expect(index < MOST_FILES, "too many files");
    if (index == path_count) memcpy(paths[path_count++], path, sizeof path);
    int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    fuzz_expect(fd >= 0, "a file cannot be made");
    for (size_t done = 0; done < size;) {
        ssize_t put = write(fd, (const char *)data + done, size - done);
        fuzz_expect(put > 0, "a file cannot be written");
        done += (size_t)put;
    }
    close(fd);
    return paths[index];
}

char *fuzz_text(const uint8_t *data, size_t size) {
    char *text = malloc(size + 1);
    fuzz_expect(text != NULL, "no memory");
    memcpy(text, data, size);
    text[size] = '\0';
    return text;
}

static void listed(void *context, const ang_load_report *report) { (void)context, (void)report; }

static void looked_at(void *context, size_t index, const ang_raw_slice *middle, const ang_notes *warnings,
                      const char *refusal) {
    (void)context, (void)index, (void)middle, (void)warnings, (void)refusal;
}

void fuzz_load(const char *const *files, size_t count) {
    static FILE *nowhere;
    if (!nowhere) nowhere = fopen("/dev/null", "w");
    ang_load_options options = {.threads = 1, .no_sandbox = true};
    ang_load_report report;
    ang_error err = {0};
    ang_volume *volume = ang_load_all(files, count, &options, &report, NULL, &err);
    fuzz_expect(volume || (err.code != ANG_OK && err.message[0]), "nothing loaded and no reason given");
    fuzz_expect(!strchr(err.message, '\n'), "an error of more than one line");
    cJSON *json = ang_load_report_json(volume, &report, true);
    cJSON_Delete(json);
    ang_load_report_print(nowhere, volume, &report, true);
    if (volume) {
        fuzz_expect(volume->minimum <= volume->maximum, "a range turned over");
        ang_volume_free(volume);
    }
    ang_load_report_clear(&report);

    ang_survey_sink sink = {listed, looked_at, NULL};
    ang_survey(files, count, &options, &report, &sink, NULL, &err);
    ang_load_report_clear(&report);
}
