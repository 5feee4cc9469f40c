/* From a value to light: transfer function, opacity, Phong. Part of cast_kernel.c. */
#ifndef ANG_CPU_CAST_SHADE_H
#define ANG_CPU_CAST_SHADE_H

#include "core/cpu/cast_field.h"

#include <math.h>

/* Values that were whole become whole again where something jumps with the value: interpolation is off by a unit or two
 * in the last place. */
INLINE lanes settle(lanes value) {
    const lanes magic = lanes_all(12582912); /* 1.5 * 2^23: adding it rounds to whole numbers, halves to even */
    lanes whole = (value + magic) - magic;
    return lanes_pick(lanes_abs(value - whole) <= 5e-7f * value, whole, value);
}

/* Which interval of the table a value lies in, and where in it. */
INLINE lanes_int find_interval(const ang_cast *cast, lanes value, lanes *inside) {
    lanes x = (value - cast->first) * cast->per_value;
    x = lanes_max(lanes_min(x, lanes_all((float)cast->intervals)), lanes_all(0));
    lanes_int interval = lanes_truncate(lanes_min(x, lanes_all((float)(cast->intervals - 1))));
    *inside = x - lanes_float(interval);
    return interval;
}

INLINE lanes extinction_at(const ang_cast *cast, lanes value) {
    lanes inside, left, right;
    lanes_int interval = find_interval(cast, value, &inside);
    lanes_pairs(cast->extinctions, interval, &left, &right);
    return mix(left, right, inside);
}

INLINE void constant_colour(const ang_cast *cast, lanes colour[3]) {
    for (int c = 0; c < 3; c++) colour[c] = lanes_all(cast->colour[c]);
}

/* Extinction and colour. */
INLINE void medium_at(const ang_cast *cast, lanes value, lanes *extinction, lanes colour[3]) {
    if (cast->one_colour) {
        *extinction = extinction_at(cast, value);
        constant_colour(cast, colour);
        return;
    }
    lanes inside, left[4], right[4];
    lanes_int interval = find_interval(cast, value, &inside);
    lanes_fours(cast->entries, 2 * interval, left);
    lanes_fours(cast->entries, 2 * interval + 1, right);
    for (int c = 0; c < 3; c++) colour[c] = mix(left[c], right[c], inside);
    *extinction = mix(left[3], right[3], inside);
}

INLINE void colour_at(const ang_cast *cast, lanes value, lanes colour[3]) {
    lanes extinction;
    if (cast->one_colour)
        constant_colour(cast, colour);
    else
        medium_at(cast, value, &extinction, colour);
}

/* exp(-z) for z >= 0.49: 2^-n exp(r) with |r| <= ln 2 / 2, its series to the sixth power (error below 2e-7). */
INLINE lanes exp_minus(lanes z) {
    z = lanes_min(z, lanes_all(80));
    lanes_int n = lanes_truncate(z * 1.44269504f + 0.5f);
    lanes whole = lanes_float(n), r = (whole * 0.693359375f - z) - whole * 2.12194440e-4f;
    lanes series = 1 + r * (1.0f / 7);
    series = 1 + r * (1.0f / 6) * series;
    series = 1 + r * (1.0f / 5) * series;
    series = 1 + r * (1.0f / 4) * series;
    series = 1 + r * (1.0f / 3) * series;
    series = 1 + r * (1.0f / 2) * series;
    series = 1 + r * series;
    return series * (lanes)((127 - n) << 23);
}

/* 1 - exp(-z) for z >= 0, without the formula's cancellation where z is small (numerics.md). */
INLINE lanes opacity_of(const ang_cast *cast, lanes z) {
    /* The powers by halves: what follows waits for this, so that the length of the chain counts. */
    lanes z2 = z * z, z4 = z2 * z2;
    lanes low = (1 - z * (1.0f / 2)) + z2 * ((1.0f / 6) - z * (1.0f / 24));
    lanes high = ((1.0f / 120) - z * (1.0f / 720)) + z2 * ((1.0f / 5040) - z * (1.0f / 40320));
    lanes series = z * (low + z4 * high);
    if (cast->thin) return series;
    lanes_int thick = z >= 0.5f;
    if (!lanes_bits(thick)) return series;
    /* Beyond 80 nothing is left of 1 - A in float: opaque table entries give exactly 1. */
    return lanes_pick(thick, 1 - lanes_pick(z >= 80.0f, lanes_all(0), exp_minus(z)), series);
}

INLINE lanes raise(const ang_cast *cast, lanes x) {
    if (cast->whole_power >= 0) {
        lanes power = lanes_all(1);
        for (int n = cast->whole_power; n; n >>= 1, x *= x)
            if (n & 1) power *= x;
        return power;
    }
    for (int l = 0; l < LANES; l++) x[l] = powf(x[l], cast->power);
    return x;
}

/* ang_phong. `direction` is the ray's, index units per mm: its product with the gradient in index space is that of both
 * in mm. */
INLINE void shade(const ang_cast *cast, const spot *s, const lanes direction[3], lanes colour[3]) {
    lanes d[3], squared = lanes_all(0), along = lanes_all(0);
    differences(cast, s, d);
    for (int i = 0; i < 3; i++) {
        lanes g =
            cast->gradient_to_mm[i][0] * d[0] + cast->gradient_to_mm[i][1] * d[1] + cast->gradient_to_mm[i][2] * d[2];
        squared += g * g;
        along += d[i] * direction[i];
    }
    lanes_int sloped = squared > 0;
    lanes length = lanes_sqrt(lanes_pick(sloped, squared, lanes_all(1)));
    lanes facing = lanes_min(lanes_abs(along) * cast->half_slope / length, lanes_all(1));
    lanes diffuse = cast->ambient + cast->diffuse * facing, highlight = cast->specular * raise(cast, facing);
    lanes weight = squared / (squared + cast->g0 * cast->g0);
    for (int c = 0; c < 3; c++) {
        lanes shaded = mix(colour[c], colour[c] * diffuse + highlight, weight);
        colour[c] = lanes_pick(sloped, shaded, colour[c]);
    }
}

#endif
