/* Sorted slices become a volume: parallel decoding in place, rescale, padding, resampling. */
#ifndef ANG_DICOM_ASSEMBLE_H
#define ANG_DICOM_ASSEMBLE_H

#include "core/base/progress.h"
#include "core/volume/raw_slice.h"
#include "io/dicom/geometry.h"
#include "io/sandbox/sandbox.h"

/* What ang_dicom_assemble works on; all borrowed. */
typedef struct ang_dicom_stack {
    const ang_dicom_slice *slices;
    const size_t *order; /* sorted, no duplicates */
    size_t count;
    char *const *paths;        /* of slices[...].file */
    const char *const *labels; /* base names of these */
    const ang_dicom_grid *grid;
    int threads;
    ang_slice_sink sink;
    ang_sandbox *sandbox; /* for codecs; NULL: in this process */
} ang_dicom_stack;

/* The volume of `stack`, with the padding, rescale and checksum fields of `report` filled in. Where files cannot be
 * decoded, NULL with ANG_INPUT, and `failed` (count flags, by position in `order`) and `reasons` (strings to free) say
 * which; the caller may leave them out and try again. Peak memory: the volume, its padding mask, and for every thread
 * one slice (native: none). NULL too with ANG_LIMIT, ANG_INTERRUPTED. */
ang_volume *ang_dicom_assemble(const ang_dicom_stack *stack, ang_load_report *report, const ang_progress *progress,
                               bool *failed, char **reasons, ang_error *err);

#endif
