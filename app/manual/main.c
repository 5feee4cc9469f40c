/* angioscope_manual FORM FILE: writes the manual page or the completion of a shell when Angioscope is built. */
#include "app/manual/manual.h"

#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
    static const struct {
        const char *name;
        void (*print)(FILE *out);
    } forms[] = {
        {"man", ang_manual_man}, {"bash", ang_manual_bash}, {"zsh", ang_manual_zsh}, {"fish", ang_manual_fish}};
    for (size_t i = 0; argc == 3 && i < sizeof forms / sizeof *forms; i++) {
        if (strcmp(argv[1], forms[i].name) != 0) continue;
        FILE *out = fopen(argv[2], "w");
        if (out) forms[i].print(out);
        bool good = out && !ferror(out);
        if (out && fclose(out) != 0) good = false;
        if (!good) fprintf(stderr, "angioscope_manual: %s cannot be written\n", argv[2]);
        return good ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    fputs("Usage: angioscope_manual man|bash|zsh|fish FILE\n", stderr);
    return EXIT_FAILURE;
}
