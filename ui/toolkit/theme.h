/* Colours of the interface by role, in two themes. Pictures, and what is written on them, look the same in both. Pure
 * data: tests hold every text to a contrast of 4.5 : 1 on every area, and every mark to 3 : 1 (WCAG 2.1, 1.4.3 and
 * 1.4.11). No meaning is told by colour alone: a sign, a word or a place goes with it. */
#ifndef ANG_UI_THEME_H
#define ANG_UI_THEME_H

#include <stdbool.h>
#include <stdint.h>

/* A colour: bytes r, g, b, a in memory. */
typedef uint32_t ang_ink;
#define ANG_INK(r, g, b, a) ((ang_ink)(r) | (ang_ink)(g) << 8 | (ang_ink)(b) << 16 | (ang_ink)(a) << 24)
/* The same colour with another alpha, 0..255. */
#define ANG_INK_FADED(ink, a) (((ink)&0xffffffu) | (ang_ink)(a) << 24)

/* On pictures, whatever the theme. */
#define ANG_INK_TEXT   ANG_INK(224, 224, 224, 255)
#define ANG_INK_DIM    ANG_INK(150, 150, 150, 255)
#define ANG_INK_ACCENT ANG_INK(69, 153, 219, 255)
#define ANG_INK_CROP   ANG_INK(94, 196, 255, 255)
#define ANG_INK_CLIP   ANG_INK(255, 178, 66, 255)
#define ANG_INK_BORDER ANG_INK(56, 56, 56, 255)
/* What a range of HU selects: orange, which any eyes tell from grey. */
#define ANG_INK_MARK ANG_INK(240, 160, 30, 255)

typedef struct ang_theme {
    const char *name; /* "dark", "light" */
    /* Areas, on which any text may stand. */
    ang_ink panel;                                     /* side panel, menu bar, status line */
    ang_ink raised;                                    /* menus, lists and messages in front of the rest */
    ang_ink control, control_hovered, control_pressed; /* buttons and fields */
    ang_ink chosen;                                    /* the row or tab that is chosen or pointed at; selected text */
    ang_ink plot;                                      /* behind curves and histograms */
    /* Text. */
    ang_ink text, dim; /* `dim`: explanations, shortcuts, units */
    ang_ink accent;    /* news; also ticks, sliders, the focus: the one accent colour */
    ang_ink warning, bad, good;
    /* Marks on areas. */
    ang_ink curve;  /* in plots */
    ang_ink before; /* in plots: the curve to compare with */
    ang_ink bars;   /* in plots: the histogram; quieter than marks */
    ang_ink ring;   /* around points of a plot, whose own colour may be any */
    ang_ink box;    /* around check boxes, ticked or not: on the areas of panel and messages */
    /* Quiet lines and gaps, that need no contrast. */
    ang_ink gap;      /* between panes, and where there is nothing */
    ang_ink edge;     /* of messages, menus and pictures in lists */
    ang_ink line;     /* between groups */
    ang_ink grid;     /* of plots */
    ang_ink bar_grip; /* of scroll bars */
} ang_theme;

extern const ang_theme ang_theme_dark, ang_theme_light;

/* Relative luminance of an opaque colour, 0..1, and the contrast of two, 1..21 (WCAG 2.1). */
double ang_ink_luminance(ang_ink ink);
double ang_ink_contrast(ang_ink a, ang_ink b);

#endif
