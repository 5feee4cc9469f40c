/* From the words of a DICOM image to the volume's 16-bit values, and from those to HU (dicom-rules 8 to 10). Pure
 * functions. */
#ifndef ANG_DICOM_STORED_H
#define ANG_DICOM_STORED_H

#include "core/base/error.h"
#include "core/base/notes.h"
#include "core/volume/raw_slice.h"
#include "io/dicom/slice.h"

/* How the words are coded. */
typedef struct ang_dicom_words {
    int bytes;       /* 1, 2 or 4 a word */
    int bits_stored; /* 1 to 16 */
    int high_bit;    /* bits_stored - 1 to 8 * bytes - 1 */
    bool is_signed;
    bool big_endian;
} ang_dicom_words;

/* The words of an uncompressed slice. */
ang_dicom_words ang_dicom_words_of(const ang_dicom_slice *slice);

/* `count` words at `raw` (any alignment) become values at `out`: the bits below and at HighBit, sign-extended where
 * signed, plus 32768 where signed (PS3.5 8.1.1). `raw` may be `out` where a word has two bytes. Returns whether other
 * bits were set: copies of the sign where signed are none, overlays of old files are. */
bool ang_dicom_convert(const void *raw, size_t count, ang_dicom_words words, uint16_t *out);

/* HU = slope * value + intercept, of the values that ang_dicom_convert writes. */
typedef struct ang_dicom_map {
    double slope, intercept;
} ang_dicom_map;

/* The slice's own map: slope 0 or missing is 1, intercept missing is 0. */
ang_dicom_map ang_dicom_map_of(const ang_dicom_slice *slice);

/* The slice as it is shown by itself: `values` as ang_dicom_convert writes them. */
ang_raw_slice ang_dicom_raw_slice(const ang_dicom_slice *slice, const uint16_t *values);

/* The values of slice's padding, as ang_dicom_convert writes them: first to last, both included. False where none is
 * declared or where it does not fit the stored bits and so cannot occur. */
bool ang_dicom_padding(const ang_dicom_slice *slice, uint16_t *first, uint16_t *last);

/* One map for slices that have `count` maps, each used for values first[i] to last[i] (first > last: none). `same` says
 * that all maps are equal and have a slope > 0: the values stay as they are. Otherwise ang_dicom_remap takes the values
 * over, with an error of at most `error_hu`. */
typedef struct ang_dicom_common {
    bool same;
    ang_dicom_map map;
    double error_hu;
} ang_dicom_common;

ang_dicom_common ang_dicom_merge(const ang_dicom_map *maps, const uint16_t *first, const uint16_t *last, size_t count);

/* Shifts the map of `common` by whole values where -1000 HU, what padding becomes, lies below its first value and 16
 * bits hold the shifted values up to the greatest of last[...]: `same` becomes false then. Nothing is rounded. */
void ang_dicom_make_room(ang_dicom_common *common, const uint16_t *last, size_t count);

/* The value under `to` that is nearest to what `value` means under `from`, clamped to 16 bits. */
uint16_t ang_dicom_remap(uint16_t value, ang_dicom_map from, ang_dicom_map to);

#endif
