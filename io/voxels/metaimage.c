/* MetaImage headers (.mha, .mhd): itk.org/Wiki/MetaIO/Documentation. TransformMatrix holds the direction of each axis
 * in turn, Offset the centre of the first voxel, both in LPS, as ITK reads them. */
#include "io/voxels/header_text.h"
#include "io/voxels/volume_header.h"

#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_axes = 4 };

typedef struct parsing {
    const char *label;
    ang_volume_header *header;
    int axes; /* NDims; 0: not said yet */
    double size[most_axes], spacing[most_axes], extent[most_axes], offset[most_axes], centre[most_axes],
        matrix[most_axes * most_axes];
    bool has_size, has_spacing, has_extent, has_offset, has_centre, has_matrix, has_type, has_data;
    bool packed, text;
    double unit_mm;
} parsing;

static bool refuse(const parsing *p, ang_error *err, const char *key, const char *value) {
    return ang_fail(err, ANG_INPUT, "%s: its MetaImage header says \"%s = %.200s\", which is not understood", p->label,
                    key, value);
}

static bool is_true(const char *value) { return toupper((unsigned char)value[0]) == 'T' || value[0] == '1'; }

static bool use_type(parsing *p, const char *key, const char *value, ang_error *err) {
    static const struct {
        const char *name;
        ang_sample type;
    } types[] = {
        {"MET_CHAR", ANG_SAMPLE_I8},       {"MET_UCHAR", ANG_SAMPLE_U8},       {"MET_SHORT", ANG_SAMPLE_I16},
        {"MET_USHORT", ANG_SAMPLE_U16},    {"MET_INT", ANG_SAMPLE_I32},        {"MET_UINT", ANG_SAMPLE_U32},
        {"MET_LONG", ANG_SAMPLE_I32},      {"MET_ULONG", ANG_SAMPLE_U32}, /* four bytes, whatever the machine */
        {"MET_LONG_LONG", ANG_SAMPLE_I64}, {"MET_ULONG_LONG", ANG_SAMPLE_U64}, {"MET_FLOAT", ANG_SAMPLE_F32},
        {"MET_DOUBLE", ANG_SAMPLE_F64}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (!ang_header_is(value, types[i].name)) continue;
        p->header->type = types[i].type;
        p->has_type = true;
        return true;
    }
    return refuse(p, err, key, value);
}

/* `count` numbers; false where there are others or fewer. */
static bool take_numbers(const char *value, int count, double *out, bool *has) {
    *has = ang_header_numbers(value, out, count) == count;
    for (int i = 0; i < count && *has; i++) *has = isfinite(out[i]);
    return *has;
}

/* What is given for each axis; `*known` is left false for other keys. */
static bool use_axes(parsing *p, const char *key, const char *value, bool *known, ang_error *err) {
    const struct {
        const char *name;
        double *numbers;
        bool *has;
    } keys[] = {{"DimSize", p->size, &p->has_size},
                {"ElementSpacing", p->spacing, &p->has_spacing},
                {"ElementSize", p->extent, &p->has_extent},
                {"Offset", p->offset, &p->has_offset},
                {"Position", p->offset, &p->has_offset},
                {"Origin", p->offset, &p->has_offset},
                {"CenterOfRotation", p->centre, &p->has_centre},
                {"TransformMatrix", p->matrix, &p->has_matrix},
                {"Rotation", p->matrix, &p->has_matrix},
                {"Orientation", p->matrix, &p->has_matrix}};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        if (!ang_header_is(key, keys[i].name)) continue;
        *known = true;
        if (p->axes == 0)
            return ang_fail(err, ANG_INPUT, "%s: its MetaImage header has %s before NDims", p->label, key);
        int count = keys[i].numbers == p->matrix ? p->axes * p->axes : p->axes;
        return take_numbers(value, count, keys[i].numbers, keys[i].has) || refuse(p, err, key, value);
    }
    return true;
}

static bool use_number(parsing *p, const char *key, const char *value, ang_error *err) {
    double number;
    if (ang_header_numbers(value, &number, 1) != 1 || !isfinite(number)) return refuse(p, err, key, value);
    bool whole = number == floor(number);
    if (ang_header_is(key, "NDims")) {
        if (!whole || number < 2 || number > most_axes)
            return ang_fail(err, ANG_INPUT, "%s: has %g axes; volumes of 2 to 4 are read", p->label, number);
        p->axes = (int)number;
    } else if (ang_header_is(key, "HeaderSize")) {
        if (!whole || number < -1 || number > 1e15) return refuse(p, err, key, value);
        p->header->byte_skip = (int64_t)number;
    } else if (ang_header_is(key, "ElementNumberOfChannels")) {
        if (number != 1)
            return ang_fail(err, ANG_INPUT, "%s: has %g numbers in each voxel: a CT has one", p->label, number);
    } else if (ang_header_is(key, "ElementToIntensityFunctionSlope")) {
        if (number != 0) p->header->slope = number;
    } else {
        p->header->intercept = number;
    }
    return true;
}

