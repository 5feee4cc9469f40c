#include "io/image/annotate.h"

#include "core/base/memory.h"
#include "io/font.h"
#include "io/image/encode.h"
#include "io/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Coverages of what is drawn, and where it goes. */
typedef struct sheet {
    int width, height;
    float *mask;
    const char *font;
    int size;   /* of letters, pixels */
    int margin; /* from the picture's edges, pixels */
} sheet;

#ifdef ANG_WITH_OIIO
#define FONT_LACKS "the font DejaVuSans.ttf is missing; install fonts-dejavu-core"
#else
#define FONT_LACKS "this build has no OpenImageIO"
#endif

static bool text_extent(const sheet *sheet, const char *text, int size, int *width, int *top, int *bottom) {
    *width = *top = *bottom = 0;
#ifdef ANG_WITH_OIIO
    return *text && ang_oiio_text_size(text, size, sheet->font, width, top, bottom);
#else
    (void)sheet, (void)text, (void)size;
    return false;
#endif
}

static void draw_text(sheet *sheet, int x, int baseline, const char *text, int size, int align) {
#ifdef ANG_WITH_OIIO
    if (*text) ang_oiio_text(sheet->mask, sheet->width, sheet->height, x, baseline, text, size, sheet->font, align);
#else
    (void)sheet, (void)x, (void)baseline, (void)text, (void)size, (void)align;
#endif
}

/* A filled rectangle [x0, x1) x [y0, y1) in pixels, edges at fractions covered in part along x. */
static void draw_box(sheet *sheet, double x0, double x1, int y0, int y1) {
    for (int y = y0 < 0 ? 0 : y0; y < y1 && y < sheet->height; y++) {
        for (int x = x0 < 0 ? 0 : (int)x0; x < x1 && x < sheet->width; x++) {
            double covered = fmin(x + 1, x1) - fmax(x, x0);
            float *to = sheet->mask + (size_t)y * (size_t)sheet->width + (size_t)x;
            if (covered > (double)*to) *to = (float)covered;
        }
    }
}

/* The bar with end ticks, its label above. */
static void draw_bar(sheet *sheet, const ang_annotation *a, int small) {
    int right = sheet->width - sheet->margin;
    if (!(a->bar_mm > 0) || a->bar_pixels > right - sheet->margin) return;
    int width, top, descent;
    if (!text_extent(sheet, a->bar_label, small, &width, &top, &descent)) return;
    int thick = sheet->size >= 22 ? sheet->size / 11 : 1, tick = sheet->size / 2;
    int bottom = sheet->height - sheet->margin;
    double left = right - a->bar_pixels;
    draw_box(sheet, left, right, bottom - thick - (tick - thick) / 2, bottom - (tick - thick) / 2);
    draw_box(sheet, left, left + thick, bottom - tick, bottom);
    draw_box(sheet, right - thick, right, bottom - tick, bottom);

    /* A narrow picture has no room for "at the centre" beside the bottom letter: the words go below one another. */
    char label[sizeof a->bar_label];
    memcpy(label, a->bar_label, sizeof label);
    int room = sheet->width / 2 - sheet->margin - 2 * sheet->size, line = bottom - tick - small / 2;
    char *second = strstr(label, " at ");
    if (width > room && second) {
        draw_text(sheet, right, line, second + 1, small, 1);
        *second = '\0';
        line -= small + small / 4;
    }
    draw_text(sheet, right, line, label, small, 1);
}

/* Pixels that a line at the left bottom has beside the bottom letter, and above that beside the bar's label. */
static int line_room(const sheet *sheet, int number) {
    return sheet->width / 2 - sheet->margin + (number > 0 ? sheet->size : -2 * sheet->size);
}

/* As much of it as goes; number 0 is the lowest. */
static void draw_line(sheet *sheet, const char *line, int small, int number) {
    char text[sizeof((ang_annotation *)0)->caption + 4];
    size_t length = strlen(line);
    memcpy(text, line, length + 1);
    int width, top, bottom, room = line_room(sheet, number);
    while (length > 0 && text_extent(sheet, text, small, &width, &top, &bottom) && width > room) {
        length = ang_text_cut(line, length - 1);
        snprintf(text, sizeof text, "%.*s..", (int)length, line);
    }
    int baseline = sheet->height - sheet->margin - number * (small + small / 4);
    if (length > 0) draw_text(sheet, sheet->margin, baseline, text, small, -1);
}

/* Above the caption; where there is no room for all, its parts go below one another. */
static void draw_remark(sheet *sheet, const char *remark, int small) {
    char first[sizeof((ang_annotation *)0)->remark];
    int width, top, bottom;
    const char *second = strstr(remark, ", ");
    if (!second || !text_extent(sheet, remark, small, &width, &top, &bottom) || width <= line_room(sheet, 1)) {
        draw_line(sheet, remark, small, 1);
        return;
    }
    snprintf(first, sizeof first, "%.*s", (int)(second - remark), remark);
    draw_line(sheet, first, small, 2);
    draw_line(sheet, second + 2, small, 1);
}

static void draw_side_letters(sheet *sheet, const ang_annotation *a) {
    int middle = sheet->height / 2, width, top, bottom;
    if (!text_extent(sheet, "H", sheet->size, &width, &top, &bottom)) return;
    draw_text(sheet, sheet->margin, middle - top / 2, a->left.text, sheet->size, -1);
    draw_text(sheet, sheet->width - sheet->margin, middle - top / 2, a->right.text, sheet->size, 1);
}

