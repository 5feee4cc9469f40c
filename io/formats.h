/* The readers behind ang_load. */
#ifndef ANG_IO_FORMATS_H
#define ANG_IO_FORMATS_H

#include "io/load.h"

/* The file's name without its folders: what messages call it. */
const char *ang_base_name(const char *path);

/* Which of the phases of `what` ("series 2", a file) the options ask for, from 1. False with ANG_INPUT where it has no
 * such. */
bool ang_load_phase(const char *what, int phases, const ang_load_options *options, int *phase, ang_error *err);

/* A report of which nothing is known yet. */
void ang_load_report_start(ang_load_report *report);

/* Whether the file begins like NIfTI-1, gzipped or not. */
bool ang_nifti_probe(const char *path);
/* The same for NIfTI-2, which is not read. */
bool ang_nifti2_probe(const char *path);
/* As ang_load, for NIfTI-1 (.nii, .nii.gz, or .hdr beside .img). Affine from sform, else qform, else pixdim; RAS to
 * LPS. */
ang_volume *ang_nifti_load(const char *path, const ang_load_options *options, ang_load_report *report,
                           const ang_progress *progress, ang_error *err);

/* As ang_load, for NRRD (.nrrd, or .nhdr with files of voxels) and MetaImage (.mha, or .mhd with the same). */
ang_volume *ang_nrrd_load(const char *path, const ang_load_options *options, ang_load_report *report,
                          const ang_progress *progress, ang_error *err);
ang_volume *ang_metaimage_load(const char *path, const ang_load_options *options, ang_load_report *report,
                               const ang_progress *progress, ang_error *err);
/* Whether the header `path`, of either, names `file` as one that holds its voxels. */
bool ang_header_names(const char *path, bool nrrd, const char *file);

/* Whether the options or a sidecar NAME.json describe the file as raw. */
bool ang_raw_probe(const char *path, const ang_load_options *options);
/* The sidecar's path: NAME.json, where NAME is the file with all, one or two of its endings. NULL where there is none.
 * To be freed. */
char *ang_raw_sidecar(const char *path);
/* As ang_load, for voxels without a header, gzipped or not. The volume's x, y, z are the patient's left, posterior,
 * superior; its centre is the origin. */
ang_volume *ang_raw_load(const char *path, const ang_load_options *options, ang_load_report *report,
                         const ang_progress *progress, ang_error *err);

#endif