static bool use_switch(parsing *p, const char *key, const char *value, ang_error *err) {
    (void)err;
    if (ang_header_is(key, "CompressedData"))
        p->packed = is_true(value);
    else if (ang_header_is(key, "BinaryData"))
        p->text = !is_true(value);
    else
        p->header->big_endian = is_true(value);
    return true;
}

static bool use_unit(parsing *p, const char *key, const char *value, ang_error *err) {
    (void)key, (void)err;
    double mm = ang_header_unit_mm(value);
    if (isfinite(mm)) p->unit_mm = mm;
    return true;
}

/* A new key is read where it is none of these: no volume depends on it. */
static bool use_key(parsing *p, const char *key, const char *value, ang_error *err) {
    static const struct {
        const char *name;
        bool (*use)(parsing *p, const char *key, const char *value, ang_error *err);
    } keys[] = {{"ElementType", use_type},
                {"NDims", use_number},
                {"HeaderSize", use_number},
                {"ElementNumberOfChannels", use_number},
                {"ElementToIntensityFunctionSlope", use_number},
                {"ElementToIntensityFunctionOffset", use_number},
                {"CompressedData", use_switch},
                {"BinaryData", use_switch},
                {"BinaryDataByteOrderMSB", use_switch},
                {"ElementByteOrderMSB", use_switch},
                {"DistanceUnits", use_unit}};
    bool known = false;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (ang_header_is(key, keys[i].name)) return keys[i].use(p, key, value, err);
    if (!use_axes(p, key, value, &known, err)) return false;
    if (!known && ang_header_is(key, "ObjectType") && !ang_header_is(value, "Image"))
        return ang_fail(err, ANG_INPUT, "%s: is a MetaIO file of type %.40s: an Image is needed", p->label, value);
    return true;
}

/* "LOCAL", "LIST [axes]" with a name in each line that follows, "PATTERN first last step", or a name. */
static bool use_data_file(parsing *p, const char *value, const uint8_t *bytes, size_t size, size_t at, ang_error *err) {
    char pattern[ANG_HEADER_LINE], line[ANG_HEADER_LINE];
    double number[3];
    const char *rest = value;
    p->has_data = true;
    p->header->offset = at;
    if (ang_header_is(value, "LOCAL")) return true;
    if (!ang_header_word(&rest, pattern, sizeof pattern)) return refuse(p, err, "ElementDataFile", value);
    if (strchr(pattern, '%') && ang_header_numbers(rest, number, 3) == 3)
        return ang_volume_header_add_numbered(p->header, p->label, pattern, number[0], number[1], number[2], err);
    if (strcmp(pattern, "LIST") != 0) return ang_volume_header_add_file(p->header, value, err);
    while (ang_header_line(bytes, size, &at, line)) {
        if (!line[0]) continue;
        if (p->header->file_count == ANG_HEADER_FILES)
            return ang_fail(err, ANG_INPUT, "%s: lists more than %d files of voxels", p->label, ANG_HEADER_FILES);
        if (!ang_volume_header_add_file(p->header, line, err)) return false;
    }
    return p->header->file_count > 0 || ang_fail(err, ANG_INPUT, "%s: its list of files is empty", p->label);
}

static bool read_keys(parsing *p, const uint8_t *bytes, size_t size, ang_error *err) {
    char line[ANG_HEADER_LINE];
    size_t at = 0;
    while (!p->has_data && ang_header_line(bytes, size, &at, line)) {
        char *key = line + strspn(line, " \t"), *equals = key + strcspn(key, "=:"), *value = equals;
        if (!*key || *key == '#') continue;
        if (!*equals)
            return ang_fail(err, ANG_INPUT, "%s: its MetaImage header has a line that is no field, \"%.100s\"",
                            p->label, key);
        value += 1 + strspn(equals + 1, " \t");
        while (equals > key && isspace((unsigned char)equals[-1])) equals--;
        *equals = '\0';
        bool ok = ang_header_is(key, "ElementDataFile") ? use_data_file(p, value, bytes, size, at, err)
                                                        : use_key(p, key, value, err);
        if (!ok) return false;
    }
    const char *missing = !p->axes       ? "NDims"
                          : !p->has_size ? "DimSize"
                          : !p->has_type ? "ElementType"
                          : !p->has_data ? "ElementDataFile"
                                         : NULL;
    return !missing || ang_fail(err, ANG_INPUT, "%s: its MetaImage header has no %s", p->label, missing);
}

