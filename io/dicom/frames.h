/* Frames of a multi-frame image and their functional groups (PS3.3 C.7.6.16): every frame becomes a slice record. */
#ifndef ANG_DICOM_FRAMES_H
#define ANG_DICOM_FRAMES_H

#include "io/dicom/parse.h"
#include "io/dicom/slice.h"

enum { ang_dicom_most_frames = 65535 };

/* Elements of the header that describe frames; all zero where they are missing. */
typedef struct ang_dicom_multi_frame {
    ang_dicom_element shared, per_frame; /* Shared and PerFrameFunctionalGroupsSequence */
    ang_dicom_element dimensions;        /* DimensionIndexSequence */
    ang_dicom_element first_frame;       /* ConcatenationFrameOffsetNumber */
    ang_dicom_element offsets;           /* ExtendedOffsetTable */
} ang_dicom_multi_frame;

/* whole->frames records, each as `whole` with what the shared groups say and what its own say instead, and pixel_offset
 * as it is there. To be freed. NULL with ANG_INPUT where the frames have not one item each, ANG_LIMIT. */
ang_dicom_slice *ang_dicom_read_frames(ang_dicom_reader *reader, const char *label, const ang_dicom_slice *whole,
                                       const ang_dicom_multi_frame *multi, ang_error *err);

#endif
