#include "io/dicom/terms.h"

#include <stddef.h>
#include <string.h>

static const char other[] = "other";

static const char *find(const char *const *terms, const char *text) {
    for (; *terms; terms++)
        if (strcmp(*terms, text) == 0) return *terms;
    return other;
}

const char *ang_dicom_modality(const char *text) {
    static const char *const terms[] = {
        "ANN",      "AR",  "AS",  "ASMT",   "AU",      "BDUS",       "BI",     "BMD",   "CD",       "CF",
        "CFM",      "CP",  "CR",  "CS",     "CT",      "CTPROTOCOL", "DD",     "DF",    "DG",       "DM",
        "DMS",      "DOC", "DS",  "DX",     "EC",      "ECG",        "EEG",    "EMG",   "EOG",      "EPS",
        "ES",       "FA",  "FID", "FS",     "GM",      "HC",         "HD",     "IO",    "IOL",      "IVOCT",
        "IVUS",     "KER", "KO",  "LEN",    "LP",      "LS",         "M3D",    "MA",    "MG",       "MR",
        "MS",       "NM",  "OAM", "OCT",    "OP",      "OPM",        "OPR",    "OPT",   "OPTBSV",   "OPTENF",
        "OPV",      "OSS", "OT",  "PA",     "PLAN",    "POS",        "PR",     "PT",    "PX",       "REG",
        "RESP",     "RF",  "RG",  "RTDOSE", "RTIMAGE", "RTINTENT",   "RTPLAN", "RTRAD", "RTRECORD", "RTSEGANN",
        "RTSTRUCT", "RWV", "SEG", "SM",     "SMR",     "SR",         "SRF",    "ST",    "STAIN",    "TEXTUREMAP",
        "TG",       "US",  "VA",  "VF",     "XA",      "XAPROTOCOL", "XC",     NULL};
    return find(terms, text);
}

const char *ang_dicom_image_kind(const char *text) {
    static const char *const terms[] = {
        "AXIAL",  "LOCALIZER",    "DENSITY MAP", "DIFFUSION MAP",  "IMAGE ADDITION",   "MODULUS SUBTRACT",
        "MPR",    "OTHER",        "PHASE MAP",   "PHASE SUBTRACT", "PROJECTION IMAGE", "T1 MAP",
        "T2 MAP", "VELOCITY MAP", NULL};
    return find(terms, text);
}

const char *ang_dicom_class_name(const char *uid) {
    static const struct {
        const char *end, *name; /* after 1.2.840.10008.5.1.4.1.1. */
    } classes[] = {{"1", "Computed Radiography image"},
                   {"2", "CT image"},
                   {"2.1", "Enhanced CT image"},
                   {"4", "MR image"},
                   {"4.1", "Enhanced MR image"},
                   {"7", "Secondary Capture image"},
                   {"11.1", "Grayscale Softcopy Presentation State"},
                   {"66", "Raw Data"},
                   {"66.1", "Spatial Registration"},
                   {"66.4", "Segmentation"},
                   {"67", "Real World Value Mapping"},
                   {"88.11", "Basic Text SR"},
                   {"88.22", "Enhanced SR"},
                   {"88.33", "Comprehensive SR"},
                   {"88.59", "Key Object Selection"},
                   {"88.67", "X-Ray Radiation Dose SR"},
                   {"104.1", "Encapsulated PDF"},
                   {"128", "PET image"},
                   {"481.2", "RT Dose"},
                   {"481.3", "RT Structure Set"},
                   {"481.5", "RT Plan"}};
    static const char root[] = "1.2.840.10008.5.1.4.1.1.";
    if (strncmp(uid, root, sizeof root - 1) != 0) return other;
    for (size_t i = 0; i < sizeof classes / sizeof *classes; i++)
        if (strcmp(classes[i].end, uid + sizeof root - 1) == 0) return classes[i].name;
    return other;
}

bool ang_dicom_is_transfer_syntax(const char *uid) {
    static const char root[] = "1.2.840.10008.1.2", longest[] = "1.2.840.10008.1.2.4.106.1";
    size_t length = strlen(uid);
    return strncmp(uid, root, sizeof root - 1) == 0 && length < sizeof longest && strspn(uid, "0123456789.") == length;
}
