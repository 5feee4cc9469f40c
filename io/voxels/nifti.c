#include "io/formats.h"
#include "io/voxels/samples.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

bool ang_nifti2_probe(const char *path) {
    char start[8];
    gzFile file = gzopen(path, "rb");
    int got = file ? gzread(file, start, sizeof start) : -1;
    if (file) gzclose(file);
    return got == (int)sizeof start && (memcmp(start + 4, "n+2", 4) == 0 || memcmp(start + 4, "ni2", 4) == 0);
}

#ifdef ANG_WITH_NIFTI

#include "core/base/memory.h"

#include <limits.h>
#include <math.h>
#include <nifti1_io.h>
#include <unistd.h>

static bool read_header(const char *path, nifti_1_header *header) {
    gzFile file = gzopen(path, "rb");
    if (!file) return false;
    int got = gzread(file, header, sizeof *header);
    gzclose(file);
    return got == (int)sizeof *header && memcmp(&header->magic[2], "1", 2) == 0 && header->magic[0] == 'n' &&
           (header->magic[1] == '+' || header->magic[1] == 'i');
}

bool ang_nifti_probe(const char *path) {
    nifti_1_header header;
    return read_header(path, &header);
}

static bool sample_type(int datatype, ang_sample *type) {
    switch (datatype) {
    case DT_UINT8:
        *type = ANG_SAMPLE_U8;
        return true;
    case DT_INT8:
        *type = ANG_SAMPLE_I8;
        return true;
    case DT_UINT16:
        *type = ANG_SAMPLE_U16;
        return true;
    case DT_INT16:
        *type = ANG_SAMPLE_I16;
        return true;
    case DT_UINT32:
        *type = ANG_SAMPLE_U32;
        return true;
    case DT_INT32:
        *type = ANG_SAMPLE_I32;
        return true;
    case DT_UINT64:
        *type = ANG_SAMPLE_U64;
        return true;
    case DT_INT64:
        *type = ANG_SAMPLE_I64;
        return true;
    case DT_FLOAT32:
        *type = ANG_SAMPLE_F32;
        return true;
    case DT_FLOAT64:
        *type = ANG_SAMPLE_F64;
        return true;
    default:
        return false;
    }
}

/* Millimetres per unit of length (NIfTI-1, xyzt_units); unknown is taken for mm. */
static double unit_mm(const nifti_image *image) {
    return image->xyz_units == NIFTI_UNITS_METER ? 1e3 : image->xyz_units == NIFTI_UNITS_MICRON ? 1e-3 : 1;
}

static bool is_singular(const mat44 *matrix) {
    ang_mat4 map = ang_mat4_identity(), inverse;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) map.m[row][column] = (double)matrix->m[row][column];
    return !ang_mat4_inverse(&map, &inverse);
}

/* A sform that says voxels of another size than the header's own spacing. */
static void compare_spacings(const nifti_image *image, ang_load_report *report) {
    const float size[3] = {image->dx, image->dy, image->dz};
    for (int axis = 0; axis < 3; axis++) {
        ang_vec3 step = {(double)image->sto_xyz.m[0][axis], (double)image->sto_xyz.m[1][axis],
                         (double)image->sto_xyz.m[2][axis]};
        double length = ang_vec3_length(step), other = fabs((double)size[axis]);
        if (other > 0 && fabs(length - other) > 0.01 * other)
            ang_notes_add(&report->warnings,
                          "along its %s axis the sform says voxels of %.4g, pixdim of %.4g: the sform "
                          "is taken",
                          axis == 0   ? "first"
                          : axis == 1 ? "second"
                                      : "third",
                          length, other);
    }
}

/* Voxel index to millimetres right, anterior, superior (NIfTI-1, methods 3, 2 and 1). */
static mat44 find_matrix(const nifti_image *image, ang_load_report *report) {
    bool sform = image->sform_code > 0 && !is_singular(&image->sto_xyz);
    if (image->sform_code > 0 && !sform) ang_notes_add(&report->warnings, "its sform is singular and is not used");
    if (sform) {
        ang_notes_add(&report->assumptions, "orientation from the sform (code %d)", image->sform_code);
        compare_spacings(image, report);
        return image->sto_xyz;
    }
    if (image->qform_code > 0) {
        ang_notes_add(&report->assumptions, "orientation from the qform (code %d)", image->qform_code);
        return image->qto_xyz;
    }
    mat44 matrix = {{{0}}};
    const float size[3] = {image->dx, image->dy, image->dz};
    for (int axis = 0; axis < 3; axis++) matrix.m[axis][axis] = size[axis] > 0 ? size[axis] : 1;
    matrix.m[3][3] = 1;
    ang_notes_add(&report->warnings, "neither sform nor qform: orientation is not known, x is taken as right, y as "
                                     "anterior, z as superior");
    return matrix;
}

