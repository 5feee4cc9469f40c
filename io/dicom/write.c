#include "io/dicom/write.h"

#include "core/base/memory.h"
#include "io/dicom/elements.h"
#include "io/dicom/encode.h"
#include "io/replace.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct uid {
    char text[65];
} uid;

/* 64 random bits of a key (splitmix64 finaliser). */
static uint64_t mix(uint64_t key) {
    key += 0x9E3779B97F4A7C15u;
    key = (key ^ key >> 30) * 0xBF58476D1CE4E5B9u;
    key = (key ^ key >> 27) * 0x94D049BB133111EBu;
    return key ^ key >> 31;
}

static uint64_t fold(uint64_t hash, const void *data, size_t size) {
    const unsigned char *bytes = data;
    uint64_t word = 0;
    for (size_t i = 0; i < size; i++) {
        word = word << 8 | bytes[i];
        if (i % 8 == 7 || i + 1 == size) {
            hash = mix(hash ^ word);
            word = 0;
        }
    }
    return hash;
}

static uid make_uid(uint64_t key, uint64_t kind, uint64_t index) {
    uint64_t high = mix(mix(mix(key) ^ kind) ^ index), low = mix(high ^ key ^ ~kind);
    unsigned char bytes[16];
    uid made;
    for (int i = 0; i < 8; i++) {
        bytes[i] = (unsigned char)(high >> (56 - 8 * i));
        bytes[8 + i] = (unsigned char)(low >> (56 - 8 * i));
    }
    ang_dicom_uuid_uid(bytes, 8, made.text);
    return made;
}

enum { decimal_size = 24 };

/* A decimal string: at most 16 characters (PS3.5 6.2), as many digits as fit. */
static void put_decimal(char out[decimal_size], double value) {
    if (fabs(value) < 1e-12) value = 0;
    for (int digits = 15; digits >= 1; digits--) {
        if (snprintf(out, decimal_size, "%.*g", digits, value) <= 16) return;
    }
}

static void put_decimals(char *out, size_t size, const double *values, int count) {
    size_t used = 0;
    for (int i = 0; i < count; i++) {
        char text[decimal_size];
        put_decimal(text, values[i]);
        used += (size_t)snprintf(out + used, size - used, "%s%s", i ? "\\" : "", text);
    }
}

/* What is the same in all slices. */
typedef struct series {
    const ang_volume *volume;
    ang_vec3 row, column, normal; /* unit */
    double spacing[2];            /* between rows, between columns */
    double thickness;
    uint64_t key;
    uid study, series, frame;
} series;

static bool plan_series(const ang_volume *volume, uint64_t seed, series *s, ang_error *err) {
    *s = (series){.volume = volume};
    ang_vec3 x = ang_mat4_column(&volume->affine, 0), y = ang_mat4_column(&volume->affine, 1);
    s->spacing[0] = ang_vec3_length(y);
    s->spacing[1] = ang_vec3_length(x);
    s->row = ang_vec3_unit(x);
    s->column = ang_vec3_unit(y);
    s->normal = ang_vec3_cross(s->row, s->column);
    s->thickness = fabs(ang_vec3_dot(s->normal, ang_mat4_column(&volume->affine, 2)));
    if (!(s->spacing[0] > 0 && s->spacing[1] > 0 && s->thickness > 0) || fabs(ang_vec3_dot(s->row, s->column)) > 1e-4) {
        return ang_fail(err, ANG_GEOMETRY,
                        "rows and columns of this volume are not at right angles or have no length: a DICOM image "
                        "plane cannot state it");
    }
    if (volume->dims[0] > 65535 || volume->dims[1] > 65535) {
        return ang_fail(err, ANG_GEOMETRY, "%d x %d pixels: a DICOM image has at most 65535 x 65535", volume->dims[0],
                        volume->dims[1]);
    }
    s->key = mix(seed);
    s->key = fold(s->key, volume->dims, sizeof volume->dims);
    s->key = fold(s->key, &volume->affine, sizeof volume->affine);
    s->key = fold(s->key, volume->data, ang_volume_count(volume) * sizeof *volume->data);
    s->study = make_uid(s->key, 1, 0);
    s->series = make_uid(s->key, 2, 0);
    s->frame = make_uid(s->key, 3, 0);
    return true;
}

