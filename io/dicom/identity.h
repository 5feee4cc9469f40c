/* What a DICOM file says of patient and study, for files that are to lie beside it. Identifies. */
#ifndef ANG_DICOM_IDENTITY_H
#define ANG_DICOM_IDENTITY_H

#include <stdbool.h>
#include <stdint.h>

enum { ANG_IDENTITY_ELEMENTS = 24 };

/* How an element is to be handed on. */
typedef enum ang_identity_kind {
    ANG_IDENTITY_NAMES,   /* where patients may be identified; of type 2, so empty where not */
    ANG_IDENTITY_MAY,     /* where patients may be identified; absent where not, or where it is empty */
    ANG_IDENTITY_HARMLESS /* always: a value of the standard's */
} ang_identity_kind;

/* Values as the file's bytes, in its character set. Owns them; free with ang_identity_free. */
typedef struct ang_identity {
    char *value[ANG_IDENTITY_ELEMENTS]; /* in the order of identity.c's table; NULL: none */
} ang_identity;

/* Reads a file's. NULL where it is no DICOM or memory is out. */
ang_identity *ang_identity_read(const char *path);
void ang_identity_free(ang_identity *identity);

/* An element that is read: its VR and kind. One that is not gives NULL. */
const char *ang_identity_element(uint32_t tag, ang_identity_kind *kind);
/* Its value, "" where there is none or `identity` is NULL. */
const char *ang_identity_value(const ang_identity *identity, uint32_t tag);

#endif