/* NIfTI's axes are right, anterior, superior; ours are left, posterior, superior. */
static bool set_affine(const nifti_image *image, ang_volume *volume, ang_load_report *report, ang_error *err,
                       const char *label) {
    mat44 matrix = find_matrix(image, report);
    double unit = unit_mm(image);
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++)
            volume->affine.m[row][column] = (row < 2 ? -unit : unit) * (double)matrix.m[row][column];
    }
    ang_mat4 inverse;
    if (!ang_mat4_inverse(&volume->affine, &inverse))
        return ang_fail(err, ANG_GEOMETRY, "%s: its orientation matrix is singular", label);
    return true;
}

/* The voxels' file: the header's own, or .img beside .hdr. To be freed; NULL where it is missing. */
static char *voxel_file(const char *path, const nifti_1_header *header) {
    if (header->magic[1] == '+') return strdup(path);
    const char *end = strstr(ang_base_name(path), ".hdr");
    if (!end) return NULL;
    static const char *const endings[] = {".img", ".img.gz"};
    for (int i = 0; i < 2; i++) {
        char *name = NULL;
        if (asprintf(&name, "%.*s%s", (int)(end - path), path, endings[i]) < 0) return NULL;
        if (access(name, R_OK) == 0) return name;
        free(name);
    }
    return NULL;
}

/* Volumes behind one another: the axes from the fourth on. */
static int phases_of(const nifti_image *image) {
    size_t phases = 1;
    for (int d = 4; d <= image->ndim && d < 8; d++)
        phases = ang_product3(phases, image->dim[d] > 0 ? (size_t)image->dim[d] : 1, 1);
    return phases < INT_MAX ? (int)phases : INT_MAX;
}

/* Names the phases by their times where the header gives any. */
static bool name_phases(const nifti_image *image, ang_series_info *info, ang_error *err) {
    const char *unit = image->time_units == NIFTI_UNITS_SEC    ? "s"
                       : image->time_units == NIFTI_UNITS_MSEC ? "ms"
                       : image->time_units == NIFTI_UNITS_USEC ? "us"
                                                               : NULL;
    bool timed = unit && image->dt > 0 && image->ndim <= 4;
    return !timed || ang_samples_name_phases(info, (double)image->toffset, (double)image->dt, unit, err);
}

