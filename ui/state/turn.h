/* How the three slice planes are turned against the patient: a rotation. Pure values. */
#ifndef ANG_UI_TURN_H
#define ANG_UI_TURN_H

#include "core/math/vec.h"

/* Where the patient's directions L, P and H (LPS +x, +y, +z) have gone to: orthonormal and right-handed. */
typedef struct ang_turn {
    ang_vec3 x, y, z;
} ang_turn;
extern const ang_turn ang_turn_none; /* along the patient */

bool ang_turn_same(const ang_turn *a, const ang_turn *b);
/* Where a direction has gone to. */
ang_vec3 ang_turn_direction(const ang_turn *turn, ang_vec3 direction);
/* Turned on by `degrees` about `axis` (unit, LPS), right-handed. Quarter turns come out exact. */
ang_turn ang_turn_about(const ang_turn *turn, ang_vec3 axis, double degrees);
/* Orthonormal again after rounding or from a file; false, and `turn` unchanged, where it is no rotation to 1e-3. */
bool ang_turn_mend(ang_turn *turn);

#endif