static bool use_coding(parsing *p, ang_error *err) {
    ang_volume_header *header = p->header;
    header->coding = p->packed ? ANG_CODING_DEFLATE : p->text ? ANG_CODING_TEXT : ANG_CODING_PLAIN;
    header->skip_packed = true;
    if (header->byte_skip > 0) header->offset = 0; /* MetaIO counts HeaderSize from the file's begin, LOCAL too */
    if (p->text) header->big_endian = false;       /* as it is unpacked */
    if (header->byte_skip < 0 && header->coding != ANG_CODING_PLAIN)
        return ang_fail(err, ANG_INPUT, "%s: \"HeaderSize = -1\" goes with plain voxels alone", p->label);
    if (header->slope != 1 || header->intercept != 0)
        ang_notes_add(&header->assumptions, "values are mapped by ElementToIntensityFunction: %g times, plus %g",
                      header->slope, header->intercept);
    return true;
}

static bool use_sizes(parsing *p, ang_error *err) {
    ang_volume_header *header = p->header;
    for (int i = 0; i < p->axes; i++)
        if (!(p->size[i] >= 1 && p->size[i] <= INT_MAX && p->size[i] == floor(p->size[i])))
            return ang_fail(err, ANG_INPUT, "%s: an axis of %g voxels cannot be", p->label, p->size[i]);
    for (int i = 0; i < 3; i++) header->dims[i] = i < p->axes ? (int)p->size[i] : 1;
    if (p->axes < 4) return true;
    header->phases = (int)p->size[3];
    header->phase_first = p->offset[3];
    header->phase_step = p->has_spacing ? p->spacing[3] : NAN;
    return true;
}

static bool use_geometry(parsing *p, ang_error *err) {
    ang_volume_header *header = p->header;
    const double *spacing = p->has_spacing ? p->spacing : p->extent;
    ang_mat4 affine = {0}, inverse;
    affine.m[3][3] = 1;
    for (int axis = 0; axis < 3; axis++) {
        bool given = axis < p->axes;
        double mm = given && (p->has_spacing || p->has_extent) ? spacing[axis] * p->unit_mm : 1;
        for (int row = 0; row < 3; row++) {
            double identity = row == axis ? 1 : 0;
            bool turned = p->has_matrix && given && row < p->axes;
            affine.m[row][axis] = mm * (turned ? p->matrix[axis * p->axes + row] : identity);
        }
        affine.m[axis][3] = given ? p->offset[axis] * p->unit_mm : 0;
    }
    if (!p->has_spacing && p->has_extent)
        ang_notes_add(&header->assumptions, "no ElementSpacing: the ElementSize is taken");
    if (!p->has_spacing && !p->has_extent)
        ang_notes_add(&header->warnings, "no ElementSpacing: voxels are taken as 1 x 1 x 1 mm");
    if (!p->has_matrix)
        ang_notes_add(&header->warnings, "no TransformMatrix: orientation is not known, x is taken as left, y as "
                                         "posterior, z as superior");
    if (p->has_matrix && !p->has_offset)
        ang_notes_add(&header->assumptions, "no Offset: the first voxel is taken to lie at 0,0,0");
    if (p->axes == 2) ang_notes_add(&header->assumptions, "it is a single slice: 1 mm thick");
    bool off_centre = p->has_centre && (p->centre[0] != 0 || p->centre[1] != 0 || (p->axes > 2 && p->centre[2] != 0));
    if (off_centre)
        ang_notes_add(&header->assumptions, "CenterOfRotation is not used: Offset is the first voxel's place");
    if (!ang_mat4_inverse(&affine, &inverse))
        return ang_fail(err, ANG_GEOMETRY, "%s: its TransformMatrix and spacing do not span a volume", p->label);
    header->affine = affine;
    return true;
}

bool ang_metaimage_parse(const char *label, const uint8_t *bytes, size_t size, ang_volume_header *header,
                         ang_error *err) {
    parsing p = {.label = label, .header = header, .unit_mm = 1};
    *header =
        (ang_volume_header){.format = "MetaImage", .field = "DimSize", .slope = 1, .phases = 1, .phase_step = NAN};
    return read_keys(&p, bytes, size, err) && use_coding(&p, err) && use_sizes(&p, err) && use_geometry(&p, err);
}
