/* How far it is, in blocks, to the nearest block that shows something: what ray casters jump by. */
#ifndef ANG_PLAN_DISTANCE_H
#define ANG_PLAN_DISTANCE_H

#include <stdint.h>

/* For dims[0] x dims[1] x dims[2] blocks, x fastest: 0 where `visible` is not 0; else the blocks to the nearest visible
 * one along the axis in which it is farthest (chessboard distance), at most 255, which stands for more. All blocks
 * nearer than that are invisible. Exact (Rosenfeld & Pfaltz 1968); `distance` may not overlap `visible`. Pure. */
void ang_block_distances(const int dims[3], const uint8_t *visible, uint8_t *distance);

#endif
