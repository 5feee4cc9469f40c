#include "io/dicom/header.h"

#include "io/dicom/attributes.h"
#include "io/dicom/fragments.h"
#include "io/dicom/frames.h"
#include "io/dicom/stream.h"
#include "io/dicom/terms.h"
#include "io/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the loop over the elements has seen; the record holds the rest. */
typedef struct seen {
    bool rows, columns, bits_allocated, bits_stored, high_bit, representation;
    bool odd_representation; /* neither 0 nor 1 */
    bool pixels, float_pixels;
    uint32_t pixel_length;
    ang_dicom_multi_frame multi; /* what describes the frames */
    char character_set[65];
    char acquisition_date[17], content_date[17], acquisition_time[21], content_time[21];
} seen;

void ang_dicom_value(const char *values, int index, char *out, size_t size) {
    out[0] = 0;
    for (; index > 0; index--) {
        values = strchr(values, '\\');
        if (!values) return;
        values++;
    }
    size_t length = strcspn(values, "\\");
    while (length && values[length - 1] == ' ') length--;
    if (length >= size) length = size - 1;
    memcpy(out, values, length);
    out[length] = 0;
}

size_t ang_dicom_pixel_bytes(const ang_dicom_slice *slice) {
    if (slice->rows < 1 || slice->columns < 1) return 0;
    size_t bytes = (size_t)(slice->bits_allocated + 7) / 8;
    return (size_t)slice->rows * (size_t)slice->columns * (size_t)slice->samples * bytes;
}

static bool integer(ang_dicom_reader *reader, const ang_dicom_element *element, int *out) {
    double value;
    if (ang_dicom_numbers(reader, element, &value, 1) != 1 || fabs(value) > 2147483647.0) return false;
    *out = (int)value;
    return true;
}

/* A US attribute; with implicit VR its bytes are no text. */
static bool word(ang_dicom_reader *reader, const ang_dicom_element *element, int *out) {
    uint16_t value;
    if (!ang_dicom_word(reader, element, &value)) return false;
    *out = value;
    return true;
}

/* PS3.3 C.12.1.1.2: Latin-1 is taken over; of other sets than UTF-8 what is not ASCII becomes '?'. */
static void take_words(ang_dicom_reader *r, const ang_dicom_element *e, const char *set, char out[257]) {
    char text[257];
    bool latin1 = strcmp(set, "ISO_IR 100") == 0 || strcmp(set, "ISO 2022 IR 100") == 0;
    ang_dicom_text(r, e, text, sizeof text);
    if (latin1)
        ang_text_from_latin1(text, out, sizeof text);
    else
        snprintf(out, sizeof text, "%s", text);
    ang_text_clean(out);
}

