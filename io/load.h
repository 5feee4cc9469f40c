/* A path becomes a volume: DICOM files and folders, NIfTI-1, NRRD, MetaImage, stacks of pictures, raw; and zip archives
 * of any of these. */
#ifndef ANG_IO_LOAD_H
#define ANG_IO_LOAD_H

#include "core/base/error.h"
#include "core/base/notes.h"
#include "core/base/progress.h"
#include "core/volume/raw_slice.h"
#include "core/volume/volume.h"

#include <stdint.h>

/* How to read. Zero-initialised means default. */
typedef struct ang_load_options {
    /* --series: a number as listed (1, 2, ...) or the end of a SeriesInstanceUID; NULL: largest CT. Of
     * other formats each file of a folder or archive is a series, in the order of names: a number, or how its name
     * ends; NULL: the first. */
    const char *series;
    const char *series_choice; /* what picks another series, for a sentence of the report; NULL: "--series" */
    const char *phase_choice;  /* likewise another phase; NULL: "--phase" */
    int phase;                 /* --phase: 1, 2, ... of a series of several phases; 0: the first */
    /* Refused with ANG_USAGE where the input is not raw, unless raw_remembered. */
    const char *raw_dims;    /* --raw-dims "XxYxZ"; NULL: a JSON sidecar beside the file (NAME.json) must say it */
    const char *raw_type;    /* --raw-type u8 | i8 | u16 | i16 | f32, little endian */
    const char *raw_spacing; /* --raw-spacing "X,Y,Z" in mm; default 1,1,1 */
    /* Remembered by a state instead of typed: such a series, phase and form of raw input holds where it fits. */
    bool series_remembered, phase_remembered, raw_remembered;
    int threads;           /* 0: all */
    ang_slice_sink slices; /* is given the slices while they are read */
    bool strict;           /* any warning is an error (ANG_GEOMETRY) */
    bool no_sandbox;       /* codecs run in this process: see io/sandbox/sandbox.h */
} ang_load_options;

/* One 3D image series or what else was found, as listed by `info`. */
typedef struct ang_series_info {
    int number;        /* 1, 2, ... in the list */
    char modality[17]; /* a defined term, "other", or "?" where none is given */
    char *description; /* SeriesDescription: may identify a patient */
    char *patient;     /* PatientName as DICOM writes it: identifies; NULL: the format has none */
    char *uid;         /* SeriesInstanceUID: identifies */
    char date[11];     /* of the acquisition, "2024-05-17": may identify a patient; empty where none is given */
    int width, height, slices;
    double spacing_mm[3]; /* along rows, columns and the normal: the mean distance of its slices (dicom-rules 4) */
    int phases;           /* volumes of one place, one of which is loaded; 1 where the series is one volume */
    char **phase_text;    /* what each is, "temporal position 2", "trigger time 350 ms": `phases` texts that identify
                             nobody; NULL: numbers are all that is known */
    bool loadable;
    char *remark; /* why it is not loadable, or what it is: "localizer", "derived summary (SEC...)" */
} ang_series_info;

/* Where the slices lie along the normal. */
typedef struct ang_gap {
    int after;   /* gap between this slice (0-based, in order of position) and the next */
    double mm;   /* its length */
    int missing; /* slices missing and interpolated there; 0: irregular */
} ang_gap;

/* All that is known of the input beside the voxels. Free with ang_load_report_clear. */
typedef struct ang_load_report {
    char format[16];         /* "DICOM", "NIfTI-1", "NRRD", "MetaImage", "pictures", "raw" */
    ang_series_info *series; /* all series found; at least one for formats of one volume too */
    size_t series_count;
    int chosen;           /* index into `series` */
    int phase;            /* the one loaded, from 1 */
    int slices_read;      /* slices that went into the volume */
    int slices_duplicate; /* dropped: same position (InstanceNumber where positions are missing), same pixels */
    int slices_missing;   /* interpolated */
    ang_gap *gaps;        /* gaps that differ from the median */
    size_t gap_count;
    double slice_gap_median_mm, slice_gap_min_mm, slice_gap_max_mm;
    bool resampled;          /* irregular spacing resampled along the normal */
    double tilt_deg;         /* gantry tilt from the positions, 0 where none */
    double tilt_nominal_deg; /* tag (0018,1120), NaN where absent */
    bool signed_stored;      /* stored values were signed: 32768 was added */
    double slope, intercept; /* HU = slope * stored + intercept of stored values as the file has them, before 32768 was
                                added; NaN where slices differ or nothing was loaded */
    int bits_stored;
    bool padding_declared, padding_found; /* padding value from the tag; or from the corners */
    double padding_hu;       /* HU of the padding before it was replaced: of the declared where there is both */
    double padding_found_hu; /* HU of that in the corners; NaN where there is none */
    double rescale_error_hu; /* largest rounding error where slices have different rescale; 0 otherwise */
    double quantisation_hu;  /* step where float input was quantised; 0 otherwise */
    uint64_t nan_count, inf_count;
    struct ang_identity *identity;      /* of DICOM: patient and study (io/dicom/identity.h); NULL: none */
    uint32_t stored_crc32;              /* DESIGN.md, "Padding": stored values before padding was replaced */
    double window_centre, window_width; /* first window of the file; NaN where none */
    ang_notes assumptions, warnings;
} ang_load_report;

void ang_load_report_clear(ang_load_report *report);
/* What phase `phase`, from 1, of a series is: its text, or "". */
const char *ang_series_phase_text(const ang_series_info *info, int phase);
/* Whether the values are Hounsfield units: DICOM of modality CT. Others go through the same map, as numbers. */
bool ang_load_report_hounsfield(const ang_load_report *report);

/* Reads `path` into a new volume (free with ang_volume_free) and fills `report`, also as far as it came where it fails.
 * NULL with ANG_USAGE (an option or a sidecar is wrong), ANG_INPUT (also for values beyond
 * ANG_TRANSFER_HU_LIMIT), ANG_GEOMETRY (also for spacings outside 1e-6 to 1e6 mm), ANG_LIMIT, ANG_INTERRUPTED. A file
 * that cannot be read costs a warning about it where others of its series can; its base name is the note's `file`. */
ang_volume *ang_load(const char *path, const ang_load_options *options, ang_load_report *report,
                     const ang_progress *progress, ang_error *err);

/* The same for several files and folders, `count` >= 1, taken as one input: the DICOM files at and below all of them;
 * where there are none, each that is of another format is a series. */
ang_volume *ang_load_all(const char *const *paths, size_t count, const ang_load_options *options,
                         ang_load_report *report, const ang_progress *progress, ang_error *err);

/* Whether loading `input` reads the file `path`: it is the input, its sidecar, a file of its voxels or what is read in
 * the folder. To be asked before `path` is overwritten. Thread safe. */
bool ang_load_reads(const char *input, const char *path);

#endif
