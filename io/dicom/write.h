/* Writes a volume as a DICOM CT series. */
#ifndef ANG_IO_DICOM_WRITE_H
#define ANG_IO_DICOM_WRITE_H

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/volume/volume.h"

/* Writes IM0001.dcm, IM0002.dcm, ... into `folder` (made where it does not exist), one CT Image Storage object
 * (DICOM PS3.3 A.3) a slice along the volume's z axis: Explicit VR Little Endian, 16 bits unsigned, stored values as
 * they are with slope and intercept, positions from the affine (a sheared affine becomes a tilted gantry's positions).
 * Padding is written as the -1000 HU it has become. The patient is "Phantom^Angioscope", dates are fixed, and the UIDs
 * (2.25, PS3.5 B.2) follow from `seed` and the contents: the same volume gives the same bytes. All are
 * written before the first appears, so that no part of a series is left where the disk is full. False with ANG_OUTPUT
 * (a folder that cannot be written, or that holds IM files which would be mixed into the series), ANG_GEOMETRY (rows
 * and columns not at right angles or no length, which the image plane module cannot state), ANG_USAGE (a build without
 * GDCM), ANG_LIMIT, ANG_INTERRUPTED. Thread safe for different folders. */
bool ang_dicom_write(const char *folder, const ang_volume *volume, uint64_t seed, const ang_progress *progress,
                     ang_error *err);

#endif
