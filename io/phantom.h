/* The phantom on disk: a DICOM series and what is true of it. */
#ifndef ANG_IO_PHANTOM_H
#define ANG_IO_PHANTOM_H

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/volume/phantom.h"

/* Writes `truth` as JSON to `path`: positions in LPS mm, diameters and radii in mm, HU; every vessel with its name,
 * points and radii. False with ANG_OUTPUT, ANG_LIMIT. Thread safe. */
bool ang_phantom_truth_write(const char *path, const ang_phantom_truth *truth, ang_error *err);

/* Makes a phantom and writes it into `folder` as IM0001.dcm, ... (io/dicom/write.h) with truth.json beside them.
 * `threads` 0: all. False with the errors of ang_phantom_make and ang_dicom_write. Thread safe for different folders.
 */
bool ang_phantom_write(const char *folder, const ang_phantom_params *params, int threads, const ang_progress *progress,
                       ang_error *err);

#endif
