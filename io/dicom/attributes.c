#include "io/dicom/attributes.h"

#include <string.h>

void ang_dicom_take_geometry(ang_dicom_reader *r, const ang_dicom_element *e, ang_dicom_slice *s) {
    double v[6];
    switch (e->tag) {
    case ANG_DICOM_TAG(0x0018, 0x0050):
        s->has_thickness = ang_dicom_numbers(r, e, &s->thickness, 1) == 1;
        break;
    case ANG_DICOM_TAG(0x0018, 0x0088):
        s->has_slice_distance = ang_dicom_numbers(r, e, &s->slice_distance, 1) == 1;
        break;
    case ANG_DICOM_TAG(0x0018, 0x1060):
        s->has_trigger_time = ang_dicom_numbers(r, e, &s->trigger_time, 1) == 1;
        break;
    case ANG_DICOM_TAG(0x0018, 0x1120):
        s->has_tilt = ang_dicom_numbers(r, e, &s->tilt, 1) == 1;
        break;
    case ANG_DICOM_TAG(0x0020, 0x0032):
        if ((s->has_position = ang_dicom_numbers(r, e, v, 3) == 3)) s->position = (ang_vec3){v[0], v[1], v[2]};
        s->bad_position = !s->has_position && e->length > 0;
        break;
    case ANG_DICOM_TAG(0x0020, 0x0037):
        if ((s->has_orientation = ang_dicom_numbers(r, e, v, 6) == 6)) {
            s->row = (ang_vec3){v[0], v[1], v[2]};
            s->column = (ang_vec3){v[3], v[4], v[5]};
        }
        s->bad_orientation = !s->has_orientation && e->length > 0;
        break;
    case ANG_DICOM_TAG(0x0028, 0x0030):
        s->has_spacing = ang_dicom_numbers(r, e, v, 2) == 2 && v[0] > 0 && v[1] > 0;
        s->bad_spacing = !s->has_spacing && e->length > 0;
        if (s->has_spacing) {
            s->row_spacing = v[0];
            s->column_spacing = v[1];
        }
        break;
    default:
        break;
    }
}

void ang_dicom_take_map(ang_dicom_reader *r, const ang_dicom_element *e, ang_dicom_slice *s) {
    char text[17];
    switch (e->tag) {
    case ANG_DICOM_TAG(0x0028, 0x1050):
        s->has_window = ang_dicom_numbers(r, e, &s->window_centre, 1) == 1;
        break;
    case ANG_DICOM_TAG(0x0028, 0x1051):
        if (ang_dicom_numbers(r, e, &s->window_width, 1) != 1) s->has_window = false;
        break;
    case ANG_DICOM_TAG(0x0028, 0x1052):
        s->has_intercept = ang_dicom_numbers(r, e, &s->intercept, 1) == 1;
        s->bad_intercept = !s->has_intercept && e->length > 0;
        break;
    case ANG_DICOM_TAG(0x0028, 0x1053):
        s->has_slope = ang_dicom_numbers(r, e, &s->slope, 1) == 1;
        s->bad_slope = !s->has_slope && e->length > 0;
        break;
    case ANG_DICOM_TAG(0x0028, 0x1054):
        s->other_unit = ang_dicom_text(r, e, text, sizeof text) && strcmp(text, "HU") != 0;
        break;
    default:
        break;
    }
}
