/* Steps classified as a whole: the mean of the transfer function between the values at a step's ends
 * (core/transfer/prefix.h). The same formulas as classify_prefix.glsl and prefix_plateaus.glsl, for all lanes at once.
 * Part of cast_kernel.c. */
#ifndef ANG_CPU_CAST_WHOLE_H
#define ANG_CPU_CAST_WHOLE_H

#include "core/cpu/cast_shade.h"

/* A value in the transfer function's table: x in intervals from its left end; the interval, of which -1 and the number
 * of intervals stand for what lies outside the table; and how far from the interval's left end. */
typedef struct table_place {
    lanes x, interval, inside;
} table_place;

INLINE table_place place_in_table(const ang_cast *cast, lanes x) {
    lanes bounded = lanes_max(lanes_min(x, lanes_all((float)cast->intervals)), lanes_all(-1));
    lanes_int interval = lanes_truncate(bounded);
    interval += lanes_float(interval) > bounded;
    lanes left = lanes_float(interval);
    return (table_place){x, left, x - left};
}

/* An end of a step, as far as extinction goes: at the interval's two ends extinction, and up to its left end the
 * integral as a pair of floats. */
typedef struct step_end {
    table_place at;
    lanes left, right, integral[2];
} step_end;

INLINE step_end end_of_step(const ang_cast *cast, lanes value) {
    step_end end = {.at = place_in_table(cast, (value - cast->first) * cast->per_value)};
    lanes record[4];
    lanes_fours(cast->steps, lanes_truncate(end.at.interval) + 1, record);
    end.left = record[0];
    end.right = record[1];
    end.integral[0] = record[2];
    end.integral[1] = record[3];
    return end;
}

/* Of a < b in the table: the share of each of the two intervals that lies between, and what both and all between them
 * span, in intervals. */
INLINE lanes span_between(const table_place *low, const table_place *high) {
    return (1 - low->inside) + (high->interval - low->interval - 1) + high->inside;
}

INLINE lanes safe_span(lanes span) { return lanes_max(span, lanes_all(1e-30f)); }

/* Mean extinction between ends in two intervals, of which no more than what lies between is added up. */
INLINE lanes extinction_near(const ang_cast *cast, const step_end *a, const step_end *b) {
    lanes_int up = b->at.x >= a->at.x;
    table_place low = {.interval = lanes_min(a->at.interval, b->at.interval),
                       .inside = lanes_pick(up, a->at.inside, b->at.inside)};
    table_place high = {.interval = lanes_max(a->at.interval, b->at.interval),
                        .inside = lanes_pick(up, b->at.inside, a->at.inside)};
    lanes low_left = lanes_pick(up, a->left, b->left), low_right = lanes_pick(up, a->right, b->right);
    lanes high_left = lanes_pick(up, b->left, a->left), high_right = lanes_pick(up, b->right, a->right);
    lanes from[2], between[2];
    lanes_pairs(cast->steps, 2 * lanes_truncate(low.interval) + 5, &from[0], &from[1]);
    for (int i = 0; i < 2; i++) between[i] = lanes_pick(up, b->integral[i], a->integral[i]) - from[i];
    lanes first = low_left + 0.5f * (low.inside + 1) * (low_right - low_left);
    lanes last = high_left + 0.5f * high.inside * (high_right - high_left);
    lanes sum = (1 - low.inside) * first + (between[0] + between[1]) + high.inside * last;
    return sum / safe_span(span_between(&low, &high));
}

/* Integral from the left end of its interval to an end. */
INLINE lanes integral_inside(const step_end *end) {
    return end->at.inside * (end->left + 0.5f * end->at.inside * (end->right - end->left));
}

/* Mean extinction between two ends. Within one interval nothing is subtracted, and near its ends little, so that short
 * steps do not cancel. */
INLINE lanes extinction_between(const ang_cast *cast, const step_end *a, const step_end *b) {
    lanes_int same = a->at.interval == b->at.interval;
    lanes mean = a->left + 0.5f * (a->at.inside + b->at.inside) * (a->right - a->left);
    lanes span = (b->at.interval - a->at.interval) + (b->at.inside - a->at.inside);
    lanes_int near = ~same & (lanes_abs(span) < 0x1p-6f);
    lanes sum = (b->integral[0] - a->integral[0]) +
                ((b->integral[1] - a->integral[1]) + (integral_inside(b) - integral_inside(a)));
    mean = lanes_pick(same, mean, sum / lanes_pick(same | near, lanes_all(1), span));
    if (lanes_bits(near)) mean = lanes_pick(near, extinction_near(cast, a, b), mean);
    return mean;
}

/* Where a step meets a plateau at opacity 1, which ends it. */
INLINE lanes_int meets_plateau(const ang_cast *cast, const table_place *a, const table_place *b, lanes *edge) {
    lanes above, below;
    lanes_pairs(cast->plateaus, lanes_truncate(a->interval) + 1, &above, &below);
    lanes_int up = b->x >= a->x;
    *edge = lanes_pick(up, above, below);
    return (up & (*edge <= b->interval)) | (~up & (*edge >= b->interval));
}

