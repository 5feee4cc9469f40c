#include "io/dicom/frames.h"

#include "core/base/memory.h"
#include "io/dicom/attributes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_dimensions = 16 };

/* Which of the dimension index values tell frames of one place apart. */
typedef struct dimensions {
    bool tells[most_dimensions];
    int count;
} dimensions;

/* Groups whose elements are read: all are sequences of one item. */
static bool is_group(uint32_t tag) {
    static const uint32_t groups[] = {
        ANG_DICOM_TAG(0x0018, 0x9118), /* CardiacSynchronization */
        ANG_DICOM_TAG(0x0018, 0x9226), /* MRImageFrameType */
        ANG_DICOM_TAG(0x0018, 0x9304), /* CTAcquisitionDetails */
        ANG_DICOM_TAG(0x0018, 0x9329), /* CTImageFrameType */
        ANG_DICOM_TAG(0x0020, 0x9111), /* FrameContent */
        ANG_DICOM_TAG(0x0020, 0x9113), /* PlanePosition */
        ANG_DICOM_TAG(0x0020, 0x9116), /* PlaneOrientation */
        ANG_DICOM_TAG(0x0028, 0x9110), /* PixelMeasures */
        ANG_DICOM_TAG(0x0028, 0x9132), /* FrameVOILUT */
        ANG_DICOM_TAG(0x0028, 0x9145), /* PixelValueTransformation */
    };
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        if (groups[i] == tag) return true;
    return false;
}

/* One number of an element whose VR is `vr`. */
static bool number(ang_dicom_reader *reader, const ang_dicom_element *element, const char *vr, double *out) {
    ang_dicom_element known = *element;
    ang_dicom_assume_vr(&known, vr);
    return ang_dicom_numbers(reader, &known, out, 1) == 1;
}

static bool index_number(ang_dicom_reader *reader, const ang_dicom_element *element, const char *vr, int *out) {
    double value;
    if (!number(reader, element, vr, &value) || value < 0 || value > 2147483647.0) return false;
    *out = (int)value;
    return true;
}

/* A DT, "YYYYMMDDHHMMSS.FFFFFF&ZZXX", as the record holds date and time: with a blank between. */
static void take_date_time(ang_dicom_reader *reader, const ang_dicom_element *element, char out[41]) {
    char text[27];
    if (!ang_dicom_text(reader, element, text, sizeof text)) return;
    if (strspn(text, "0123456789") < 10)
        snprintf(out, 41, "%s", text);
    else
        snprintf(out, 41, "%.8s %s", text, text + 8);
}

static void take_dimensions(ang_dicom_reader *reader, const ang_dicom_element *element, const dimensions *dimensions,
                            ang_dicom_slice *frame) {
    double value[most_dimensions];
    ang_dicom_element known = *element;
    ang_dicom_assume_vr(&known, "UL");
    int count = ang_dicom_numbers(reader, &known, value, dimensions->count);
    size_t used = 0;
    frame->dimensions[0] = 0;
    for (int i = 0; i < count && used < sizeof frame->dimensions; i++) {
        if (!dimensions->tells[i]) continue;
        used += (size_t)snprintf(frame->dimensions + used, sizeof frame->dimensions - used, "%s%.0f", used ? "\\" : "",
                                 value[i]);
    }
}

static void take_content(ang_dicom_reader *r, const ang_dicom_element *e, const dimensions *dimensions,
                         ang_dicom_slice *s, int *in_stack) {
    switch (e->tag) {
    case ANG_DICOM_TAG(0x0008, 0x9007):
        ang_dicom_text(r, e, s->image_type, sizeof s->image_type);
        break;
    case ANG_DICOM_TAG(0x0018, 0x9074):
        take_date_time(r, e, s->acquisition_time);
        break;
    case ANG_DICOM_TAG(0x0018, 0x9151):
        take_date_time(r, e, s->content_time);
        break;
    case ANG_DICOM_TAG(0x0020, 0x9056):
        ang_dicom_text(r, e, s->stack_id, sizeof s->stack_id);
        break;
    case ANG_DICOM_TAG(0x0020, 0x9057):
        index_number(r, e, "UL", in_stack);
        break;
    case ANG_DICOM_TAG(0x0020, 0x9128):
        s->has_temporal_position = index_number(r, e, "UL", &s->temporal_position);
        break;
    case ANG_DICOM_TAG(0x0020, 0x9153):
        s->has_trigger_time = number(r, e, "FD", &s->trigger_time);
        break;
    case ANG_DICOM_TAG(0x0020, 0x9156):
        s->has_acquisition_number = index_number(r, e, "US", &s->acquisition_number);
        break;
    case ANG_DICOM_TAG(0x0020, 0x9157):
        take_dimensions(r, e, dimensions, s);
        break;
    case ANG_DICOM_TAG(0x0020, 0x9241):
        s->has_cardiac_phase = number(r, e, "FL", &s->cardiac_phase);
        break;
    default:
        break;
    }
}

