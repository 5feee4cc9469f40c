#include "io/dicom/capture.h"

#include "io/dicom/elements.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define SECONDARY_CAPTURE "1.2.840.10008.5.1.4.1.1.7"

static void set_time(ang_capture *capture) {
    time_t now = time(NULL);
    struct tm local;
    localtime_r(&now, &local);
    strftime(capture->date, sizeof capture->date, "%Y%m%d", &local);
    strftime(capture->time, sizeof capture->time, "%H%M%S", &local);
}

bool ang_capture_begin(ang_capture *capture, const ang_identity *source, bool keep_phi, const char *pseudonym,
                       const char *program, ang_notes *warnings, ang_error *err) {
    *capture = (ang_capture){.source = source, .identified = keep_phi && source};
    snprintf(capture->program, sizeof capture->program, "%s", program);
    snprintf(capture->pseudonym, sizeof capture->pseudonym, "%s", pseudonym);
    if (keep_phi && !source)
        ang_notes_add(warnings, "the input has no DICOM header with patient and study: the secondary capture has none");
    if (!ang_dicom_random_uid(capture->study_uid) || !ang_dicom_random_uid(capture->series_uid))
        return ang_fail(err, ANG_OUTPUT, "the system has no random numbers for new UIDs");
    const char *study = ang_identity_value(source, 0x0020000D);
    if (capture->identified && study[0] && strlen(study) < sizeof capture->study_uid)
        strcpy(capture->study_uid, study);
    else if (capture->identified)
        ang_notes_add(warnings, "the input has no StudyInstanceUID: the secondary capture begins a study of its own");
    set_time(capture);
    return true;
}

/* One element of the source, as it was or as its type asks for. */
static void put(ang_dicom_elements *to, const ang_capture *capture, uint32_t tag) {
    ang_identity_kind kind;
    const char *vr = ang_identity_element(tag, &kind), *value = ang_identity_value(capture->source, tag);
    if (!capture->identified && kind != ANG_IDENTITY_HARMLESS) value = "";
    if (value[0] || kind == ANG_IDENTITY_NAMES) ang_elements_text(to, tag, vr, value);
}

/* ST of ASCII: whatever the character set, that is in it. */
static void put_description(ang_dicom_elements *to, const char *description) {
    char text[1025];
    size_t length = 0;
    for (const unsigned char *c = (const unsigned char *)description; *c && length + 1 < sizeof text; c++) {
        if ((*c & 0xC0) == 0x80) continue; /* of a character that is '?' already */
        text[length++] = *c >= ' ' && *c < 127 ? (char)*c : '?';
    }
    text[length] = '\0';
    ang_elements_text(to, 0x00082111, "ST", text);
}

/* PS3.15 E.1.1: by which method, in words and as a code of PS3.16 CID 7050. */
static void put_deidentification(ang_dicom_elements *to) {
    ang_dicom_elements code = {0};
    ang_elements_text(&code, 0x00080100, "SH", "113100");
    ang_elements_text(&code, 0x00080102, "SH", "DCM");
    ang_elements_text(&code, 0x00080104, "LO", "Basic Application Confidentiality Profile");
    ang_elements_text(to, 0x00120062, "CS", "YES");
    ang_elements_text(to, 0x00120063, "LO", "DICOM PS3.15 Basic Application Level Confidentiality");
    ang_elements_sequence(to, 0x00120064, &code);
    free(code.data);
}

static void put_identification(ang_dicom_elements *to, const ang_capture *capture, const ang_capture_picture *picture,
                               const char *instance) {
    const char *modality = ang_identity_value(capture->source, 0x00080060);
    if (capture->identified)
        put(to, capture, 0x00080005);
    else
        ang_elements_text(to, 0x00080005, "CS", "ISO_IR 192");
    ang_elements_text(to, 0x00080008, "CS", "DERIVED\\SECONDARY");
    ang_elements_text(to, 0x00080016, "UI", SECONDARY_CAPTURE);
    ang_elements_text(to, 0x00080018, "UI", instance);
    put(to, capture, 0x00080020);
    if (capture->identified) {
        ang_elements_text(to, 0x00080021, "DA", capture->date); /* SeriesDate */
        ang_elements_text(to, 0x00080023, "DA", capture->date); /* ContentDate */
    }
    put(to, capture, 0x00080030);
    if (capture->identified) {
        ang_elements_text(to, 0x00080031, "TM", capture->time);
        ang_elements_text(to, 0x00080033, "TM", capture->time);
    }
    put(to, capture, 0x00080050);
    ang_elements_text(to, 0x00080060, "CS", modality[0] ? modality : "OT");
    ang_elements_text(to, 0x00080064, "CS", "WSD"); /* ConversionType: workstation */
    ang_elements_text(to, 0x00080070, "LO", "Angioscope");
    put(to, capture, 0x00080090);
    put(to, capture, 0x00081030);
    ang_elements_text(to, 0x0008103E, "LO", "Angioscope picture");
    put_description(to, picture->description);
}

