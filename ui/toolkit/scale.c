#include "ui/toolkit/scale.h"

#include <math.h>

double ang_screen_scale(double told, int pixels, int mm) {
    if (!(told >= 0.5 && told <= 8)) told = 1;
    if (fabs(told - 1) > 1e-3 || mm < 180 || mm > 2000) return told;
    double finer = pixels / (mm / 25.4) / 96;
    return finer < 1.45 ? 1 : fmin(floor(4 * finer + 0.2) / 4, 4);
}