static void take_identity(ang_dicom_reader *r, const ang_dicom_element *e, ang_dicom_slice *s, seen *seen) {
    switch (e->tag) {
    case ANG_DICOM_TAG(0x0008, 0x0005):
        ang_dicom_text(r, e, seen->character_set, sizeof seen->character_set);
        break;
    case ANG_DICOM_TAG(0x0008, 0x0008):
        ang_dicom_text(r, e, s->image_type, sizeof s->image_type);
        break;
    case ANG_DICOM_TAG(0x0008, 0x0016):
        ang_dicom_text(r, e, s->sop_class, sizeof s->sop_class);
        break;
    case ANG_DICOM_TAG(0x0008, 0x0022):
        ang_dicom_text(r, e, seen->acquisition_date, sizeof seen->acquisition_date);
        break;
    case ANG_DICOM_TAG(0x0008, 0x0023):
        ang_dicom_text(r, e, seen->content_date, sizeof seen->content_date);
        break;
    case ANG_DICOM_TAG(0x0008, 0x0032):
        ang_dicom_text(r, e, seen->acquisition_time, sizeof seen->acquisition_time);
        break;
    case ANG_DICOM_TAG(0x0008, 0x0033):
        ang_dicom_text(r, e, seen->content_time, sizeof seen->content_time);
        break;
    case ANG_DICOM_TAG(0x0008, 0x0060):
        ang_dicom_text(r, e, s->modality, sizeof s->modality);
        break;
    case ANG_DICOM_TAG(0x0008, 0x103E):
        take_words(r, e, seen->character_set, s->description);
        break;
    case ANG_DICOM_TAG(0x0010, 0x0010):
        take_words(r, e, seen->character_set, s->patient);
        break;
    case ANG_DICOM_TAG(0x0010, 0x0020):
        ang_dicom_text(r, e, s->patient_id, sizeof s->patient_id);
        break;
    case ANG_DICOM_TAG(0x0020, 0x000E):
        ang_dicom_text(r, e, s->series_uid, sizeof s->series_uid);
        break;
    case ANG_DICOM_TAG(0x0020, 0x0011):
        s->has_series_number = integer(r, e, &s->series_number);
        break;
    case ANG_DICOM_TAG(0x0020, 0x0012):
        s->has_acquisition_number = integer(r, e, &s->acquisition_number);
        break;
    case ANG_DICOM_TAG(0x0020, 0x0013):
        s->has_instance_number = integer(r, e, &s->instance_number);
        break;
    case ANG_DICOM_TAG(0x0020, 0x0100):
        s->has_temporal_position = integer(r, e, &s->temporal_position);
        break;
    case ANG_DICOM_TAG(0x0020, 0x9161):
        ang_dicom_text(r, e, s->object, sizeof s->object);
        break;
    case ANG_DICOM_TAG(0x0020, 0x9222):
        seen->multi.dimensions = *e;
        break;
    case ANG_DICOM_TAG(0x0020, 0x9228):
        seen->multi.first_frame = *e;
        break;
    case ANG_DICOM_TAG(0x0020, 0x9056):
        ang_dicom_text(r, e, s->stack_id, sizeof s->stack_id);
        break;
    default:
        break;
    }
}

static void take_pixels(ang_dicom_reader *r, const ang_dicom_element *e, ang_dicom_slice *s, seen *seen) {
    int number = 0;
    char text[17];
    switch (e->tag) {
    case ANG_DICOM_TAG(0x0028, 0x0002):
        word(r, e, &s->samples);
        break;
    case ANG_DICOM_TAG(0x0028, 0x0004):
        ang_dicom_text(r, e, s->photometric, sizeof s->photometric);
        break;
    case ANG_DICOM_TAG(0x0028, 0x0008):
        if (integer(r, e, &number)) s->frames = number;
        break;
    case ANG_DICOM_TAG(0x0028, 0x0010):
        seen->rows = word(r, e, &s->rows);
        break;
    case ANG_DICOM_TAG(0x0028, 0x0011):
        seen->columns = word(r, e, &s->columns);
        break;
    case ANG_DICOM_TAG(0x0028, 0x0100):
        seen->bits_allocated = word(r, e, &s->bits_allocated);
        break;
    case ANG_DICOM_TAG(0x0028, 0x0101):
        seen->bits_stored = word(r, e, &s->bits_stored);
        break;
    case ANG_DICOM_TAG(0x0028, 0x0102):
        seen->high_bit = word(r, e, &s->high_bit);
        break;
    case ANG_DICOM_TAG(0x0028, 0x0103):
        seen->representation = word(r, e, &number);
        s->is_signed = number == 1;
        seen->odd_representation = seen->representation && number != 0 && number != 1;
        break;
    case ANG_DICOM_TAG(0x0028, 0x0120):
        s->has_padding = ang_dicom_word(r, e, &s->padding);
        break;
    case ANG_DICOM_TAG(0x0028, 0x0121):
        s->has_padding_limit = ang_dicom_word(r, e, &s->padding_limit);
        break;
    case ANG_DICOM_TAG(0x0028, 0x2110):
        s->lossy = ang_dicom_text(r, e, text, sizeof text) && strcmp(text, "01") == 0;
        break;
    case ANG_DICOM_TAG(0x5200, 0x9229):
        seen->multi.shared = *e;
        break;
    case ANG_DICOM_TAG(0x5200, 0x9230):
        seen->multi.per_frame = *e;
        break;
    case ANG_DICOM_TAG(0x7FE0, 0x0001):
        seen->multi.offsets = *e;
        break;
    case ANG_DICOM_TAG(0x7FE0, 0x0008):
    case ANG_DICOM_TAG(0x7FE0, 0x0009):
        seen->float_pixels = true;
        break;
    case ANG_DICOM_TAG(0x7FE0, 0x0010):
        seen->pixels = true;
        seen->pixel_length = e->length;
        s->pixel_offset = e->offset;
        break;
    default:
        break;
    }
}

