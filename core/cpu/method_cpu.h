/* The SIMD ray caster as a method, as far as others than the list of methods need to know. */
#ifndef ANG_CPU_METHOD_CPU_H
#define ANG_CPU_METHOD_CPU_H

#include "core/cpu/cast.h"
#include "core/render/method.h"

/* For tests and measurements: draws with this width of SIMD from now on. */
void ang_cpu_set_width(ang_renderer *renderer, const ang_cast_width *width);

#endif
