/* Presets between presets. */
#ifndef ANG_TRANSFER_PRESET_BLEND_H
#define ANG_TRANSFER_PRESET_BLEND_H

#include "core/transfer/preset.h"

/* The preset that lies `t` (0..1) of the way from `a` to `b`, whose modes are the same. Points lie wherever one of both
 * has them; opacities go over in equal steps, each per its own unit distance, which goes over in equal ratios; colours
 * are weighted by opacity, so that what one of both does not show has no part in them. Phong's numbers and the window
 * go over in equal steps, g0 in equal ratios; no shading counts as ambient light of 1. At 0 and 1 it is `a` and `b` to
 * the number. Extinctions (by_extinction in both) go over in equal steps; where only one gives them they become
 * opacities at its points. NULL with ANG_USAGE where the modes differ, or ANG_LIMIT. Free with
 * ang_preset_free. Pure. */
ang_preset *ang_preset_blend(const ang_preset *a, const ang_preset *b, double t, ang_error *err);

#endif