static void join(char *out, size_t size, const char *date, const char *time) {
    snprintf(out, size, "%s%s%s", date, date[0] && time[0] ? " " : "", time);
}

static bool starts(const char *text, const char *prefix) { return strncmp(text, prefix, strlen(prefix)) == 0; }

static bool has_groups(const seen *seen) { return seen->multi.shared.tag || seen->multi.per_frame.tag; }

/* False where the class says that there never were pixels. */
static bool may_be_image(const ang_dicom_slice *s) {
    const char *name = ang_dicom_class_name(s->sop_class);
    return strcmp(name, "other") == 0 || strstr(name, "image");
}

/* True where the file is an image of pixels; else says what it is instead. */
static bool check_kind(ang_dicom_slice *s, const seen *seen) {
    const char *what = ang_dicom_modality(s->modality);
    if (strcmp(what, "other") == 0) what = ang_dicom_class_name(s->sop_class);
    if (s->frames > 1 && !has_groups(seen)) {
        s->image = true;
        snprintf(s->refusal, sizeof s->refusal, "multi-frame image (%d frames) without functional groups: not read",
                 s->frames);
    } else if (seen->float_pixels) {
        s->image = true;
        snprintf(s->refusal, sizeof s->refusal, "pixels in floating point: not read yet");
    } else if (!seen->pixels && !seen->rows && !seen->columns) {
        snprintf(s->refusal, sizeof s->refusal, "no image (%s)", what);
    }
    return s->refusal[0] == 0;
}

/* Whether a transfer syntax of the standard codes pixels in this way (PS3.5 annex A). */
static bool syntax_codes(const char *syntax, bool encapsulated) {
    bool packed = starts(syntax, "1.2.840.10008.1.2.4.") || strcmp(syntax, "1.2.840.10008.1.2.5") == 0;
    bool plain = strcmp(syntax, "1.2.840.10008.1.2") == 0 || strcmp(syntax, "1.2.840.10008.1.2.1") == 0 ||
                 strcmp(syntax, "1.2.840.10008.1.2.1.99") == 0 || strcmp(syntax, "1.2.840.10008.1.2.2") == 0;
    return encapsulated ? packed : plain;
}

static bool find_coding(ang_dicom_slice *s, const ang_dicom_reader *reader, bool encapsulated) {
    const char *syntax = s->transfer_syntax;
    s->wrong_syntax = reader->overruled || (reader->transfer_syntax[0] && !syntax_codes(syntax, encapsulated));
    if (reader->memory) {
        s->coding = ANG_DICOM_DEFLATED;
        return !encapsulated; /* fragments in it would be taken for pixels */
    } else if (!encapsulated) {
        s->coding = reader->big_endian ? ANG_DICOM_BIG_ENDIAN : ANG_DICOM_NATIVE;
    } else if (strcmp(syntax, "1.2.840.10008.1.2.5") == 0) {
        s->coding = ANG_DICOM_RLE;
    } else {
        s->coding = ANG_DICOM_ENCAPSULATED;
        int kind = starts(syntax, "1.2.840.10008.1.2.4.") ? atoi(syntax + 20) : 0;
        bool lossless = kind == 57 || kind == 70 || kind == 80 || kind == 90;
        /* .91 may be either: LossyImageCompression has the word. */
        if (!lossless && kind != 91 && kind != 203) s->lossy = true;
        if (kind < 50 || kind > 93) return false;
    }
    return true;
}

