#include "io/dicom/identity.h"

#include "io/dicom/parse.h"
#include "io/dicom/terms.h"

#include <stdlib.h>
#include <string.h>

/* In order of tags. */
static const struct {
    uint32_t tag;
    char vr[3];
    ang_identity_kind kind;
} elements[] = {
    {0x00080005, "CS", ANG_IDENTITY_MAY},      /* SpecificCharacterSet */
    {0x00080020, "DA", ANG_IDENTITY_NAMES},    /* StudyDate */
    {0x00080030, "TM", ANG_IDENTITY_NAMES},    /* StudyTime */
    {0x00080050, "SH", ANG_IDENTITY_NAMES},    /* AccessionNumber */
    {0x00080060, "CS", ANG_IDENTITY_HARMLESS}, /* Modality */
    {0x00080090, "PN", ANG_IDENTITY_NAMES},    /* ReferringPhysicianName */
    {0x00081030, "LO", ANG_IDENTITY_MAY},      /* StudyDescription */
    {0x00100010, "PN", ANG_IDENTITY_NAMES},    /* PatientName */
    {0x00100020, "LO", ANG_IDENTITY_NAMES},    /* PatientID */
    {0x00100021, "LO", ANG_IDENTITY_MAY},      /* IssuerOfPatientID */
    {0x00100030, "DA", ANG_IDENTITY_NAMES},    /* PatientBirthDate */
    {0x00100040, "CS", ANG_IDENTITY_NAMES},    /* PatientSex */
    {0x00101010, "AS", ANG_IDENTITY_MAY},      /* PatientAge */
    {0x00101020, "DS", ANG_IDENTITY_MAY},      /* PatientSize */
    {0x00101030, "DS", ANG_IDENTITY_MAY},      /* PatientWeight */
    {0x00120062, "CS", ANG_IDENTITY_MAY},      /* PatientIdentityRemoved */
    {0x00120063, "LO", ANG_IDENTITY_MAY},      /* DeidentificationMethod */
    {0x0020000D, "UI", ANG_IDENTITY_MAY},      /* StudyInstanceUID */
    {0x00200010, "SH", ANG_IDENTITY_NAMES},    /* StudyID */
    {0x00282110, "CS", ANG_IDENTITY_HARMLESS}, /* LossyImageCompression */
};
enum { COUNT = sizeof elements / sizeof *elements };
_Static_assert((int)COUNT <= (int)ANG_IDENTITY_ELEMENTS, "ang_identity.value is too short");

static int index_of(uint32_t tag) {
    int i = 0;
    while (i < COUNT && elements[i].tag != tag) i++;
    return i < COUNT ? i : -1;
}

const char *ang_identity_element(uint32_t tag, ang_identity_kind *kind) {
    int i = index_of(tag);
    if (i < 0) return NULL;
    *kind = elements[i].kind;
    return elements[i].vr;
}

const char *ang_identity_value(const ang_identity *identity, uint32_t tag) {
    int i = index_of(tag);
    return identity && i >= 0 && identity->value[i] ? identity->value[i] : "";
}

static bool harmless(uint32_t tag, const char *value) {
    if (tag == 0x00282110) return strcmp(value, "00") == 0 || strcmp(value, "01") == 0;
    return strcmp(ang_dicom_modality(value), "other") != 0;
}

static bool take(ang_identity *identity, ang_dicom_reader *reader) {
    ang_dicom_element element;
    char text[ang_dicom_value_size + 1];
    while (ang_dicom_next(reader, &element) && element.tag < 0x7FE00010) {
        int i = index_of(element.tag);
        if (i < 0 || identity->value[i] || !ang_dicom_verbatim(reader, &element, text, sizeof text)) continue;
        if (elements[i].kind == ANG_IDENTITY_HARMLESS && !harmless(elements[i].tag, text)) continue;
        identity->value[i] = strdup(text);
        if (!identity->value[i]) return false;
    }
    return true;
}

ang_identity *ang_identity_read(const char *path) {
    ang_dicom_reader *reader = malloc(sizeof *reader);
    ang_identity *identity = reader ? calloc(1, sizeof *identity) : NULL;
    bool read = false;
    if (identity) {
        ang_error ignored;
        read = ang_dicom_open(reader, path, "", &ignored) == ANG_DICOM_FOUND && take(identity, reader);
        ang_dicom_close(reader);
    }
    free(reader);
    if (read) return identity;
    ang_identity_free(identity);
    return NULL;
}

void ang_identity_free(ang_identity *identity) {
    if (!identity) return;
    for (int i = 0; i < COUNT; i++) free(identity->value[i]);
    free(identity);
}
