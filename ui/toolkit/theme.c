#include "ui/toolkit/theme.h"

#include <math.h>

#define GREY(level) ANG_INK(level, level, level, 255)

/* Near-black greys and one accent colour (viewer conventions: panel 12 %, controls 18 %, text 88 %). */
const ang_theme ang_theme_dark = {.name = "dark",
                                  .panel = GREY(31),
                                  .raised = GREY(36),
                                  .control = GREY(46),
                                  .control_hovered = GREY(56),
                                  .control_pressed = GREY(64),
                                  .chosen = ANG_INK(34, 61, 84, 255),
                                  .plot = GREY(14),
                                  .text = GREY(224),
                                  .dim = GREY(171),
                                  .accent = ANG_INK(106, 178, 238, 255),
                                  .warning = ANG_INK(240, 192, 92, 255),
                                  .bad = ANG_INK(255, 150, 126, 255),
                                  .good = ANG_INK(128, 206, 136, 255),
                                  .curve = GREY(235),
                                  .before = ANG_INK(128, 158, 190, 255),
                                  .bars = ANG_INK(74, 78, 84, 255),
                                  .ring = GREY(240),
                                  .box = GREY(136),
                                  .gap = GREY(44),
                                  .edge = GREY(66),
                                  .line = GREY(56),
                                  .grid = GREY(36),
                                  .bar_grip = GREY(78)};

const ang_theme ang_theme_light = {.name = "light",
                                   .panel = GREY(240),
                                   .raised = GREY(250),
                                   .control = GREY(223),
                                   .control_hovered = GREY(210),
                                   .control_pressed = GREY(198),
                                   .chosen = ANG_INK(190, 216, 240, 255),
                                   .plot = GREY(252),
                                   .text = GREY(26),
                                   .dim = GREY(76),
                                   .accent = ANG_INK(0, 76, 146, 255),
                                   .warning = ANG_INK(112, 66, 0, 255),
                                   .bad = ANG_INK(154, 18, 18, 255),
                                   .good = ANG_INK(14, 86, 28, 255),
                                   .curve = GREY(32),
                                   .before = ANG_INK(84, 118, 158, 255),
                                   .bars = ANG_INK(196, 202, 210, 255),
                                   .ring = GREY(32),
                                   .box = GREY(116),
                                   .gap = GREY(205),
                                   .edge = GREY(170),
                                   .line = GREY(208),
                                   .grid = GREY(230),
                                   .bar_grip = GREY(180)};

/* sRGB to linear light. */
static double linear(unsigned byte) {
    double value = byte / 255.0;
    return value <= 0.03928 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

double ang_ink_luminance(ang_ink ink) {
    return 0.2126 * linear(ink & 255) + 0.7152 * linear(ink >> 8 & 255) + 0.0722 * linear(ink >> 16 & 255);
}

double ang_ink_contrast(ang_ink a, ang_ink b) {
    double one = ang_ink_luminance(a), other = ang_ink_luminance(b);
    return (fmax(one, other) + 0.05) / (fmin(one, other) + 0.05);
}