/* What an image must have, against what the file holds: nothing is allocated for a claim that the file cannot keep. */
static bool check_pixels(ang_dicom_slice *s, const seen *seen, ang_dicom_reader *reader, const char *label,
                         ang_error *err) {
    static const char missing[] = "%s: (%04X,%04X) %s is missing%s";
    const char *cut = reader->truncated ? ": the file is cut off" : "";
    if (!seen->rows || s->rows == 0) return ang_fail(err, ANG_INPUT, missing, label, 0x28, 0x10, "Rows", cut);
    if (!seen->columns || s->columns == 0) return ang_fail(err, ANG_INPUT, missing, label, 0x28, 0x11, "Columns", cut);
    if (!seen->bits_allocated) return ang_fail(err, ANG_INPUT, missing, label, 0x28, 0x100, "BitsAllocated", cut);
    if (!seen->pixels) return ang_fail(err, ANG_INPUT, missing, label, 0x7FE0, 0x10, "PixelData", cut);
    if (!seen->bits_stored) s->bits_stored = s->bits_allocated;
    if (!seen->high_bit) s->high_bit = s->bits_stored - 1;

    if (s->samples != 1) {
        snprintf(s->refusal, sizeof s->refusal, "colour image (%d samples a pixel)", s->samples);
        return true;
    }
    if (s->bits_allocated != 8 && s->bits_allocated != 16 && s->bits_allocated != 32) {
        snprintf(s->refusal, sizeof s->refusal, "(0028,0100) BitsAllocated %d: only 8, 16 and 32 are read",
                 s->bits_allocated);
        return true;
    }
    if (s->bits_stored < 1 || s->bits_stored > s->bits_allocated)
        return ang_fail(err, ANG_INPUT, "%s: (0028,0101) BitsStored %d does not fit BitsAllocated %d", label,
                        s->bits_stored, s->bits_allocated);
    if (s->high_bit < s->bits_stored - 1 || s->high_bit >= s->bits_allocated)
        return ang_fail(err, ANG_INPUT, "%s: (0028,0102) HighBit %d does not fit BitsStored %d", label, s->high_bit,
                        s->bits_stored);
    if (seen->odd_representation)
        return ang_fail(err, ANG_INPUT, "%s: (0028,0103) PixelRepresentation is neither 0 nor 1", label);
    if (s->bits_stored > 16) {
        snprintf(s->refusal, sizeof s->refusal, "(0028,0101) BitsStored %d: more than 16 bits", s->bits_stored);
        return true;
    }
    bool encapsulated = seen->pixel_length == ANG_DICOM_UNDEFINED;
    if (has_groups(seen) && (s->frames < 1 || s->frames > ang_dicom_most_frames))
        return ang_fail(err, ANG_INPUT, "%s: (0028,0008) NumberOfFrames is %d: 1 to %d are read", label, s->frames,
                        ang_dicom_most_frames);
    uint64_t left = reader->size - s->pixel_offset, frames = has_groups(seen) ? (uint64_t)s->frames : 1;
    uint64_t frame = ang_dicom_pixel_bytes(s), needed = frames * frame;
    const char *claim = frames > 1 ? "Rows x Columns x NumberOfFrames" : "Rows x Columns";
    if (!find_coding(s, reader, encapsulated)) {
        snprintf(s->refusal, sizeof s->refusal, "transfer syntax %.40s: not supported", s->transfer_syntax);
        return true;
    }
    s->pixel_length = encapsulated ? left : frame;
    if (encapsulated) {
        /* No codec packs a picture 4096 times: such a claim would only cost memory. */
        if (needed / 4096 > left + 4096)
            return ang_fail(err, ANG_INPUT,
                            "%s: %llu x %d x %d pixels cannot be in %llu bytes of (7FE0,0010) PixelData", label,
                            (unsigned long long)frames, s->columns, s->rows, (unsigned long long)left);
        return true;
    }
    if (seen->pixel_length < needed && seen->pixel_length <= left)
        return ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData has %u bytes, %s need %llu", label,
                        seen->pixel_length, claim, (unsigned long long)needed);
    if (left < needed)
        return ang_fail(err, ANG_INPUT, "%s: (7FE0,0010) PixelData is cut off: %llu of %llu bytes", label,
                        (unsigned long long)left, (unsigned long long)needed);
    return true;
}

