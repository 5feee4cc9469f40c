#include "io/image/sheet.h"

#include "core/base/memory.h"
#include "io/font.h"
#include "io/image/encode.h"
#include "io/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Pixels. */
typedef struct grid {
    int width, height; /* of a picture */
    int gap, strip;    /* between pictures, for the name below one */
    int letters;
    size_t columns, rows;
} grid;

static const float ground = 0.11F;

static grid plan(const ang_image *first, size_t count) {
    grid g = {.width = first->width, .height = first->height};
    g.gap = g.width / 32 > 4 ? g.width / 32 : 4;
    g.letters = g.width / 16 > 11 ? g.width / 16 : 11;
    g.strip = g.letters * 7 / 4;
    double across = g.width + g.gap, down = g.height + g.strip + g.gap;
    g.columns = (size_t)ceil(sqrt((double)count * 1.5 * down / across));
    if (g.columns > count) g.columns = count;
    g.rows = (count + g.columns - 1) / g.columns;
    return g;
}

static float *pixel(const ang_image *image, size_t x, size_t y) {
    return image->rgba + 4 * (y * (size_t)image->width + x);
}

static void place(const grid *g, const ang_image *picture, size_t left, size_t top, ang_image *sheet) {
    for (size_t y = 0; y < (size_t)g->height; y++) {
        for (size_t x = 0; x < (size_t)g->width; x++) {
            float *to = pixel(sheet, left + x, top + y);
            memcpy(to, pixel(picture, x, y), 3 * sizeof *to); /* premultiplied: over black as it is */
            to[3] = 1;
        }
    }
}

#ifdef ANG_WITH_OIIO
static const float ink = 0.92F;

/* As much of the name as goes, in whole characters. */
static bool fit(const grid *g, const char *font, const char *name, char *text, size_t size) {
    int width, top, bottom;
    size_t length = strlen(name);
    snprintf(text, size, "%s", name);
    while (ang_oiio_text_size(text, g->letters, font, &width, &top, &bottom)) {
        if (width <= g->width || length == 0) return true;
        length = ang_text_cut(name, length - 1);
        snprintf(text, size, "%.*s..", (int)length, name);
    }
    return false;
}

/* Into the strip whose left top corner is (left, top). */
static bool write_name(const grid *g, const char *font, const char *name, size_t left, size_t top, float *mask,
                       ang_image *sheet) {
    char text[160];
    memset(mask, 0, (size_t)g->width * (size_t)g->strip * sizeof *mask);
    if (!name[0]) return true;
    if (!fit(g, font, name, text, sizeof text) ||
        !ang_oiio_text(mask, g->width, g->strip, g->width / 2, g->letters * 5 / 4, text, g->letters, font, 0))
        return false;
    for (size_t y = 0; y < (size_t)g->strip; y++)
        for (size_t x = 0; x < (size_t)g->width; x++)
            for (int c = 0; c < 3; c++)
                pixel(sheet, left + x, top + y)[c] += (ink - ground) * mask[y * (size_t)g->width + x];
    return true;
}
#else
static bool write_name(const grid *g, const char *font, const char *name, size_t left, size_t top, float *mask,
                       ang_image *sheet) {
    (void)g, (void)font, (void)name, (void)left, (void)top, (void)mask, (void)sheet;
    return false;
}
#endif

bool ang_image_sheet(const ang_image *pictures, const char *const *names, size_t count, ang_image *sheet,
                     ang_notes *warnings, ang_error *err) {
    grid g = plan(pictures, count);
    size_t across = (size_t)(g.width + g.gap), down = (size_t)(g.height + g.strip + g.gap);
    size_t width = g.columns * across + (size_t)g.gap, height = g.rows * down + (size_t)g.gap;
    if (width > 65535 || height > 65535)
        return ang_fail(err, ANG_LIMIT, "the sheet would have %zu x %zu pixels; use a smaller --size", width, height);
    if (!ang_image_create(sheet, (int)width, (int)height, err)) return false;
    float *mask = ang_alloc((size_t)g.width * (size_t)g.strip, sizeof *mask, "sheet", err);
    if (!mask) {
        ang_image_clear(sheet);
        return false;
    }
    for (size_t i = 0; i < width * height; i++) {
        for (int c = 0; c < 3; c++) sheet->rgba[4 * i + (size_t)c] = ground;
        sheet->rgba[4 * i + 3] = 1;
    }
    const char *font = ang_font_find();
    bool named = true;
    for (size_t i = 0; i < count; i++) {
        size_t left = i % g.columns * across + (size_t)g.gap, top = i / g.columns * down + (size_t)g.gap;
        place(&g, &pictures[i], left, top, sheet);
        named = named && font && write_name(&g, font, names[i], left, top + (size_t)g.height, mask, sheet);
    }
    free(mask);
    if (!named) ang_notes_add(warnings, "names are left out of the sheet: they need OpenImageIO and fonts-dejavu-core");
    return true;
}
