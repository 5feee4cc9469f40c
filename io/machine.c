#include "io/machine.h"

#include "io/checksum.h"
#include "io/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

/* The value of the first line "model name : VALUE" of Linux's description. */
static void read_model(FILE *file, char *name, size_t size) {
    char line[512];
    while (fgets(line, sizeof line, file)) {
        const char *colon = strchr(line, ':');
        if (!colon || strncmp(line, "model name", 10) != 0) continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(name, size, "%s", colon + 1 + strspn(colon + 1, " \t"));
        break;
    }
}

void ang_machine_processor(char *name, size_t size) {
    struct utsname system;
    snprintf(name, size, "%s", uname(&system) == 0 ? system.machine : "unknown");
    FILE *file = fopen("/proc/cpuinfo", "r");
    if (!file) return;
    read_model(file, name, size);
    fclose(file);
    ang_text_clean(name);
}

double ang_machine_load(void) {
    double load;
    return getloadavg(&load, 1) == 1 ? load : (double)NAN;
}

uint32_t ang_machine_program_checksum(void) {
    FILE *file = fopen("/proc/self/exe", "rb");
    if (!file) return 0;
    uint32_t checksum = 0;
    unsigned char bytes[1 << 16];
    size_t length;
    while ((length = fread(bytes, 1, sizeof bytes, file)) > 0) checksum = ang_checksum(checksum, bytes, length);
    fclose(file);
    return checksum;
}
