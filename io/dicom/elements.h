/* Data elements as bytes of a file in Explicit VR Little Endian (DICOM PS3.5 section 7, A.2). Private to io/dicom/. */
#ifndef ANG_DICOM_ELEMENTS_H
#define ANG_DICOM_ELEMENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A growing data set. Zero-initialise; free `data` with free(). Elements are appended in rising order of tags. */
typedef struct ang_dicom_elements {
    unsigned char *data;
    size_t size, room;
    bool failed; /* memory was out: what is there is of no use */
} ang_dicom_elements;

/* A text value of one of the VRs AE AS CS DA DS DT IS LO LT PN SH ST TM UI, at most 65534 bytes, padded to even length.
 * "" is an empty value. */
void ang_elements_text(ang_dicom_elements *to, uint32_t tag, const char *vr, const char *value);
/* One value of VR US. */
void ang_elements_short(ang_dicom_elements *to, uint32_t tag, unsigned value);
/* Bytes of VR OB, padded to even length. */
void ang_elements_bytes(ang_dicom_elements *to, uint32_t tag, const void *bytes, size_t size);
/* A sequence of one item with the elements of `item`. */
void ang_elements_sequence(ang_dicom_elements *to, uint32_t tag, const ang_dicom_elements *item);
/* A whole file in front of which preamble, prefix and the meta header (PS3.10 7.1) of this object are put. */
void ang_elements_file(ang_dicom_elements *to, const char *sop_class, const char *sop_instance,
                       const ang_dicom_elements *data_set);

/* "2.25." and a UUID in decimal (PS3.5 B.2) of these 16 bytes, big end first, once the bits of its `version` and its
 * variant are set (RFC 9562): 4 is random, 8 of our own making. */
void ang_dicom_uuid_uid(unsigned char bytes[16], int version, char uid[65]);
/* One of random bytes. False where the system has no random numbers. */
bool ang_dicom_random_uid(char uid[65]);

#endif
