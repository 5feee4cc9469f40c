/* Voxels of any number type from a plain or gzipped file into a volume of 16 bits. */
#ifndef ANG_IO_SAMPLES_H
#define ANG_IO_SAMPLES_H

#include "io/load.h"

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

/* Where the voxels are and what they mean. Strings are borrowed. */
typedef struct ang_sample_source {
    const char *path;
    const char *label; /* names the file in errors */
    uint64_t offset;   /* bytes before the first voxel, uncompressed */
    int dims[3];       /* x fastest */
    ang_sample type;
    bool big_endian;
    double slope, intercept; /* HU = slope * sample + intercept; slope not 0 */
    bool exact_length;       /* bytes behind the voxels are worth a warning */
    ang_slice_sink slices;   /* is given some of the planes while they are read */
} ang_sample_source;

/* Bytes of one sample. */
size_t ang_sample_size(ang_sample type);

/* A new volume with the identity affine, its padding marked and its range known; fills the values' part of `report`.
 * Types of 8 and 16 bits are kept exactly; others are where they are whole numbers and their range fits 16 bits;
 * otherwise they are quantised over their finite range. Memory: the volume and one buffer. NULL with ANG_INPUT where
 * the file is shorter than the voxels need, which is checked before anything is allocated where the size can tell;
 * ANG_LIMIT, ANG_INTERRUPTED. */
ang_volume *ang_samples_read(const ang_sample_source *source, int threads, ang_load_report *report,
                             const ang_progress *progress, ang_error *err);

/* The report's list of series for a file that holds one volume. */
bool ang_samples_list(const ang_volume *volume, const char *modality, const char *description, ang_load_report *report,
                      ang_error *err);

#endif
