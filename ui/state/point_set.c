#include "ui/state/point_set.h"

#include <math.h>
#include <string.h>

double ang_height_of_opacity(double opacity) { return sqrt(fmin(fmax(opacity, 0), 1)); }
double ang_opacity_of_height(double height) { return fmin(fmax(height, 0), 1) * fmin(fmax(height, 0), 1); }

int ang_point_set_count(const ang_point_set *set, const ang_document *document) {
    int count = 0;
    for (int i = 0; i < document->count; i++) count += set->has[i];
    return count;
}

int ang_point_set_first(const ang_point_set *set, const ang_document *document) {
    for (int i = 0; i < document->count; i++)
        if (set->has[i]) return i;
    return -1;
}

void ang_point_set_only(ang_point_set *set, int index) {
    *set = (ang_point_set){0};
    if (index >= 0 && index < ANG_DOCUMENT_POINTS) set->has[index] = true;
}

void ang_point_set_all(ang_point_set *set, const ang_document *document) {
    *set = (ang_point_set){0};
    for (int i = 0; i < document->count; i++) set->has[i] = true;
}

void ang_point_set_add_box(ang_point_set *set, const ang_document *document, const double hu[2],
                           const double height[2]) {
    for (int i = 0; i < document->count; i++) {
        double at = document->points[i].hu, tall = ang_height_of_opacity(ang_document_opacity(document, i));
        bool inside = at >= fmin(hu[0], hu[1]) && at <= fmax(hu[0], hu[1]) && tall >= fmin(height[0], height[1]) &&
                      tall <= fmax(height[0], height[1]);
        set->has[i] = set->has[i] || inside;
    }
}

static double limited(double value, double low, double high) { return fmin(fmax(value, low), high); }

void ang_points_move(ang_document *document, const ang_document *from, const ang_point_set *set,
                     ang_point_shift shift) {
    double back = -INFINITY, on = INFINITY, lowest = 1, highest = 0;
    for (int i = 0; i < from->count; i++) {
        if (!set->has[i]) continue;
        double hu = from->points[i].hu, opacity = ang_document_opacity(from, i);
        double low = i == 0 ? -ANG_TRANSFER_HU_LIMIT : set->has[i - 1] ? -INFINITY : from->points[i - 1].hu;
        double high = i + 1 == from->count ? ANG_TRANSFER_HU_LIMIT
                      : set->has[i + 1]    ? INFINITY
                                           : from->points[i + 1].hu;
        back = fmax(back, low - hu);
        on = fmin(on, high - hu);
        lowest = fmin(lowest, opacity);
        highest = fmax(highest, opacity);
    }
    double hu = limited(shift.hu, back, on), more = limited(shift.opacity, -lowest, 1 - highest);
    double higher = limited(shift.height, -ang_height_of_opacity(lowest), 1 - ang_height_of_opacity(highest));
    bool raised = higher < 0 || higher > 0, changed = raised || more < 0 || more > 0;
    *document = *from;
    for (int k = 0; k < from->count; k++) {
        /* Those in front first, so that none stops at one that is still to move. */
        int i = hu > 0 ? from->count - 1 - k : k;
        if (!set->has[i]) continue;
        double opacity = ang_document_opacity(from, i);
        opacity = raised ? ang_opacity_of_height(ang_height_of_opacity(opacity) + higher) : opacity + more;
        ang_document_move_point(document, i, from->points[i].hu + hu, opacity);
        /* An extinction does not come back from its opacity to the last bit. */
        if (!changed) document->points[i].opacity = from->points[i].opacity;
    }
}

void ang_points_delete(ang_document *document, ang_point_set *set) {
    for (int i = document->count - 1; i >= 0; i--)
        if (set->has[i]) ang_document_delete_point(document, i);
    *set = (ang_point_set){0};
}

void ang_points_colour(ang_document *document, const ang_point_set *set, const double colour[3]) {
    for (int i = 0; i < document->count; i++) {
        if (!set->has[i]) continue;
        memcpy(document->points[i].colour, colour, sizeof document->points[i].colour);
        document->edited = true;
    }
}