static ang_volume *load_image(const nifti_image *image, const char *voxels, uint64_t skip, const char *label,
                              const ang_load_options *options, ang_load_report *report, const ang_progress *progress,
                              ang_error *err) {
    const ang_byte_part part = {.path = voxels};
    ang_sample_source source = {.label = label,
                                .field = "dim",
                                .parts = {.part = &part, .count = 1},
                                .slope = 1,
                                .phases = phases_of(image),
                                .slices = options->slices};
    if (!sample_type(image->datatype, &source.type)) {
        ang_fail(err, ANG_INPUT, "%s: data type %d (%s) is not read: it must be a whole or floating-point number",
                 label, image->datatype, nifti_datatype_string(image->datatype));
        return NULL;
    }
    source.parts.skip = skip;
    source.dims[0] = image->nx;
    source.dims[1] = image->ny > 0 ? image->ny : 1;
    source.dims[2] = image->nz > 0 ? image->nz : 1;
    source.big_endian = (image->byteorder == nifti_short_order()) == (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
    if (image->scl_slope != 0 && isfinite(image->scl_slope)) {
        source.slope = (double)image->scl_slope;
        source.intercept = isfinite(image->scl_inter) ? (double)image->scl_inter : 0;
    }
    if (!ang_load_phase(label, source.phases, options, &source.phase, err)) return NULL;
    ang_volume *volume = ang_samples_read(&source, options->threads, report, progress, err);
    if (!volume) return NULL;
    if (set_affine(image, volume, report, err, label) &&
        ang_samples_list(volume, source.phases, "?", image->descrip, report, err) &&
        name_phases(image, report->series, err))
        return volume;
    ang_volume_free(volume);
    return NULL;
}

/* Whether a header's numbers are in the other byte order: as the library tells it. */
static bool is_swapped(const nifti_1_header *header) { return header->dim[0] < 1 || header->dim[0] > 7; }

static float header_float(const nifti_1_header *header, const float *member) {
    uint32_t bits;
    float value;
    memcpy(&bits, member, sizeof bits);
    if (is_swapped(header)) bits = __builtin_bswap32(bits);
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* What the library would print about: it is asked only where it has nothing to say. */
static bool is_sound(const nifti_1_header *header) {
    uint16_t dim[2], type;
    memcpy(dim, header->dim, sizeof dim);
    memcpy(&type, &header->datatype, sizeof type);
    if (is_swapped(header)) {
        dim[0] = __builtin_bswap16(dim[0]);
        dim[1] = __builtin_bswap16(dim[1]);
        type = __builtin_bswap16(type);
    }
    return dim[0] >= 1 && dim[0] <= 7 && dim[1] >= 1 && dim[1] <= INT16_MAX && nifti_is_valid_datatype(type);
}

/* Where the voxels begin, in bytes of their file unpacked. The library would take what is no such place for the end of
 * the header, where four more bytes are the format's. */
static bool find_voxels(const nifti_1_header *header, const char *label, uint64_t *skip, ang_load_report *report,
                        ang_error *err) {
    bool one_file = header->magic[1] == '+';
    double offset = (double)header_float(header, &header->vox_offset);
    double least = one_file ? sizeof *header : 0;
    if (offset == 0 && one_file) {
        offset = 352;
        ang_notes_add(&report->warnings, "vox_offset is 0: its voxels are taken to begin at byte 352");
    }
    if (!(offset >= least && offset < 0x1p53 && offset == floor(offset)))
        return ang_fail(err, ANG_INPUT, "%s: its voxels cannot begin at byte %g (vox_offset)", label, offset);
    *skip = (uint64_t)offset;
    return true;
}

/* Spacings are lengths: where one is negative, 0 or no number the library would take 1 mm for it and say nothing. */
static void mend_spacings(nifti_1_header *header, ang_load_report *report) {
    bool negative = false, unknown = false;
    int axes = is_swapped(header) ? (int)__builtin_bswap16((uint16_t)header->dim[0]) : header->dim[0];
    for (int axis = 1; axis <= 3; axis++) {
        float spacing = header_float(header, &header->pixdim[axis]);
        unknown = unknown || (axis <= axes && !(isfinite(spacing) && spacing != 0));
        if (!signbit(spacing)) continue;
        uint32_t bits; /* in either byte order: the sign is in the first or the last byte */
        memcpy(&bits, &header->pixdim[axis], sizeof bits);
        bits ^= is_swapped(header) ? 0x80U : 0x80000000U;
        memcpy(&header->pixdim[axis], &bits, sizeof bits);
        negative = true;
    }
    if (negative)
        ang_notes_add(&report->warnings, "a spacing is negative: its amount is taken, and nothing is turned round");
    if (unknown) ang_notes_add(&report->warnings, "a spacing (pixdim) is 0 or no number: 1 is taken for it");
}

/* The library would take 0 for what is no number. */
static void mend_qform(nifti_1_header *header, ang_load_report *report) {
    const float *const members[] = {&header->quatern_b, &header->quatern_c, &header->quatern_d,
                                    &header->qoffset_x, &header->qoffset_y, &header->qoffset_z};
    bool finite = true;
    for (int i = 0; i < 6; i++) finite = finite && isfinite(header_float(header, members[i]));
    if (finite || header->qform_code == 0) return;
    header->qform_code = 0;
    ang_notes_add(&report->warnings, "its qform holds what is no number and is not used");
}

ang_volume *ang_nifti_load(const char *path, const ang_load_options *options, ang_load_report *report,
                           const ang_progress *progress, ang_error *err) {
    snprintf(report->format, sizeof report->format, "NIfTI-1");
    const char *label = ang_base_name(path);
    nifti_1_header header;
    if (!read_header(path, &header)) {
        ang_fail(err, ANG_INPUT, "%s: is no NIfTI-1 file", label);
        return NULL;
    }
    if (!is_sound(&header)) {
        ang_fail(err, ANG_INPUT, "%s: its NIfTI-1 header is damaged", label);
        return NULL;
    }
    char *voxels = voxel_file(path, &header);
    if (!voxels) {
        ang_fail(err, ANG_INPUT, "%s: its voxels should be in a .img file beside it", label);
        return NULL;
    }
    uint64_t skip = 0;
    if (!find_voxels(&header, label, &skip, report, err)) {
        free(voxels);
        return NULL;
    }
    mend_spacings(&header, report);
    mend_qform(&header, report);
    nifti_set_debug_level(0); /* the library complains to stderr otherwise */
    /* The name decides nothing here, the library wants an ending it knows. */
    nifti_image *image = nifti_convert_nhdr2nim(header, header.magic[1] == '+' ? "volume.nii" : "volume.hdr");
    ang_volume *volume = NULL;
    if (!image || image->nx < 1)
        ang_fail(err, ANG_INPUT, "%s: its NIfTI-1 header is damaged", label);
    else
        volume = load_image(image, voxels, skip, label, options, report, progress, err);
    if (image) nifti_image_free(image);
    free(voxels);
    return volume;
}

#else

bool ang_nifti_probe(const char *path) {
    char header[348];
    gzFile file = gzopen(path, "rb");
    int got = file ? gzread(file, header, sizeof header) : -1;
    if (file) gzclose(file);
    return got == (int)sizeof header && (memcmp(header + 344, "n+1", 4) == 0 || memcmp(header + 344, "ni1", 4) == 0);
}

ang_volume *ang_nifti_load(const char *path, const ang_load_options *options, ang_load_report *report,
                           const ang_progress *progress, ang_error *err) {
    (void)options, (void)progress;
    snprintf(report->format, sizeof report->format, "NIfTI-1");
    ang_fail(err, ANG_INPUT, "%s: NIfTI-1, which this build does not read", ang_base_name(path));
    return NULL;
}

#endif
