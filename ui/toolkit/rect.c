#include "ui/toolkit/rect.h"

#include <math.h>

ang_rect ang_rect_within(ang_rect outer, double width, double height) {
    double scale = fmin(outer.width / width, outer.height / height);
    double across = round(width * scale), down = round(height * scale);
    return (ang_rect){outer.x + floor((outer.width - across) / 2), outer.y + floor((outer.height - down) / 2), across,
                      down};
}
