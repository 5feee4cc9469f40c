/* What the header of a file says of its volume, whatever the format, and how the volume is read by it. Private to io/.
 * Parsers are functions of bytes: they open nothing. */
#ifndef ANG_VOXELS_VOLUME_HEADER_H
#define ANG_VOXELS_VOLUME_HEADER_H

#include "core/math/vec.h"
#include "io/load.h"
#include "io/voxels/byte_stream.h"

/* Owns its strings; zero-initialise. */
typedef struct ang_volume_header {
    char format[16];
    const char *field;              /* what the format calls `dims` */
    int dims[3];                    /* of one phase, x fastest */
    ang_mat4 affine;                /* voxel index to LPS mm */
    int phases;                     /* >= 1 */
    size_t phase_run;               /* as in ang_sample_source */
    double phase_first, phase_step; /* what each phase is, in `phase_unit` ("": not known); NaN: not known */
    char phase_unit[16];
    ang_sample type;
    bool big_endian;
    double slope, intercept; /* HU = slope * sample + intercept */
    ang_coding coding;
    char **file; /* of the voxels, as the header names them: relative to its folder; none: the header's own */
    size_t file_count;
    uint64_t offset;    /* where the voxels begin in the header's own file */
    uint64_t line_skip; /* lines of each file to be passed over, before `byte_skip` */
    int64_t byte_skip;  /* bytes to be passed over, unpacked; -1: the voxels are at the end of the file */
    bool skip_packed;   /* these are bytes of the file: they come before unpacking */
    ang_notes assumptions, warnings;
} ang_volume_header;

enum { ANG_HEADER_FILES = 65536 }; /* the most files of voxels */

void ang_volume_header_clear(ang_volume_header *header);
/* Appends a name of a voxels' file. False with ANG_LIMIT. */
bool ang_volume_header_add_file(ang_volume_header *header, const char *name, ang_error *err);
/* Appends the names that a printf pattern with one %d makes of first, first + step, ... last. False with ANG_INPUT
 * where it is no such pattern or the numbers make no list, ANG_LIMIT. */
bool ang_volume_header_add_numbered(ang_volume_header *header, const char *label, const char *pattern, double first,
                                    double last, double step, ang_error *err);

/* Parse the first `size` bytes of a file that `label` names; that may be the whole of it. False with ANG_INPUT,
 * ANG_GEOMETRY, ANG_LIMIT; to be cleared all the same. */
bool ang_nrrd_parse(const char *label, const uint8_t *bytes, size_t size, ang_volume_header *header, ang_error *err);
bool ang_metaimage_parse(const char *label, const uint8_t *bytes, size_t size, ang_volume_header *header,
                         ang_error *err);

/* Reads the file's begin and parses it. */
typedef bool ang_header_parser(const char *label, const uint8_t *bytes, size_t size, ang_volume_header *header,
                               ang_error *err);
bool ang_volume_header_read(const char *path, ang_header_parser *parse, ang_volume_header *header, ang_error *err);
/* The report's list for it, without a volume being read. */
bool ang_volume_header_list(const ang_volume_header *header, const char *path, ang_load_report *report, ang_error *err);

#endif
