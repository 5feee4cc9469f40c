/* A preset: how a radiologist wants to see a kind of study. The files are read by io/preset/preset.h. */
#ifndef ANG_TRANSFER_PRESET_H
#define ANG_TRANSFER_PRESET_H

#include "core/scene/scene.h"
#include "core/transfer/transfer.h"

/* Owns its strings and its transfer function. */
typedef struct ang_preset {
    char *name;        /* as in --preset, e.g. "cta-head" */
    char *modality;    /* "CT", "CTA", "MRA", ... */
    char *description; /* one sentence for the user */
    int version;       /* of the file's form: 1 */
    ang_mode mode;
    ang_shading shading;
    ang_phong phong;
    double iso_hu;                      /* for mode iso; NaN where the preset does not say */
    double window_centre, window_width; /* HU; width > 0; for mip, minip, mean */
    ang_transfer *transfer;
} ang_preset;

void ang_preset_free(ang_preset *preset);

#endif
