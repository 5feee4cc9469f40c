/* Films that go from preset to preset. */
#ifndef ANG_APP_SWEEP_H
#define ANG_APP_SWEEP_H

#include "core/base/error.h"
#include "core/transfer/preset.h"

enum { ANG_SWEEP_MOST = 32 };

/* The presets of --sweep, in order. Owns them; zero-initialise, clear with ang_sweep_clear. */
typedef struct ang_sweep {
    ang_preset *preset[ANG_SWEEP_MOST];
    int count; /* 0: there is none */
} ang_sweep;

/* Reads "PRESET,PRESET,...", 2 to ANG_SWEEP_MOST names or files. False with ANG_USAGE (also where their modes differ),
 * or what reading them gives. */
bool ang_sweep_open(ang_sweep *sweep, const char *list, ang_error *err);
void ang_sweep_clear(ang_sweep *sweep);
/* The preset of frame `frame` of `frames`: the first is the first preset, the last the last, those between at equal
 * distances. Free with ang_preset_free. NULL with ANG_LIMIT. */
ang_preset *ang_sweep_at(const ang_sweep *sweep, int frame, int frames, ang_error *err);

#endif