static void put_patient(ang_dicom_elements *to, const ang_capture *capture) {
    static const uint32_t tags[] = {0x00100010, 0x00100020, 0x00100021, 0x00100030,
                                    0x00100040, 0x00101010, 0x00101020, 0x00101030};
    char name[80];
    snprintf(name, sizeof name, "Anonymous^%s", capture->pseudonym);
    for (size_t i = 0; i < sizeof tags / sizeof *tags; i++) {
        bool made_up = !capture->identified && i < 2;
        if (made_up)
            ang_elements_text(to, tags[i], i == 0 ? "PN" : "LO", i == 0 ? name : capture->pseudonym);
        else
            put(to, capture, tags[i]);
    }
    if (!capture->identified) put_deidentification(to);
    /* A source that was de-identified before stays so. */
    const ang_identity *source = capture->source;
    if (!ang_identity_value(source, 0x00120062)[0] || !ang_identity_value(source, 0x00120063)[0]) return;
    put(to, capture, 0x00120062);
    put(to, capture, 0x00120063);
}

static void put_series(ang_dicom_elements *to, const ang_capture *capture, const ang_capture_picture *picture) {
    char number[16], orientation[32];
    if (capture->identified) ang_elements_text(to, 0x00181012, "DA", capture->date); /* DateOfSecondaryCapture */
    if (capture->identified) ang_elements_text(to, 0x00181014, "TM", capture->time);
    ang_elements_text(to, 0x00181016, "LO", "Angioscope"); /* SecondaryCaptureDeviceManufacturer */
    ang_elements_text(to, 0x00181018, "LO", "Angioscope");
    ang_elements_text(to, 0x00181019, "LO", capture->program);
    ang_elements_text(to, 0x0020000D, "UI", capture->study_uid);
    ang_elements_text(to, 0x0020000E, "UI", capture->series_uid);
    put(to, capture, 0x00200010);
    ang_elements_text(to, 0x00200011, "IS", "9001"); /* beyond those of scanners */
    snprintf(number, sizeof number, "%d", picture->number);
    ang_elements_text(to, 0x00200013, "IS", number);
    bool known = picture->right[0] && picture->down[0];
    snprintf(orientation, sizeof orientation, known ? "%s\\%s" : "", picture->right, picture->down);
    ang_elements_text(to, 0x00200020, "CS", orientation);
    ang_elements_text(to, 0x00200060, "CS", ""); /* Laterality: whether the part has two sides is not known */
}

static void put_pixels(ang_dicom_elements *to, const ang_capture *capture, const ang_capture_picture *picture) {
    ang_elements_short(to, 0x00280002, 3); /* SamplesPerPixel */
    ang_elements_text(to, 0x00280004, "CS", "RGB");
    ang_elements_short(to, 0x00280006, 0); /* PlanarConfiguration */
    ang_elements_short(to, 0x00280010, (unsigned)picture->height);
    ang_elements_short(to, 0x00280011, (unsigned)picture->width);
    ang_elements_short(to, 0x00280100, 8);
    ang_elements_short(to, 0x00280101, 8);
    ang_elements_short(to, 0x00280102, 7);
    ang_elements_short(to, 0x00280103, 0);
    ang_elements_text(to, 0x00280301, "CS", "NO"); /* BurnedInAnnotation: nothing that tells who or when */
    if (!capture->identified) ang_elements_text(to, 0x00280303, "CS", "REMOVED"); /* longitudinal information */
    put(to, capture, 0x00282110);
    ang_elements_bytes(to, 0x7FE00010, picture->rgb, 3 * (size_t)picture->width * (size_t)picture->height);
}

bool ang_capture_encode(const ang_capture *capture, const ang_capture_picture *picture, unsigned char **out,
                        size_t *size, ang_error *err) {
    char instance[65];
    ang_dicom_elements set = {0}, file = {0};
    *out = NULL;
    if (picture->width > 65535 || picture->height > 65535)
        return ang_fail(err, ANG_LIMIT, "a DICOM image has at most 65535 x 65535 pixels; use a smaller --size");
    if (!ang_dicom_random_uid(instance)) return ang_fail(err, ANG_OUTPUT, "the system has no random numbers for UIDs");
    put_identification(&set, capture, picture, instance);
    put_patient(&set, capture);
    put_series(&set, capture, picture);
    put_pixels(&set, capture, picture);
    ang_elements_file(&file, SECONDARY_CAPTURE, instance, &set);
    free(set.data);
    if (file.failed) {
        free(file.data);
        return ang_fail(err, ANG_LIMIT, "no memory for a DICOM file; use a smaller --size");
    }
    *out = file.data;
    *size = file.size;
    return true;
}