enum { text_size = 256 };

static bool encode_slice(const series *s, int z, unsigned char **out, size_t *size, ang_error *err) {
    const ang_volume *v = s->volume;
    uid instance = make_uid(s->key, 4, (uint64_t)z);
    char number[16], spacing[text_size], orientation[text_size], position[text_size], thickness[decimal_size],
        location[decimal_size];
    char slope[decimal_size], intercept[decimal_size];
    ang_vec3 at = ang_mat4_point(&v->affine, (ang_vec3){0, 0, z});
    snprintf(number, sizeof number, "%d", z + 1);
    put_decimals(spacing, sizeof spacing, s->spacing, 2);
    put_decimals(orientation, sizeof orientation,
                 (const double[]){s->row.x, s->row.y, s->row.z, s->column.x, s->column.y, s->column.z}, 6);
    put_decimals(position, sizeof position, (const double[]){at.x, at.y, at.z}, 3);
    put_decimal(thickness, s->thickness);
    put_decimal(location, ang_vec3_dot(s->normal, at));
    put_decimal(slope, v->slope);
    put_decimal(intercept, v->intercept);
    const ang_dicom_text texts[] = {
        /* SOP common, C.12.1 */
        {0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2"},
        {0x00080018, "UI", instance.text},
        /* Patient, C.7.1.1 */
        {0x00100010, "PN", "Phantom^Angioscope"},
        {0x00100020, "LO", "PHANTOM"},
        {0x00100030, "DA", ""},
        {0x00100040, "CS", "O"},
        /* General study, C.7.2.1 */
        {0x0020000D, "UI", s->study.text},
        {0x00080020, "DA", "20000101"},
        {0x00080030, "TM", "120000"},
        {0x00080050, "SH", ""},
        {0x00080090, "PN", ""},
        {0x00081030, "LO", "Synthetic head CTA"},
        {0x00200010, "SH", "1"},
        /* General series, C.7.3.1 */
        {0x00080060, "CS", "CT"},
        {0x0020000E, "UI", s->series.text},
        {0x00200011, "IS", "1"},
        {0x0008103E, "LO", "Angioscope phantom"},
        {0x00180015, "CS", "HEAD"},
        {0x00185100, "CS", "HFS"},
        /* Frame of reference, C.7.4.1 */
        {0x00200052, "UI", s->frame.text},
        {0x00201040, "LO", ""},
        /* General equipment, C.7.5.1 */
        {0x00080070, "LO", "Angioscope"},
        {0x00081090, "LO", "Phantom"},
        {0x00181020, "LO", "1"},
        /* General image and acquisition, C.7.6.1, C.7.10.1 */
        {0x00080008, "CS", "ORIGINAL\\PRIMARY\\AXIAL"},
        {0x00080022, "DA", "20000101"},
        {0x00080023, "DA", "20000101"},
        {0x00080032, "TM", "120000"},
        {0x00080033, "TM", "120000"},
        {0x00200012, "IS", "1"},
        {0x00200013, "IS", number},
        {0x00280301, "CS", "NO"},
        {0x00282110, "CS", "00"},
        /* Image plane, C.7.6.2 */
        {0x00280030, "DS", spacing},
        {0x00200037, "DS", orientation},
        {0x00200032, "DS", position},
        {0x00180050, "DS", thickness},
        {0x00201041, "DS", location},
        /* Image pixel, C.7.6.3 (numbers by the encoder) */
        {0x00280004, "CS", "MONOCHROME2"},
        /* Contrast/bolus, C.7.6.4 */
        {0x00180010, "LO", "SYNTHETIC"},
        /* CT image, C.8.2.1 */
        {0x00281052, "DS", intercept},
        {0x00281053, "DS", slope},
        {0x00281054, "LO", "HU"},
        {0x00180060, "DS", "120"},
        /* VOI LUT, C.11.2 */
        {0x00281050, "DS", "200"},
        {0x00281051, "DS", "600"},
    };
    size_t plane = (size_t)v->dims[0] * (size_t)v->dims[1];
    return ang_gdcm_encode(texts, sizeof texts / sizeof *texts, v->dims[1], v->dims[0], v->data + (size_t)z * plane,
                           out, size, err);
}

/* A slice of an earlier, longer series would be read as part of neither. */
static bool refuse_mixture(const char *folder, int slices, ang_error *err) {
    DIR *dir = opendir(folder);
    if (!dir) return true;
    bool good = true;
    for (struct dirent *entry; good && (entry = readdir(dir));) {
        int number, end = 0;
        if (sscanf(entry->d_name, "IM%d.dcm%n", &number, &end) != 1 || end == 0 || entry->d_name[end]) continue;
        if (number < 1 || number > slices) {
            good =
                ang_fail(err, ANG_OUTPUT,
                         "%s: holds %s of another series, which would be mixed in; empty the folder or choose another",
                         folder, entry->d_name);
        }
    }
    closedir(dir);
    return good;
}

#ifdef ANG_WITH_GDCM
static bool path_of(const char *folder, int z, char *path, size_t size, ang_error *err) {
    return snprintf(path, size, "%s/IM%04d.dcm", folder, z + 1) < (int)size ||
           ang_fail(err, ANG_OUTPUT, "%s: the name is too long; choose another place", folder);
}

/* *prepared becomes the name of the slice's temporary file, to be freed. */
static bool prepare_slice(const series *s, const char *folder, int z, char **prepared, ang_error *err) {
    char path[PATH_MAX], temporary[PATH_MAX];
    unsigned char *file = NULL;
    size_t size = 0;
    bool good = path_of(folder, z, path, sizeof path, err) && encode_slice(s, z, &file, &size, err) &&
                ang_file_prepare(path, file, size, temporary, sizeof temporary, err);
    free(file);
    if (!good) return false;
    *prepared = strdup(temporary);
    if (*prepared) return true;
    unlink(temporary);
    return ang_fail(err, ANG_LIMIT, "no memory for the names of slices");
}

/* All are on the disk before the first takes its name: an earlier series is whole until the new one is. */
static bool write_slices(const series *s, const char *folder, char **prepared, int count, const ang_progress *progress,
                         ang_error *err) {
    for (int z = 0; z < count; z++) {
        if (!ang_progress_update(progress, "writing slices", (double)z / count))
            return ang_fail(err, ANG_INTERRUPTED, "%s: interrupted; no slice was written", folder);
        if (!prepare_slice(s, folder, z, &prepared[z], err)) return false;
    }
    for (int z = 0; z < count; z++) {
        char path[PATH_MAX];
        if (!path_of(folder, z, path, sizeof path, err) || !ang_file_rename(prepared[z], path, err)) return false;
        free(prepared[z]);
        prepared[z] = NULL;
    }
    ang_progress_update(progress, "writing slices", 1);
    return true;
}
#endif

bool ang_dicom_write(const char *folder, const ang_volume *volume, uint64_t seed, const ang_progress *progress,
                     ang_error *err) {
#ifndef ANG_WITH_GDCM
    (void)encode_slice, (void)plan_series, (void)refuse_mixture, (void)volume, (void)seed, (void)progress;
    return ang_fail(err, ANG_USAGE, "%s: this build has no GDCM (ANG_WITH_GDCM), which writes DICOM", folder);
#else
    series s;
    int count = volume->dims[2];
    if (!plan_series(volume, seed, &s, err) || !ang_folder_make(folder, err) || !refuse_mixture(folder, count, err))
        return false;
    char **prepared = ang_alloc((size_t)count, sizeof *prepared, "slices", err);
    if (!prepared) return false;
    bool good = write_slices(&s, folder, prepared, count, progress, err);
    for (int z = 0; z < count; z++) {
        if (prepared[z]) unlink(prepared[z]);
        free(prepared[z]);
    }
    free(prepared);
    return good;
#endif
}
