#include "core/cpu/cast.h"

ang_cast_tile ang_cast_tile_baseline, ang_cast_cells_baseline;
#ifdef ANG_CAST_X86
ang_cast_tile ang_cast_tile_avx2, ang_cast_tile_avx512, ang_cast_cells_avx2, ang_cast_cells_avx512;
#endif

int ang_cast_widths(ang_cast_width widths[ANG_CAST_WIDTHS]) {
    int count = 0;
#ifdef ANG_CAST_X86
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
        widths[count++] = (ang_cast_width){"16 lanes, AVX-512", ang_cast_tile_avx512, ang_cast_cells_avx512};
    if (__builtin_cpu_supports("avx2"))
        widths[count++] = (ang_cast_width){"8 lanes, AVX2", ang_cast_tile_avx2, ang_cast_cells_avx2};
#endif
    widths[count++] = (ang_cast_width){"4 lanes", ang_cast_tile_baseline, ang_cast_cells_baseline};
    return count;
}
