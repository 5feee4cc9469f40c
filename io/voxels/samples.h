/* Voxels of any number type from files, packed or not, into a volume of 16 bits. */
#ifndef ANG_IO_SAMPLES_H
#define ANG_IO_SAMPLES_H

#include "io/load.h"
#include "io/voxels/byte_stream.h"

/* Where the voxels are and what they mean. Strings and parts are borrowed. */
typedef struct ang_sample_source {
    const char *label;    /* names the file in errors */
    const char *field;    /* what the format calls `dims`; NULL: it has no name */
    ang_byte_parts parts; /* `part_bytes`, `type`, `width` and `height` are set by ang_samples_read */
    int dims[3];          /* of one phase, x fastest */
    ang_sample type;
    bool big_endian;
    int phases;              /* volumes in the data; 0 is taken for 1 */
    int phase;               /* which of them is read, from 1; 0 is taken for 1 */
    size_t phase_run;        /* samples of a phase in a row before those of the next: 1 where each voxel has its phases
                                side by side; 0: all of a volume */
    double slope, intercept; /* HU = slope * sample + intercept; slope not 0 */
    ang_slice_sink slices;   /* is given some of the planes while they are read */
} ang_sample_source;

/* A new volume with the identity affine, its padding marked and its range known; fills the values' part of `report`.
 * Types of 8 and 16 bits are kept exactly; others are where they are whole numbers and their range fits 16 bits;
 * otherwise they are quantised over their finite range. Memory: the volume and one buffer. NULL with ANG_INPUT where
 * the file is shorter than the voxels need, which is checked before anything is allocated where the size can tell, and
 * a warning where it is longer;
 * ANG_LIMIT, ANG_INTERRUPTED. */
ang_volume *ang_samples_read(ang_sample_source *source, int threads, ang_load_report *report,
                             const ang_progress *progress, ang_error *err);

/* The report's list of series for a file that holds one volume, or one in each of `phases` phases. */
bool ang_samples_list(const ang_volume *volume, int phases, const char *modality, const char *description,
                      ang_load_report *report, ang_error *err);
/* Names the phases of a series of several by their times, `first` + i * `step` in `unit` ("": none), where these are
 * finite. False with ANG_LIMIT. */
bool ang_samples_name_phases(ang_series_info *info, double first, double step, const char *unit, ang_error *err);

#endif