static void draw_end_letters(sheet *sheet, const ang_annotation *a) {
    int middle = sheet->width / 2, width, top, bottom;
    if (!text_extent(sheet, "H", sheet->size, &width, &top, &bottom)) return;
    draw_text(sheet, middle, sheet->margin - top, a->top.text, sheet->size, 0);
    draw_text(sheet, middle, sheet->height - sheet->margin, a->bottom.text, sheet->size, 0);
}

static void draw_labels(sheet *sheet, const ang_annotation *a, int small) {
    int width, top, bottom;
    if (!text_extent(sheet, "H", small, &width, &top, &bottom)) return;
    for (int i = 0; i < a->labels; i++) {
        const ang_annotation_label *label = &a->label[i];
        bool inside = label->x >= 0 && label->x < sheet->width && label->y >= 0 && label->y < sheet->height;
        if (inside) draw_text(sheet, (int)lround(label->x), (int)lround(label->y) - top / 2, label->text, small, 0);
    }
}

/* The largest coverage within `radius` pixels of (x, y), falling off over the last pixel. */
static float halo(const sheet *sheet, int x, int y, double radius) {
    int reach = (int)ceil(radius);
    double largest = 0;
    for (int dy = -reach; dy <= reach; dy++) {
        for (int dx = -reach; dx <= reach; dx++) {
            int from_x = x + dx, from_y = y + dy;
            if (from_x < 0 || from_y < 0 || from_x >= sheet->width || from_y >= sheet->height) continue;
            double near = radius + 0.5 - sqrt((double)(dx * dx + dy * dy));
            double here = sheet->mask[(size_t)from_y * (size_t)sheet->width + (size_t)from_x];
            largest = fmax(largest, here * fmin(1, fmax(0, near)));
        }
    }
    return (float)largest;
}

/* Only rows that the halo can touch, so that the large empty middle costs nothing. */
static void ink(const sheet *sheet, bool dark_ink, ang_image *image, const unsigned char *rows, double radius) {
    const float strength = 0.8F;
    for (int y = 0; y < sheet->height; y++) {
        if (!rows[y]) continue;
        for (int x = 0; x < sheet->width; x++) {
            size_t at = (size_t)y * (size_t)sheet->width + (size_t)x;
            float outline = strength * halo(sheet, x, y, radius), text = sheet->mask[at];
            if (!(outline > 0)) continue;
            float *p = image->rgba + 4 * at;
            for (int c = 0; c < 4; c++) {
                float outline_value = c == 3 || dark_ink, text_value = c == 3 || !dark_ink;
                p[c] = (p[c] * (1 - outline) + outline * outline_value) * (1 - text) + text * text_value;
            }
        }
    }
}

static void blend(const sheet *sheet, bool dark_ink, ang_image *image, unsigned char *rows) {
    double radius = sheet->size / 14.0;
    if (radius < 1) radius = 1;
    int reach = (int)ceil(radius);
    for (int y = 0; y < sheet->height; y++) {
        const float *row = sheet->mask + (size_t)y * (size_t)sheet->width;
        bool used = false;
        for (int x = 0; x < sheet->width && !used; x++) used = row[x] > 0;
        for (int d = -reach; used && d <= reach; d++) {
            if (y + d >= 0 && y + d < sheet->height) rows[y + d] = 1;
        }
    }
    ink(sheet, dark_ink, image, rows, radius);
}

bool ang_image_annotate(ang_image *image, const ang_annotation *annotation, ang_notes *warnings, ang_error *err) {
    sheet sheet = {.width = image->width, .height = image->height};
    sheet.size = image->height / 40 > 11 ? image->height / 40 : 11;
    sheet.margin = sheet.size / 2;
    int small = sheet.size * 4 / 5 > 11 ? sheet.size * 4 / 5 : 11;
    /* Below this the letters alone would fill the picture; a flat one still has room for those at its sides. */
    bool sides_only = image->height < 8 * sheet.size;
    if (image->width < 8 * sheet.size || image->height < 3 * sheet.size) {
        if (warnings) ang_notes_add(warnings, "the picture is too small for letters and a bar: none are drawn");
        return true;
    }

    sheet.font = ang_font_find();
    if (!sheet.font) {
        /* A bar without its length would say nothing. */
        if (warnings) ang_notes_add(warnings, "letters, caption and bar are left out of the picture: " FONT_LACKS);
        return true;
    }
    if (sides_only && warnings)
        ang_notes_add(warnings, "the picture is too flat for more than the letters at its sides");
    sheet.mask = ang_alloc((size_t)image->width * (size_t)image->height, sizeof *sheet.mask, "annotation", err);
    unsigned char *rows = sheet.mask ? ang_alloc((size_t)image->height, 1, "annotation", err) : NULL;
    if (rows) {
        draw_side_letters(&sheet, annotation);
        draw_labels(&sheet, annotation, small);
        if (!sides_only) {
            draw_end_letters(&sheet, annotation);
            draw_bar(&sheet, annotation, small);
            draw_line(&sheet, annotation->caption, small, 0);
            draw_remark(&sheet, annotation->remark, small);
        }
        blend(&sheet, annotation->dark_ink, image, rows);
    }
    bool good = rows != NULL;
    free(sheet.mask);
    free(rows);
    return good;
}
