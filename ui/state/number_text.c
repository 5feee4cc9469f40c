#include "ui/state/number_text.h"

#include <math.h>

enum { most = 6 };

int ang_number_decimals(double value, double resolution) {
    double power = 1;
    for (int decimals = 0; decimals <= most; decimals++, power *= 10)
        if (fabs(round(value * power) / power - value) <= 1e-12 * fmax(fabs(value), 1)) return decimals;
    double decimals = ceil(-log10(resolution) - 1e-9);
    return decimals >= most ? most : decimals > 1 ? (int)decimals : 1;
}

int ang_percent_decimals(double percent) { return ang_number_decimals(percent, fmax(0.05 * fabs(percent), 1e-4)); }