/* Where the pixels of every frame lie; `*frames` stays NULL for an ordinary image. */
static bool find_frames(ang_dicom_slice *s, const seen *seen, ang_dicom_reader *reader, const char *label,
                        ang_dicom_slice **frames, ang_error *err) {
    bool encapsulated = seen->pixel_length == ANG_DICOM_UNDEFINED;
    if (!has_groups(seen)) {
        s->frames = 1;
        if (!encapsulated) return true;
        if (!ang_dicom_first_fragment(reader, &s->pixel_offset, label, err)) return false;
        s->pixel_length = reader->size - s->pixel_offset;
        if (s->coding == ANG_DICOM_ENCAPSULATED) ang_dicom_adopt_jpeg2000(s, reader);
        return true;
    }
    static const uint64_t most_inflated = UINT64_C(1) << 28; /* every frame is inflated from the start */
    if (reader->memory && (uint64_t)s->frames * reader->size > most_inflated) {
        snprintf(s->refusal, sizeof s->refusal, "deflated multi-frame image (%d frames): not read", s->frames);
        return true;
    }
    *frames = ang_dicom_read_frames(reader, label, s, &seen->multi, err);
    bool ok = *frames != NULL;
    if (ok && encapsulated) ok = ang_dicom_locate_frames(reader, label, &seen->multi.offsets, *frames, s->frames, err);
    for (int i = 0; ok && i < s->frames; i++) {
        ang_dicom_slice *frame = &(*frames)[i];
        if (!encapsulated) frame->pixel_offset += (uint64_t)i * ang_dicom_pixel_bytes(s);
        if (frame->coding == ANG_DICOM_ENCAPSULATED) ang_dicom_adopt_jpeg2000(frame, reader);
    }
    if (ok) return true;
    free(*frames);
    *frames = NULL;
    return false;
}

ang_dicom_found ang_dicom_header(const char *path, const char *label, ang_dicom_reader *reader, ang_dicom_slice *slice,
                                 ang_dicom_slice **frames, ang_error *err) {
    *frames = NULL;
    ang_dicom_found found = ang_dicom_open(reader, path, label, err);
    if (found != ANG_DICOM_FOUND) {
        ang_dicom_close(reader);
        return found;
    }
    size_t file = slice->file;
    *slice = (ang_dicom_slice){.file = file, .samples = 1, .frames = 1};
    snprintf(slice->transfer_syntax, sizeof slice->transfer_syntax, "%s",
             ang_dicom_is_transfer_syntax(reader->transfer_syntax) ? reader->transfer_syntax : "other");
    seen seen = {0};
    size_t count = 0;
    uint32_t last = 0;
    for (ang_dicom_element element; ang_dicom_next(reader, &element); count++) {
        last = element.tag;
        uint32_t group = element.tag >> 16;
        if (group == 0x0008 || group == 0x0010 || group == 0x0020) take_identity(reader, &element, slice, &seen);
        if (group == 0x0018 || group == 0x0020 || group == 0x0028) ang_dicom_take_geometry(reader, &element, slice);
        if (group == 0x0028) ang_dicom_take_map(reader, &element, slice);
        if (group >= 0x0028) take_pixels(reader, &element, slice, &seen);
    }
    join(slice->acquisition_time, sizeof slice->acquisition_time, seen.acquisition_date, seen.acquisition_time);
    join(slice->content_time, sizeof slice->content_time, seen.content_date, seen.content_time);

    bool ok = true;
    if (!slice->sop_class[0]) snprintf(slice->sop_class, sizeof slice->sop_class, "%s", reader->media_class);
    if (strcmp(slice->sop_class, "1.2.840.10008.1.3.10") == 0) {
        found = ANG_DICOM_FOREIGN; /* a DICOMDIR: an index of the files beside it */
    } else if (count == 0 || (!slice->sop_class[0] && !seen.rows && !seen.pixels)) {
        ok = ang_fail(err, ANG_INPUT, "%s: (0008,0016) SOPClassUID is missing%s: no DICOM image", label,
                      reader->truncated ? " and the file is cut off" : "");
    } else if (reader->truncated && !seen.pixels && may_be_image(slice)) {
        ok = ang_fail(err, ANG_INPUT, "%s: its header is damaged or cut off behind (%04X,%04X)", label, last >> 16,
                      last & 0xFFFF);
    } else if (check_kind(slice, &seen)) {
        slice->image = true;
        ok = check_pixels(slice, &seen, reader, label, err) &&
             (slice->refusal[0] || find_frames(slice, &seen, reader, label, frames, err));
    }
    ang_dicom_close(reader);
    return ok ? found : ANG_DICOM_BROKEN;
}
