/* One DICOM image as the loading rules see it: what its header says, with flags for what it leaves out. The rules of
 * series.h, geometry.h and stored.h work on arrays of these records alone, so that they can be tested without files. */
#ifndef ANG_DICOM_SLICE_H
#define ANG_DICOM_SLICE_H

#include "core/math/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How the pixels are coded (DICOM PS3.5 annex A). */
typedef enum ang_dicom_coding {
    ANG_DICOM_NATIVE,       /* little endian, in the file as they are */
    ANG_DICOM_BIG_ENDIAN,   /* native, words most significant byte first */
    ANG_DICOM_DEFLATED,     /* the whole data set is deflated, native inside */
    ANG_DICOM_RLE,          /* encapsulated, run lengths (annex G) */
    ANG_DICOM_ENCAPSULATED, /* JPEG, JPEG-LS, JPEG 2000: for the codecs of GDCM */
} ang_dicom_coding;

/* Plain value without ownership. Strings are trimmed and cut to their length here. */
typedef struct ang_dicom_slice {
    size_t file;      /* index into the caller's list of paths */
    bool image;       /* has pixel data */
    char refusal[96]; /* why it cannot be part of a volume; empty where it can */

    char sop_class[65], series_uid[65], transfer_syntax[65];
    char modality[17];
    char description[257]; /* UTF-8 */
    char patient[257];     /* PatientName, UTF-8, its components separated by '^' */
    char patient_id[65];
    char image_type[129]; /* values separated by '\\' */
    char photometric[17];
    char stack_id[17];
    char acquisition_time[41], content_time[41]; /* date and time, or only one of them */
    bool has_series_number, has_instance_number, has_acquisition_number, has_temporal_position, has_window;
    int series_number, instance_number, acquisition_number, temporal_position;
    bool has_trigger_time, has_cardiac_phase;
    double trigger_time;  /* ms after the R peak */
    double cardiac_phase; /* % of the cardiac cycle */

    int frame;           /* of a multi-frame file, from 1; 0: the file's only picture */
    char object[65];     /* what its file is one of: ConcatenationUID; empty where it is none */
    int object_number;   /* InstanceNumber of the file */
    char dimensions[49]; /* DimensionIndexValues but those of stack and position, separated by '\\' */

    int rows, columns, samples, frames;
    int bits_allocated, bits_stored, high_bit;
    ang_dicom_coding coding;
    bool is_signed, lossy;
    bool wrong_syntax;  /* TransferSyntaxUID is there, and the file is not coded so or it is of no standard */
    bool other_unit;    /* RescaleType is there and not HU */
    bool wrong_offsets; /* the table of its frames' offsets is wrong and was not used */

    bool has_position, has_orientation, has_spacing, has_thickness, has_slice_distance, has_tilt;
    bool bad_spacing; /* PixelSpacing is there, but not two numbers > 0; has_spacing is false */
    bool bad_position, bad_orientation, bad_slope, bad_intercept; /* there, but no numbers; has_... is false */
    ang_vec3 position;                                            /* mm, LPS: centre of the first voxel */
    ang_vec3 row, column;  /* direction of rising column index, of rising row index */
    double row_spacing;    /* mm between rows (dy): the first value of PixelSpacing */
    double column_spacing; /* mm between columns (dx): the second */
    double thickness;      /* mm, nominal: only where positions are missing */
    double slice_distance; /* SpacingBetweenSlices, mm, nominal: only where positions are missing */
    double tilt;           /* (0018,1120) in degrees, nominal */

    bool has_slope, has_intercept, has_padding, has_padding_limit;
    uint16_t padding, padding_limit;    /* the two bytes as they are: the VR lies (rule 10) */
    double slope, intercept;            /* as in the file; 0 where absent */
    double window_centre, window_width; /* the first values */

    uint64_t pixel_offset; /* bytes from the file's start (from the data set's start where deflated) to the pixels or,
                              encapsulated, to the head of their first fragment's item */
    uint64_t pixel_length; /* bytes; encapsulated: of the fragments with their heads, at most to the end of the file */
} ang_dicom_slice;

/* Copies value `index` (0-based) of a multi-valued string into `out`; empty where there is none. */
void ang_dicom_value(const char *values, int index, char *out, size_t size);

/* Bytes of the decoded pixels of one slice, or 0 where they overflow or make no sense. */
size_t ang_dicom_pixel_bytes(const ang_dicom_slice *slice);

#endif