/* What the functional groups of one item say goes into the record. */
static void take_groups(ang_dicom_reader *reader, ang_dicom_range *item, const dimensions *dimensions,
                        ang_dicom_slice *frame, int *in_stack) {
    for (ang_dicom_element group; ang_dicom_next_in(reader, item, &group);) {
        if (!is_group(group.tag)) continue;
        ang_dicom_range sequence = ang_dicom_sequence(reader, &group), inside;
        if (!ang_dicom_next_item(reader, &sequence, &inside)) continue;
        for (ang_dicom_element element; ang_dicom_next_in(reader, &inside, &element);) {
            ang_dicom_take_geometry(reader, &element, frame);
            ang_dicom_take_map(reader, &element, frame);
            take_content(reader, &element, dimensions, frame, in_stack);
        }
    }
}

/* Stack, place in it, position and orientation are told by themselves. */
static bool tells(uint32_t pointer) {
    return pointer != ANG_DICOM_TAG(0x0020, 0x9056) && pointer != ANG_DICOM_TAG(0x0020, 0x9057) &&
           pointer != ANG_DICOM_TAG(0x0020, 0x0032) && pointer != ANG_DICOM_TAG(0x0020, 0x0037);
}

static void read_dimensions(ang_dicom_reader *reader, const ang_dicom_element *sequence, dimensions *dimensions) {
    if (!sequence->tag) return;
    ang_dicom_range items = ang_dicom_sequence(reader, sequence), item;
    while (dimensions->count < most_dimensions && ang_dicom_next_item(reader, &items, &item)) {
        uint32_t pointer = 0;
        for (ang_dicom_element element; ang_dicom_next_in(reader, &item, &element);) {
            double part[2];
            if (element.tag != ANG_DICOM_TAG(0x0020, 0x9165)) continue;
            memcpy(element.vr, "US", 3); /* AT: two words */
            if (ang_dicom_numbers(reader, &element, part, 2) == 2) pointer = ANG_DICOM_TAG(part[0], (uint32_t)part[1]);
        }
        dimensions->tells[dimensions->count++] = tells(pointer);
    }
}

static bool count_items(ang_dicom_reader *reader, const ang_dicom_slice *whole, const ang_dicom_multi_frame *multi,
                        const char *label, ang_error *err) {
    int count = 0;
    if (!multi->per_frame.tag)
        return whole->frames == 1 ||
               ang_fail(err, ANG_INPUT, "%s: (5200,9230) PerFrameFunctionalGroupsSequence is missing", label);
    ang_dicom_range items = ang_dicom_sequence(reader, &multi->per_frame), item;
    while (count <= whole->frames && ang_dicom_next_item(reader, &items, &item)) count++;
    return count == whole->frames ||
           ang_fail(err, ANG_INPUT,
                    "%s: (5200,9230) PerFrameFunctionalGroupsSequence has %s%d items that can be read, (0028,0008) "
                    "NumberOfFrames is %d",
                    label, count > whole->frames ? "more than " : "", count > whole->frames ? whole->frames : count,
                    whole->frames);
}

ang_dicom_slice *ang_dicom_read_frames(ang_dicom_reader *reader, const char *label, const ang_dicom_slice *whole,
                                       const ang_dicom_multi_frame *multi, ang_error *err) {
    if (!count_items(reader, whole, multi, label, err)) return NULL;
    ang_dicom_slice *frames = ang_alloc((size_t)whole->frames, sizeof *frames, "frames", err);
    if (!frames) return NULL;
    dimensions dimensions = {0};
    read_dimensions(reader, &multi->dimensions, &dimensions);
    ang_dicom_slice common = *whole;
    common.frames = 1;
    common.object_number = whole->instance_number;
    int offset = 0, shared_place = 0;
    if (multi->first_frame.tag) index_number(reader, &multi->first_frame, "UL", &offset);
    if (offset > 1000000000) offset = 0;
    if (multi->shared.tag) {
        ang_dicom_range items = ang_dicom_sequence(reader, &multi->shared), item;
        if (ang_dicom_next_item(reader, &items, &item)) take_groups(reader, &item, &dimensions, &common, &shared_place);
    }
    ang_dicom_range items = {0}, item;
    if (multi->per_frame.tag) items = ang_dicom_sequence(reader, &multi->per_frame);
    for (int i = 0; i < whole->frames; i++) {
        int in_stack = 0;
        frames[i] = common;
        frames[i].frame = offset + i + 1;
        if (multi->per_frame.tag && ang_dicom_next_item(reader, &items, &item))
            take_groups(reader, &item, &dimensions, &frames[i], &in_stack);
        frames[i].has_instance_number = true;
        frames[i].instance_number = frames[i].has_position || in_stack == 0 ? frames[i].frame : in_stack;
    }
    return frames;
}
