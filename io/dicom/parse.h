/* The data elements of a DICOM file, in order, without their values (DICOM PS3.5 section 7, PS3.10 section 7).
 *
 * Our own and not GDCM's: GDCM 3.0.21 as packaged has its assertions compiled in and ends the process on damaged
 * headers, and its image reader gives wrong geometry for multi-frame files (dicom-rules 12). */
#ifndef ANG_DICOM_PARSE_H
#define ANG_DICOM_PARSE_H

#include "core/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { ang_dicom_window_size = 8192, ang_dicom_value_size = 4096 };
#define ANG_DICOM_UNDEFINED           0xFFFFFFFFu
#define ANG_DICOM_TAG(group, element) ((uint32_t)(group) << 16 | (element))

/* An open file seen through a window, or a deflated data set in memory. Large: not for the stack of small threads. */
typedef struct ang_dicom_reader {
    int fd;
    uint8_t *memory; /* the inflated data set, owned; NULL where the file is read directly */
    uint64_t size;   /* bytes in the file or in `memory` */
    uint64_t window_at;
    size_t window_length;
    uint8_t window[ang_dicom_window_size];
    uint64_t next; /* offset of the next element */
    bool big_endian, is_explicit, in_meta;
    bool truncated; /* an element reaches beyond the end */
    bool overruled; /* the data set is not coded as its transfer syntax says */
    char transfer_syntax[65];
    char media_class[65]; /* MediaStorageSOPClassUID */
} ang_dicom_reader;

typedef struct ang_dicom_element {
    uint32_t tag;    /* group << 16 | element */
    char vr[3];      /* two letters, or empty where implicit */
    uint32_t length; /* bytes, or ANG_DICOM_UNDEFINED */
    uint64_t offset; /* of the value */
    bool big_endian;
} ang_dicom_element;

/* Elements or items that are still to be read. */
typedef struct ang_dicom_range {
    uint64_t next, end; /* offsets */
    bool is_explicit, big_endian;
} ang_dicom_range;

typedef enum ang_dicom_found {
    ANG_DICOM_FOUND,   /* a DICOM file */
    ANG_DICOM_FOREIGN, /* something else */
    ANG_DICOM_BROKEN,  /* DICOM, but unreadable: `err` says why */
} ang_dicom_found;

/* Opens `path` and finds the start and the coding of its data set, also where preamble, meta header or transfer syntax
 * are missing. `label` names the file in errors. Close with ang_dicom_close in every case. */
ang_dicom_found ang_dicom_open(ang_dicom_reader *reader, const char *path, const char *label, ang_error *err);
/* The same as far as the meta header: nothing is inflated, and nothing behind it may be read. */
ang_dicom_found ang_dicom_open_meta(ang_dicom_reader *reader, const char *path, const char *label, ang_error *err);
void ang_dicom_close(ang_dicom_reader *reader);

/* The next element of the data set's top level; sequences are stepped over. False at the end, with `truncated` set
 * where the file ends inside an element. */
bool ang_dicom_next(ang_dicom_reader *reader, ang_dicom_element *element);

/* The items of a sequence that ang_dicom_next or ang_dicom_next_in has found. */
ang_dicom_range ang_dicom_sequence(const ang_dicom_reader *reader, const ang_dicom_element *element);
/* The next item of a sequence; false where there is none, or where it is damaged. */
bool ang_dicom_next_item(ang_dicom_reader *reader, ang_dicom_range *sequence, ang_dicom_range *item);
/* The next element of an item; sequences are stepped over. False at its end, or where it is damaged. */
bool ang_dicom_next_in(ang_dicom_reader *reader, ang_dicom_range *range, ang_dicom_element *element);

/* `length` <= ang_dicom_value_size bytes at `offset`, valid until the next call; NULL beyond the end. */
const uint8_t *ang_dicom_bytes(ang_dicom_reader *reader, uint64_t offset, size_t length);
/* Gives an element whose VR the file does not know the one of the dictionary, "UL". */
void ang_dicom_assume_vr(ang_dicom_element *element, const char *vr);
/* The value as a trimmed string, cut to `size` bytes, control characters as blanks; false where it is empty or longer
 * than ang_dicom_value_size. */
bool ang_dicom_text(ang_dicom_reader *reader, const ang_dicom_element *element, char *out, size_t size);
/* The same with escape characters, which switch character sets (PS3.5 6.1.2.5): to be written to DICOM alone. */
bool ang_dicom_verbatim(ang_dicom_reader *reader, const ang_dicom_element *element, char *out, size_t size);
/* Numbers of a decimal or integer string, or of US, SS, UL, SL, FL, FD where the VR says so; returns how many (at most
 * `count`) there are. Not finite ones end the list, and those of a string with anything but blanks behind them. */
int ang_dicom_numbers(ang_dicom_reader *reader, const ang_dicom_element *element, double *out, int count);
/* The first 16-bit word of the value, read unsigned. */
bool ang_dicom_word(ang_dicom_reader *reader, const ang_dicom_element *element, uint16_t *out);

/* The data set of a file with the deflated transfer syntax, inflated into a new buffer (free with free()). The data set
 * starts at `offset` of the open file. NULL with ANG_INPUT or ANG_LIMIT. */
uint8_t *ang_dicom_inflate(int fd, uint64_t offset, uint64_t file_size, uint64_t *size, const char *label,
                           ang_error *err);

#endif
