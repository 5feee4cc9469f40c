/* Encapsulated pixel data (PS3.5 annex A.4): which fragments belong to which frame. */
#ifndef ANG_DICOM_FRAGMENTS_H
#define ANG_DICOM_FRAGMENTS_H

#include "io/dicom/parse.h"
#include "io/dicom/slice.h"

/* Moves `*offset` from the item of the basic offset table to the first fragment's. ANG_INPUT where there is none. */
bool ang_dicom_first_fragment(ang_dicom_reader *reader, uint64_t *offset, const char *label, ang_error *err);

/* Sets pixel_offset and pixel_length of `count` frames, whose pixel_offset is that of the basic offset table. Follows
 * the extended offset table `extended` ((7FE0,0001), or all zero), else the basic one; where neither holds, one
 * fragment a frame, or those that a stream begins with. ANG_INPUT where nothing tells frames apart, ANG_LIMIT. */
bool ang_dicom_locate_frames(ang_dicom_reader *reader, const char *label, const ang_dicom_element *extended,
                             ang_dicom_slice *frames, int count, ang_error *err);

/* A JPEG 2000 stream's precision and sign win over a wrong header (rule 9). */
void ang_dicom_adopt_jpeg2000(ang_dicom_slice *s, ang_dicom_reader *reader);

#endif
