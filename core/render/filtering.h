/* How finely the texture unit interpolates. */
#ifndef ANG_RENDER_FILTERING_H
#define ANG_RENDER_FILTERING_H

#include "core/render/context.h"

/* The fractional bits with which the texture unit weights two neighbours: between two texels of a GL_R16 3D texture,
 * which hold 0 and 1, the greatest distance from a straight line is 2^-(bits + 1). 8 on many GPUs; 16 is what 16 bits
 * of a texel can tell, and the most that is reported. `deviation` (may be NULL) becomes that distance, as a share of
 * the difference of the texels. 0 with ANG_GL. The context must be current. */
int ang_gl_filter_bits(ang_gl *gl, double *deviation, ang_error *err);

#endif
