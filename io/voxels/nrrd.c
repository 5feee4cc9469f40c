/* NRRD headers, attached and detached: "Definition of NRRD File Format", teem.sourceforge.net/nrrd/format.html. Read by
 * own code, since teem allocates what a header claims before it looks at the file. */
#include "io/voxels/nrrd_axes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct parsing {
    const char *label;
    ang_volume_header *header;
    ang_nrrd_axes axes;
    bool has_type, has_sizes, has_coding, has_endian, has_data_file;
    double old_min, old_max;
} parsing;

static bool refuse(const parsing *p, ang_error *err, const char *field, const char *value) {
    return ang_fail(err, ANG_INPUT, "%s: its NRRD header says \"%s: %.200s\", which is not understood", p->label, field,
                    value);
}

static bool use_type(parsing *p, const char *field, const char *value, ang_error *err) {
    static const struct {
        const char *name;
        ang_sample type;
    } types[] = {{"signed char", ANG_SAMPLE_I8},
                 {"int8", ANG_SAMPLE_I8},
                 {"int8_t", ANG_SAMPLE_I8},
                 {"uchar", ANG_SAMPLE_U8},
                 {"unsigned char", ANG_SAMPLE_U8},
                 {"uint8", ANG_SAMPLE_U8},
                 {"uint8_t", ANG_SAMPLE_U8},
                 {"short", ANG_SAMPLE_I16},
                 {"short int", ANG_SAMPLE_I16},
                 {"signed short", ANG_SAMPLE_I16},
                 {"signed short int", ANG_SAMPLE_I16},
                 {"int16", ANG_SAMPLE_I16},
                 {"int16_t", ANG_SAMPLE_I16},
                 {"ushort", ANG_SAMPLE_U16},
                 {"unsigned short", ANG_SAMPLE_U16},
                 {"unsigned short int", ANG_SAMPLE_U16},
                 {"uint16", ANG_SAMPLE_U16},
                 {"uint16_t", ANG_SAMPLE_U16},
                 {"int", ANG_SAMPLE_I32},
                 {"signed int", ANG_SAMPLE_I32},
                 {"int32", ANG_SAMPLE_I32},
                 {"int32_t", ANG_SAMPLE_I32},
                 {"uint", ANG_SAMPLE_U32},
                 {"unsigned int", ANG_SAMPLE_U32},
                 {"uint32", ANG_SAMPLE_U32},
                 {"uint32_t", ANG_SAMPLE_U32},
                 {"longlong", ANG_SAMPLE_I64},
                 {"long long", ANG_SAMPLE_I64},
                 {"long long int", ANG_SAMPLE_I64},
                 {"signed long long", ANG_SAMPLE_I64},
                 {"signed long long int", ANG_SAMPLE_I64},
                 {"int64", ANG_SAMPLE_I64},
                 {"int64_t", ANG_SAMPLE_I64},
                 {"ulonglong", ANG_SAMPLE_U64},
                 {"unsigned long long", ANG_SAMPLE_U64},
                 {"unsigned long long int", ANG_SAMPLE_U64},
                 {"uint64", ANG_SAMPLE_U64},
                 {"uint64_t", ANG_SAMPLE_U64},
                 {"float", ANG_SAMPLE_F32},
                 {"double", ANG_SAMPLE_F64}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (!ang_header_is(value, types[i].name)) continue;
        p->header->type = types[i].type;
        p->has_type = true;
        return true;
    }
    return refuse(p, err, field, value);
}

static bool use_coding(parsing *p, const char *field, const char *value, ang_error *err) {
    static const struct {
        const char *name;
        ang_coding coding;
    } codings[] = {{"raw", ANG_CODING_PLAIN},   {"gzip", ANG_CODING_DEFLATE}, {"gz", ANG_CODING_DEFLATE},
                   {"bzip2", ANG_CODING_BZIP2}, {"bz2", ANG_CODING_BZIP2},    {"ascii", ANG_CODING_TEXT},
                   {"text", ANG_CODING_TEXT},   {"txt", ANG_CODING_TEXT},     {"hex", ANG_CODING_HEX}};
    for (size_t i = 0; i < sizeof codings / sizeof *codings; i++) {
        if (!ang_header_is(value, codings[i].name)) continue;
        p->header->coding = codings[i].coding;
        p->header->skip_packed = codings[i].coding != ANG_CODING_DEFLATE && codings[i].coding != ANG_CODING_BZIP2;
        p->has_coding = true;
        return true;
    }
    return refuse(p, err, field, value);
}

static bool use_endian(parsing *p, const char *field, const char *value, ang_error *err) {
    p->header->big_endian = ang_header_is(value, "big");
    p->has_endian = true;
    return p->header->big_endian || ang_header_is(value, "little") || refuse(p, err, field, value);
}

static bool use_skip(parsing *p, const char *field, const char *value, ang_error *err) {
    double number;
    bool bytes = (field[0] | 0x20) == 'b';
    if (ang_header_numbers(value, &number, 1) != 1 || number != floor(number) || number > 1e15 ||
        number < (bytes ? -1 : 0))
        return refuse(p, err, field, value);
    if (bytes)
        p->header->byte_skip = (int64_t)number;
    else
        p->header->line_skip = (uint64_t)number;
    return true;
}

static bool use_range(parsing *p, const char *field, const char *value, ang_error *err) {
    (void)err;
    double number;
    if (ang_header_numbers(value, &number, 1) != 1) return true; /* it is only told of */
    *(strstr(field, "max") ? &p->old_max : &p->old_min) = number;
    return true;
}