INLINE void entries_of(const ang_cast *cast, const table_place *p, lanes left[4], lanes right[4]) {
    lanes_int interval = lanes_truncate(p->interval), last = lanes_all_int(cast->intervals - 1);
    lanes_int entry = lanes_pick_int(interval < 0, lanes_all_int(0), lanes_pick_int(interval > last, last, interval));
    lanes_fours(cast->entries, 2 * entry - (interval > last), left);
    lanes_fours(cast->entries, 2 * entry - (interval >= 0), right);
}

/* Means of colour times extinction, and of extinction, over part of an interval in which both are linear. */
INLINE void mean_inside(const lanes left[4], const lanes right[4], lanes from, lanes to, lanes mean[4]) {
    lanes half = 0.5f * (from + to), size = to - from, extinction = right[3] - left[3];
    mean[3] = left[3] + half * extinction;
    for (int c = 0; c < 3; c++) {
        lanes slope = right[c] - left[c];
        mean[c] = (left[c] + half * slope) * mean[3] + slope * (extinction * size * size * (1.0f / 12));
    }
}

/* The same between two values. */
INLINE void mean_between(const ang_cast *cast, const table_place *a, const table_place *b, lanes mean[4]) {
    lanes_int up = b->x >= a->x;
    table_place low = {.interval = lanes_min(a->interval, b->interval), .inside = lanes_pick(up, a->inside, b->inside)};
    table_place high = {.interval = lanes_max(a->interval, b->interval),
                        .inside = lanes_pick(up, b->inside, a->inside)};
    lanes left[4], right[4], first[4], last[4], upper[2][4], lower[2][4];
    lanes_int same = low.interval == high.interval;
    entries_of(cast, &low, left, right);
    mean_inside(left, right, low.inside, lanes_pick(same, high.inside, lanes_all(1)), first);
    entries_of(cast, &high, left, right);
    mean_inside(left, right, lanes_all(0), high.inside, last);
    lanes_int from = lanes_truncate(lanes_min(low.interval + 1, lanes_all((float)cast->intervals)));
    lanes_int to = lanes_truncate(lanes_max(high.interval, lanes_all(0)));
    lanes_fours(cast->integrals, 2 * from, upper[0]);
    lanes_fours(cast->integrals, 2 * from + 1, lower[0]);
    lanes_fours(cast->integrals, 2 * to, upper[1]);
    lanes_fours(cast->integrals, 2 * to + 1, lower[1]);
    lanes share = 1 / safe_span(span_between(&low, &high));
    for (int c = 0; c < 4; c++) {
        lanes between = (upper[1][c] - upper[0][c]) + (lower[1][c] - lower[0][c]);
        lanes sum = (1 - low.inside) * first[c] + between + high.inside * last[c];
        mean[c] = lanes_pick(same, first[c], sum * share);
    }
}

INLINE void colour_of_mean(const lanes mean[4], lanes colour[3]) {
    lanes_int any = mean[3] > 0;
    lanes whole = lanes_pick(any, mean[3], lanes_all(1));
    for (int c = 0; c < 3; c++) colour[c] = lanes_pick(any, lanes_min(mean[c] / whole, lanes_all(1)), lanes_all(0));
}

INLINE lanes distance_in_table(const table_place *a, const table_place *b) {
    return lanes_abs((b->interval - a->interval) + (b->inside - a->inside));
}

/* Of a step that ends at a plateau: the plateau's colour behind what lies before it. */
INLINE void colour_before_plateau(const ang_cast *cast, const table_place *a, const table_place *b, lanes piece,
                                  lanes colour[3]) {
    table_place edge;
    lanes_int meets = meets_plateau(cast, a, b, &edge.interval), inside = edge.interval == a->interval;
    lanes side = lanes_pick(b->x >= a->x, lanes_all(0), lanes_all(1));
    edge.interval = lanes_pick(meets, edge.interval, b->interval);
    edge.inside = lanes_pick(meets, lanes_pick(inside, a->inside, side), b->inside);
    edge.x = edge.interval + edge.inside;
    lanes mean[4], left[4], right[4];
    mean_between(cast, a, &edge, mean);
    colour_of_mean(mean, colour);
    lanes share = distance_in_table(a, &edge) / safe_span(distance_in_table(a, b));
    lanes before = opacity_of(cast, lanes_min(mean[3], lanes_all(1e20f)) * share * piece);
    before = lanes_pick(inside, lanes_all(0), before);
    entries_of(cast, &edge, left, right);
    lanes within = lanes_max(lanes_min(edge.inside, lanes_all(1)), lanes_all(0));
    for (int c = 0; c < 3; c++)
        colour[c] = lanes_pick(meets, mix(mix(left[c], right[c], within), colour[c], before), colour[c]);
}

/* Colour of steps of `piece` mm between two places in the table. */
INLINE void colour_between(const ang_cast *cast, lanes from, lanes to, lanes piece, lanes colour[3]) {
    if (cast->one_colour) {
        for (int c = 0; c < 3; c++) colour[c] = lanes_all(cast->colour[c]);
        return;
    }
    table_place a = place_in_table(cast, from), b = place_in_table(cast, to);
    if (cast->plateaus) {
        colour_before_plateau(cast, &a, &b, piece, colour);
        return;
    }
    lanes mean[4];
    mean_between(cast, &a, &b, mean);
    colour_of_mean(mean, colour);
}

#endif
