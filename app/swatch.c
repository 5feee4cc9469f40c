/* Presets as a row of colours for terminals. */
#include "app/presets.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int ang_app_colours(FILE *out) {
    const char *none = getenv("NO_COLOR"), *term = getenv("TERM"), *more = getenv("COLORTERM");
    /* NO_COLOR counts where it is not empty (no-color.org). */
    if (!isatty(fileno(out)) || (none && none[0]) || !term || strcmp(term, "dumb") == 0) return 0;
    if (more && (strcmp(more, "truecolor") == 0 || strcmp(more, "24bit") == 0)) return 1 << 24;
    if (strstr(term, "direct")) return 1 << 24;
    return strstr(term, "256color") ? 256 : 0;
}

/* The HU in which something shows: from the last point before it to the first behind it. */
static void shown_range(const ang_transfer *t, double *low, double *high) {
    *low = t->points[0].hu;
    *high = t->points[t->count - 1].hu;
    for (size_t i = 0; i + 1 < t->count; i++) {
        if (t->points[i + 1].opacity > 0) break;
        *low = t->points[i + 1].hu;
    }
    for (size_t i = t->count - 1; i > 0; i--) {
        if (t->points[i - 1].opacity > 0) break;
        *high = t->points[i - 1].hu;
    }
}

/* The nearest of the 6 x 6 x 6 cube of xterm's 256 colours. */
static int of_256(const int rgb[3]) {
    static const int levels[6] = {0, 95, 135, 175, 215, 255};
    int code = 16;
    for (int c = 0; c < 3; c++) {
        int best = 0;
        for (int i = 1; i < 6; i++)
            if (abs(levels[i] - rgb[c]) < abs(levels[best] - rgb[c])) best = i;
        code += best * (c == 0 ? 36 : c == 1 ? 6 : 1);
    }
    return code;
}

void ang_app_swatch(const ang_preset *preset, int colours, FILE *out) {
    bool values = preset->mode != ANG_MODE_DVR && preset->mode != ANG_MODE_ISO;
    double low, high;
    shown_range(preset->transfer, &low, &high);
    for (int i = 0; i < ANG_SWATCH_CELLS; i++) {
        double at = (i + 0.5) / ANG_SWATCH_CELLS, colour[3] = {at, at, at}, strength = 1;
        if (!values) {
            double hu = low + at * (high - low), opacity = ang_transfer_opacity(preset->transfer, hu);
            ang_transfer_colour(preset->transfer, hu, colour);
            strength = 0.15 + 0.85 * pow(opacity, 0.25); /* faint veils are colours too */
        }
        int rgb[3];
        for (int c = 0; c < 3; c++) rgb[c] = (int)lround(255 * strength * colour[c]);
        if (colours > 256)
            fprintf(out, "\033[48;2;%d;%d;%dm ", rgb[0], rgb[1], rgb[2]);
        else
            fprintf(out, "\033[48;5;%dm ", of_256(rgb));
    }
    fputs("\033[0m ", out);
}
