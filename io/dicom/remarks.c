#include "io/dicom/remarks.h"

#include "io/dicom/stored.h"
#include "io/dicom/terms.h"

#include <string.h>

/* A map that cannot be read makes the values wrong, wherever it is. */
static void note_bad_rescale(const ang_dicom_slice *slices, const ang_dicom_group *group, ang_notes *warnings) {
    int slopes = 0, intercepts = 0;
    for (size_t i = 0; i < group->count; i++) {
        slopes += slices[group->order[i]].bad_slope;
        intercepts += slices[group->order[i]].bad_intercept;
    }
    if (slopes)
        ang_notes_add(warnings, "(0028,1053) RescaleSlope is invalid in %d slice%s: 1 is taken", slopes,
                      ang_plural(slopes));
    if (intercepts)
        ang_notes_add(warnings, "(0028,1052) RescaleIntercept is invalid in %d slice%s: 0 is taken", intercepts,
                      ang_plural(intercepts));
}

/* Everything that the header says and that the values do not follow, or that it leaves open. */
static void note_first(const ang_dicom_slice *first, ang_notes *assumptions, ang_notes *warnings) {
    if (strcmp(first->modality, "CT") != 0)
        ang_notes_add(warnings, "modality is %s, not CT: values are not Hounsfield units",
                      first->modality[0] ? ang_dicom_modality(first->modality) : "not given");
    if (first->bad_slope || first->bad_intercept) {
        /* note_bad_rescale has said it */
    } else if (!first->has_slope && !first->has_intercept)
        ang_notes_add(assumptions, "RescaleSlope and RescaleIntercept are missing: 1 and 0 are taken");
    else if (!first->has_slope || first->slope == 0)
        ang_notes_add(assumptions, "RescaleSlope is missing or 0: 1 is taken");
    else if (!first->has_intercept)
        ang_notes_add(assumptions, "RescaleIntercept is missing: 0 is taken");
    if (ang_dicom_map_of(first).slope < 0)
        ang_notes_add(assumptions, "RescaleSlope is negative: stored values were turned over, the result is the same");
    if (strcmp(first->photometric, "MONOCHROME1") == 0)
        ang_notes_add(assumptions, "MONOCHROME1 is a matter of display: values are as stored");
    uint16_t low, high;
    if (first->has_padding && !ang_dicom_padding(first, &low, &high))
        ang_notes_add(assumptions, "the declared padding value %u does not fit %d stored bits: ignored", first->padding,
                      first->bits_stored);
}

/* What the first slice need not say: it may be any of them. */
static void note_any(const ang_dicom_slice *slices, const ang_dicom_group *group, ang_notes *warnings) {
    bool unit = false, offsets = false, lossy = false, syntax = false;
    for (size_t i = 0; i < group->count; i++) {
        const ang_dicom_slice *slice = &slices[group->order[i]];
        unit = unit || (slice->other_unit && strcmp(slice->modality, "CT") == 0);
        offsets = offsets || slice->wrong_offsets;
        lossy = lossy || slice->lossy;
        syntax = syntax || slice->wrong_syntax;
    }
    if (lossy) ang_notes_add(warnings, "the pictures were compressed with loss: values are approximate");
    if (syntax)
        ang_notes_add(warnings,
                      "(0002,0010) TransferSyntaxUID does not fit: how the file is coded was found by looking");
    if (unit) ang_notes_add(warnings, "(0028,1054) RescaleType is not HU: values may not be Hounsfield units");
    if (offsets)
        ang_notes_add(warnings, "(7FE0,0010) PixelData: the table of frames is wrong; its fragments tell them apart");
}

void ang_dicom_note_values(const ang_dicom_slice *slices, const ang_dicom_group *group, ang_notes *assumptions,
                           ang_notes *warnings) {
    note_bad_rescale(slices, group, warnings);
    note_first(&slices[group->order[0]], assumptions, warnings);
    note_any(slices, group, warnings);
}