/* "LIST [DIM]", "PATTERN FIRST LAST STEP [DIM]", "LOCAL" or a name. `DIM` is told by the sizes anyway. */
static bool use_data_file(parsing *p, const char *field, const char *value, ang_error *err) {
    double number[4];
    char pattern[ANG_HEADER_LINE];
    const char *rest = value;
    if (!ang_header_word(&rest, pattern, sizeof pattern)) return refuse(p, err, field, value);
    p->has_data_file = !ang_header_is(value, "LOCAL");
    if (!p->has_data_file || strcmp(pattern, "LIST") == 0) return true;
    int numbers = strchr(pattern, '%') ? ang_header_numbers(rest, number, 4) : 0;
    if (numbers >= 3)
        return ang_volume_header_add_numbered(p->header, p->label, pattern, number[0], number[1], number[2], err);
    return ang_volume_header_add_file(p->header, value, err);
}

static bool use_axes(parsing *p, const char *field, const char *value, ang_error *err) {
    bool known;
    if (!ang_nrrd_axes_field(&p->axes, p->label, field, value, &known, err)) return false;
    p->has_sizes = p->has_sizes || ang_header_is(field, "sizes");
    /* Fields that no volume depends on, and such as later versions may bring, are passed over. */
    return true;
}

static bool use_field(parsing *p, const char *field, const char *value, ang_error *err) {
    static const struct {
        const char *name;
        bool (*use)(parsing *p, const char *field, const char *value, ang_error *err);
    } fields[] = {{"type", use_type},      {"encoding", use_coding},     {"endian", use_endian},
                  {"line skip", use_skip}, {"lineskip", use_skip},       {"byte skip", use_skip},
                  {"byteskip", use_skip},  {"data file", use_data_file}, {"datafile", use_data_file},
                  {"old min", use_range},  {"oldmin", use_range},        {"old max", use_range},
                  {"oldmax", use_range}};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
        if (ang_header_is(field, fields[i].name)) return fields[i].use(p, field, value, err);
    return use_axes(p, field, value, err);
}

static bool use_line(parsing *p, char *line, ang_error *err) {
    char *pair = strstr(line, ":="), *colon = strstr(line, ": ");
    if (line[0] == '#' || (pair && (!colon || pair < colon))) return true; /* a comment, or a key and its value */
    if (!colon) {
        size_t length = strlen(line); /* a field without a value has lost its blank */
        if (length > 0 && line[length - 1] == ':') return true;
        return ang_fail(err, ANG_INPUT, "%s: its NRRD header has a line that is no field, \"%.100s\"", p->label, line);
    }
    *colon = '\0';
    const char *value = colon + 2;
    while (*value == ' ' || *value == '\t') value++;
    return use_field(p, line, value, err);
}

/* The rest of a detached header: a file in each line. */
static bool use_list(parsing *p, const uint8_t *bytes, size_t size, size_t *at, ang_error *err) {
    char line[ANG_HEADER_LINE];
    while (ang_header_line(bytes, size, at, line)) {
        if (!line[0]) continue;
        if (p->header->file_count == ANG_HEADER_FILES)
            return ang_fail(err, ANG_INPUT, "%s: lists more than %d files of voxels", p->label, ANG_HEADER_FILES);
        if (!ang_volume_header_add_file(p->header, line, err)) return false;
    }
    return p->header->file_count > 0 || ang_fail(err, ANG_INPUT, "%s: its list of files is empty", p->label);
}

static bool read_fields(parsing *p, const uint8_t *bytes, size_t size, ang_error *err) {
    char line[ANG_HEADER_LINE];
    size_t at = 0;
    if (!ang_header_line(bytes, size, &at, line) || strncmp(line, "NRRD000", 7) != 0)
        return ang_fail(err, ANG_INPUT, "%s: is no NRRD file", p->label);
    bool ended = false;
    while (!ended && ang_header_line(bytes, size, &at, line)) {
        ended = !line[0];
        if (!ended && !use_line(p, line, err)) return false;
        if (p->has_data_file && p->header->file_count == 0) return use_list(p, bytes, size, &at, err);
    }
    p->header->offset = at;
    return ended || p->has_data_file ||
           ang_fail(err, ANG_INPUT, "%s: its NRRD header does not end, and names no file of voxels", p->label);
}

static bool check_fields(parsing *p, ang_error *err) {
    const char *missing = !p->has_type ? "type" : !p->has_sizes ? "sizes" : !p->has_coding ? "encoding" : NULL;
    if (missing) return ang_fail(err, ANG_INPUT, "%s: its NRRD header has no \"%s\"", p->label, missing);
    bool text = p->header->coding == ANG_CODING_TEXT;
    if (text)
        p->header->big_endian = false; /* as it is unpacked */
    else if (!p->has_endian && ang_sample_size(p->header->type) > 1)
        ang_notes_add(&p->header->warnings, "its header has no \"endian\": little is taken");
    if (p->header->byte_skip < 0 && p->header->coding != ANG_CODING_PLAIN)
        return ang_fail(err, ANG_INPUT, "%s: \"byte skip: -1\" goes with \"encoding: raw\" alone", p->label);
    if (isfinite(p->old_min) && isfinite(p->old_max))
        ang_notes_add(&p->header->warnings,
                      "its values were quantised from %g to %g (old min, old max): they are taken as they are",
                      p->old_min, p->old_max);
    return true;
}

bool ang_nrrd_parse(const char *label, const uint8_t *bytes, size_t size, ang_volume_header *header, ang_error *err) {
    parsing p = {.label = label, .header = header, .old_min = NAN, .old_max = NAN};
    *header = (ang_volume_header){.format = "NRRD", .field = "sizes", .slope = 1, .phases = 1};
    ang_nrrd_axes_start(&p.axes);
    return read_fields(&p, bytes, size, err) && check_fields(&p, err) && ang_nrrd_axes_use(&p.axes, label, header, err);
}
