/* The number types of voxels in files. */
#ifndef ANG_VOXELS_SAMPLE_H
#define ANG_VOXELS_SAMPLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum ang_sample {
    ANG_SAMPLE_U8,
    ANG_SAMPLE_I8,
    ANG_SAMPLE_U16,
    ANG_SAMPLE_I16,
    ANG_SAMPLE_U32,
    ANG_SAMPLE_I32,
    ANG_SAMPLE_U64,
    ANG_SAMPLE_I64,
    ANG_SAMPLE_F32,
    ANG_SAMPLE_F64,
} ang_sample;

/* Bytes of one sample. */
size_t ang_sample_size(ang_sample type);
/* The type of as many bits that is signed; the type itself where it is signed or no whole number. */
ang_sample ang_sample_signed(ang_sample type);
/* The number at `bytes`. */
double ang_sample_get(const uint8_t *bytes, ang_sample type, bool big_endian);
/* Writes `value` little endian; false where the type does not hold it: no whole number, or beyond its range. */
bool ang_sample_put(uint8_t *bytes, ang_sample type, double value);

#endif
