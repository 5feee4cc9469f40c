#include "io/voxels/volume_header.h"

#include "core/base/memory.h"
#include "io/formats.h"
#include "io/replace.h"
#include "io/voxels/samples.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { most_header = 4 << 20 }; /* bytes of a file that are looked at */

void ang_volume_header_clear(ang_volume_header *header) {
    for (size_t i = 0; i < header->file_count; i++) free(header->file[i]);
    free(header->file);
    ang_notes_clear(&header->assumptions);
    ang_notes_clear(&header->warnings);
    *header = (ang_volume_header){0};
}

bool ang_volume_header_add_file(ang_volume_header *header, const char *name, ang_error *err) {
    bool full = (header->file_count & (header->file_count - 1)) == 0; /* grown at 0 and each power of two */
    char **grown =
        full ? realloc(header->file, (header->file_count ? 2 * header->file_count : 1) * sizeof *grown) : header->file;
    if (grown) header->file = grown;
    char *copy = grown ? strdup(name) : NULL;
    if (!copy) return ang_fail(err, ANG_LIMIT, "no memory for the list of files");
    header->file[header->file_count++] = copy;
    return true;
}

/* The digits that a pattern's one %d asks for; `*end` is behind it. -1 where that is no such conversion. */
static int conversion(const char *percent, bool *zeros, const char **end) {
    const char *at = percent + 1;
    int width = 0;
    *zeros = *at == '0';
    for (; isdigit((unsigned char)*at); at++) width = width < 100 ? 10 * width + (*at - '0') : width;
    *end = at + 1;
    return (*at == 'd' || *at == 'i' || *at == 'u') && width < 20 ? width : -1;
}

bool ang_volume_header_add_numbered(ang_volume_header *header, const char *label, const char *pattern, double first,
                                    double last, double step, ang_error *err) {
    const char *percent = strchr(pattern, '%'), *rest = NULL;
    bool zeros = false;
    int width = percent ? conversion(percent, &zeros, &rest) : -1;
    if (width < 0 || strchr(rest, '%'))
        return ang_fail(err, ANG_INPUT, "%s: names its voxels' files by \"%.200s\", which is no pattern with one %%d",
                        label, pattern);
    double count = step != 0 ? floor((last - first) / step) + 1 : 0;
    if (!(count >= 1 && count <= ANG_HEADER_FILES && fabs(first) < 1e9 && fabs(last) < 1e9 && fabs(step) < 1e9))
        return ang_fail(err, ANG_INPUT, "%s: its voxels' files are numbered %g to %g by %g, which makes no list", label,
                        first, last, step);
    for (int i = 0; i < (int)count; i++) {
        char name[4096];
        long number = (long)(first + i * step);
        snprintf(name, sizeof name, zeros ? "%.*s%0*ld%s" : "%.*s%*ld%s", (int)(percent - pattern), pattern, width,
                 number, rest);
        if (!ang_volume_header_add_file(header, name, err)) return false;
    }
    return true;
}

bool ang_volume_header_read(const char *path, ang_header_parser *parse, ang_volume_header *header, ang_error *err) {
    const char *label = ang_base_name(path);
    struct stat status;
    FILE *file = fopen(path, "rb");
    if (!file) return ang_fail(err, ANG_INPUT, "%s: %s", label, strerror(errno));
    size_t room = fstat(fileno(file), &status) == 0 && status.st_size < most_header ? (size_t)status.st_size
                                                                                    : (size_t)most_header;
    uint8_t *bytes = ang_alloc(room, 1, label, err);
    size_t size = bytes ? fread(bytes, 1, room, file) : 0;
    fclose(file);
    bool ok = bytes && parse(label, bytes, size, header, err);
    free(bytes);
    return ok;
}

/* Relative names are beside the header. To be freed. */
static char *path_beside(const char *path, const char *name) {
    char *joined = NULL;
    if (name[0] == '/') return strdup(name);
    return asprintf(&joined, "%.*s%s", (int)(ang_base_name(path) - path), path, name) < 0 ? NULL : joined;
}

/* Where the line after `lines` more begins. */
static bool pass_lines(const char *path, uint64_t lines, uint64_t *offset, ang_error *err) {
    struct stat status;
    errno = 0;
    /* A pipe would wait for a writer, a device need not end. */
    FILE *file = stat(path, &status) == 0 && S_ISREG(status.st_mode) ? fopen(path, "rb") : NULL;
    if (!file || fseeko(file, (off_t)*offset, SEEK_SET) != 0) {
        if (file) fclose(file);
        return ang_fail(err, ANG_INPUT, "%s: %s", ang_base_name(path), errno ? strerror(errno) : "is no regular file");
    }
    for (int c = 0; lines > 0 && c != EOF; lines -= c == '\n') {
        c = getc_unlocked(file);
        *offset += c != EOF;
    }
    fclose(file);
    return lines == 0 || ang_fail(err, ANG_INPUT, "%s: ends before its voxels begin", ang_base_name(path));
}

/* The bytes of the voxels in each file; 0 where the product overflows. */
static uint64_t bytes_in_file(const ang_volume_header *header) {
    size_t voxels = ang_product3((size_t)header->dims[0], (size_t)header->dims[1], (size_t)header->dims[2]);
    size_t files = header->file_count ? header->file_count : 1;
    return ang_product3(voxels, (size_t)header->phases, ang_sample_size(header->type)) / files;
}

