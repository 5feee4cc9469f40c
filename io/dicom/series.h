/* Which slices make one volume: grouping, localizers, phases, duplicates (dicom-rules 1 and 6). Pure functions over
 * slice records. */
#ifndef ANG_DICOM_SERIES_H
#define ANG_DICOM_SERIES_H

#include "core/base/error.h"
#include "core/base/notes.h"
#include "io/dicom/slice.h"

/* Slices that may be one volume, or else what they are. */
typedef struct ang_dicom_group {
    size_t *order; /* indices into the slices, sorted by position; duplicates and unreadable doubles left out */
    size_t count;
    int duplicates;      /* dropped: same position (same InstanceNumber where positions are missing), same pixels */
    int phases;          /* > 1: one of several volumes at the same positions */
    int phase;           /* which of them it is, from 1 */
    int set, part;       /* groups of one set, above 0, and part are the phases of one series in the list */
    int series;          /* its number in the list, from 1 */
    char phase_text[64]; /* what it is of the phases */
    int acquisitions;    /* > 1: one of several acquisitions in its series that do not continue one another */
    int stacks;          /* > 1: one of several stacks with more slices missing between them than there are */
    bool loadable;
    bool derived;     /* ImageType DERIVED\SECONDARY or a secondary capture: loaded only where nothing else is */
    char remark[128]; /* why it is not loadable, or what it is */
} ang_dicom_group;

/* In the order in which they are listed, the phases of a series one after the other. Owns its groups; free with
 * ang_dicom_groups_clear. */
typedef struct ang_dicom_groups {
    ang_dicom_group *group;
    size_t count;
    int series_count; /* in the list */
} ang_dicom_groups;

/* Whether two slices may be of one patient: by PatientID, by PatientName where one has no ID. */
bool ang_dicom_same_patient(const ang_dicom_slice *a, const ang_dicom_slice *b);

/* Whether two images are alike in size, orientation and spacing, whatever they show. */
bool ang_dicom_same_planes(const ang_dicom_slice *a, const ang_dicom_slice *b);

/* How the pixels of two slices compare. */
typedef enum ang_dicom_likeness {
    ANG_DICOM_SAME,
    ANG_DICOM_DIFFERENT,
    ANG_DICOM_FIRST_UNREADABLE,  /* the first cannot be decoded; nothing is said of the second */
    ANG_DICOM_SECOND_UNREADABLE, /* the second cannot be decoded, the first can */
    ANG_DICOM_NOT_COMPARED,      /* no memory: `err` says so */
} ang_dicom_likeness;

/* Compares slices `a` and `b` (indices). It keeps itself what is to be said of one that is unreadable: that slice is
 * left out. */
typedef ang_dicom_likeness ang_dicom_compare(void *context, size_t a, size_t b, ang_error *err);

/* Groups `count` slices. `compare` is asked only about slices at one position, or of one InstanceNumber where positions
 * are missing; NULL: all are different. ANG_LIMIT. */
bool ang_dicom_group_slices(const ang_dicom_slice *slices, size_t count, ang_dicom_compare *compare, void *context,
                            ang_dicom_groups *groups, ang_error *err);
void ang_dicom_groups_clear(ang_dicom_groups *groups);

/* The group of series `number`, from 1, and of its first phase. */
size_t ang_dicom_series_start(const ang_dicom_groups *groups, int number);

#endif