static bool find_part(const ang_volume_header *header, const char *path, size_t index, ang_byte_part *part,
                      char **owned, ang_error *err) {
    struct stat status;
    part->path = *owned = header->file_count ? path_beside(path, header->file[index]) : strdup(path);
    part->offset = header->file_count ? 0 : header->offset;
    if (!part->path) return ang_fail(err, ANG_LIMIT, "no memory for the list of files");
    if (header->line_skip > 0 && !pass_lines(part->path, header->line_skip, &part->offset, err)) return false;
    if (header->byte_skip > 0 && header->skip_packed) part->offset += (uint64_t)header->byte_skip;
    if (header->byte_skip < 0 && stat(part->path, &status) == 0) {
        uint64_t needed = bytes_in_file(header), size = (uint64_t)status.st_size;
        part->offset = needed > 0 && needed < size ? size - needed : 0;
    }
    return true;
}

/* The parts of the voxels; their paths are `owned`. */
static bool find_parts(const ang_volume_header *header, const char *path, size_t count, ang_byte_part *parts,
                       char **owned, ang_error *err) {
    for (size_t i = 0; i < count; i++)
        if (!find_part(header, path, i, &parts[i], &owned[i], err)) return false;
    return true;
}

bool ang_volume_header_list(const ang_volume_header *header, const char *path, ang_load_report *report,
                            ang_error *err) {
    /* The report lists volumes, and needs no voxels for it. */
    ang_volume without = {.affine = header->affine};
    memcpy(without.dims, header->dims, sizeof without.dims);
    return ang_samples_list(&without, header->phases, "?", ang_base_name(path), report, err) &&
           ang_samples_name_phases(report->series, header->phase_first, header->phase_step, header->phase_unit, err);
}

static ang_volume *load_voxels(const ang_volume_header *header, const char *path, const ang_load_options *options,
                               ang_load_report *report, const ang_progress *progress, ang_error *err) {
    const char *label = ang_base_name(path);
    snprintf(report->format, sizeof report->format, "%s", header->format);
    ang_notes_append(&report->assumptions, &header->assumptions);
    ang_notes_append(&report->warnings, &header->warnings);
    ang_sample_source source = {.label = label,
                                .field = header->field,
                                .type = header->type,
                                .big_endian = header->big_endian,
                                .phases = header->phases,
                                .phase_run = header->phase_run,
                                .slope = header->slope,
                                .intercept = header->intercept,
                                .slices = options->slices};
    memcpy(source.dims, header->dims, sizeof source.dims);
    if (!ang_load_phase(label, header->phases, options, &source.phase, err)) return NULL;
    size_t count = header->file_count ? header->file_count : 1;
    ang_byte_part *parts = ang_alloc(count, sizeof *parts, "list of files", err);
    char **owned = parts ? ang_alloc(count, sizeof *owned, "list of files", err) : NULL;
    source.parts = (ang_byte_parts){.part = parts, .count = count, .coding = header->coding};
    if (header->byte_skip > 0 && !header->skip_packed) source.parts.skip = (uint64_t)header->byte_skip;
    ang_volume *volume = NULL;
    if (owned && find_parts(header, path, count, parts, owned, err))
        volume = ang_samples_read(&source, options->threads, report, progress, err);
    for (size_t i = 0; owned && i < count; i++) free(owned[i]);
    free(owned);
    free(parts);
    if (!volume) return NULL;
    volume->affine = header->affine;
    if (ang_volume_header_list(header, path, report, err)) return volume;
    ang_volume_free(volume);
    return NULL;
}

static ang_volume *load(const char *path, ang_header_parser *parse, const char *format, const ang_load_options *options,
                        ang_load_report *report, const ang_progress *progress, ang_error *err) {
    ang_volume_header header = {0};
    snprintf(report->format, sizeof report->format, "%s", format);
    ang_volume *volume = NULL;
    if (ang_volume_header_read(path, parse, &header, err))
        volume = load_voxels(&header, path, options, report, progress, err);
    ang_volume_header_clear(&header);
    return volume;
}

ang_volume *ang_nrrd_load(const char *path, const ang_load_options *options, ang_load_report *report,
                          const ang_progress *progress, ang_error *err) {
    return load(path, ang_nrrd_parse, "NRRD", options, report, progress, err);
}

ang_volume *ang_metaimage_load(const char *path, const ang_load_options *options, ang_load_report *report,
                               const ang_progress *progress, ang_error *err) {
    return load(path, ang_metaimage_parse, "MetaImage", options, report, progress, err);
}

bool ang_header_names(const char *path, bool nrrd, const char *file) {
    ang_volume_header header = {0};
    bool named = false;
    ang_error ignored;
    if (ang_volume_header_read(path, nrrd ? ang_nrrd_parse : ang_metaimage_parse, &header, &ignored))
        for (size_t i = 0; i < header.file_count && !named; i++) {
            char *voxels = path_beside(path, header.file[i]);
            named = voxels && ang_file_same(voxels, file);
            free(voxels);
        }
    ang_volume_header_clear(&header);
    return named;
}
