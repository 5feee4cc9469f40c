#include "io/dicom/directory.h"

#include "io/dicom/disc.h"
#include "io/dicom/parse.h"
#include "io/dicom/slice.h"
#include "io/formats.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { most_files = 1000000 };

bool ang_dicom_is_directory(const char *path) {
    if (strcasecmp(ang_base_name(path), "DICOMDIR") == 0) return true;
    ang_dicom_reader *reader = malloc(sizeof *reader);
    if (!reader) return false;
    bool found = ang_dicom_open_meta(reader, path, "", NULL) == ANG_DICOM_FOUND &&
                 strcmp(reader->media_class, "1.2.840.10008.1.3.10") == 0;
    ang_dicom_close(reader);
    free(reader);
    return found;
}

char *ang_dicom_folder_of(const char *path) {
    const char *slash = strrchr(path, '/');
    if (!slash) return strdup(".");
    return slash == path ? strdup("/") : strndup(path, (size_t)(slash - path));
}

static void take_file(ang_dicom_directory *directory, ang_dicom_disc *disc, const char *id) {
    char *path = ang_dicom_disc_find(disc, id);
    if (!path) {
        directory->missing++;
        return;
    }
    if ((directory->count & (directory->count + 1)) == 0) { /* room for 1, 3, 7, ... */
        char **grown = realloc(directory->paths, (2 * directory->count + 1) * sizeof *grown);
        if (!grown) {
            free(path);
            directory->damaged = true;
            return;
        }
        directory->paths = grown;
    }
    directory->paths[directory->count++] = path;
}

/* The record's file, where it has one and is in use. Records are read in the order in which they stand: the offsets
 * that link them as a tree say nothing of where files are. */
static void take_record(ang_dicom_reader *reader, ang_dicom_range *record, ang_dicom_disc *disc,
                        ang_dicom_directory *directory) {
    char id[512] = "";
    uint16_t in_use = 0xFFFF;
    for (ang_dicom_element element; ang_dicom_next_in(reader, record, &element);) {
        if (element.tag == ANG_DICOM_TAG(0x0004, 0x1410)) ang_dicom_word(reader, &element, &in_use);
        if (element.tag == ANG_DICOM_TAG(0x0004, 0x1500)) ang_dicom_text(reader, &element, id, sizeof id);
    }
    if (in_use != 0 && id[0]) take_file(directory, disc, id);
}

static void take_records(ang_dicom_reader *reader, const ang_dicom_element *sequence, ang_dicom_disc *disc,
                         ang_dicom_directory *directory) {
    ang_dicom_range records = ang_dicom_sequence(reader, sequence), record;
    while (!directory->damaged && directory->count + directory->missing < most_files &&
           ang_dicom_next_item(reader, &records, &record))
        take_record(reader, &record, disc, directory);
    if (sequence->length != ANG_DICOM_UNDEFINED && records.next != records.end) directory->damaged = true;
}

ang_dicom_directory ang_dicom_read_directory(const char *path) {
    ang_dicom_directory directory = {0};
    ang_dicom_reader *reader = malloc(sizeof *reader);
    char *folder = ang_dicom_folder_of(path);
    ang_dicom_disc *disc = folder ? ang_dicom_disc_open(folder) : NULL;
    if (reader && ang_dicom_open(reader, path, "", NULL) == ANG_DICOM_FOUND && disc) {
        for (ang_dicom_element element; ang_dicom_next(reader, &element);)
            if (element.tag == ANG_DICOM_TAG(0x0004, 0x1220)) take_records(reader, &element, disc, &directory);
        directory.damaged = directory.damaged || reader->truncated;
    }
    if (reader) ang_dicom_close(reader);
    free(reader);
    ang_dicom_disc_close(disc);
    free(folder);
    if (directory.count + directory.missing == 0) directory.damaged = true;
    return directory;
}

void ang_dicom_directory_clear(ang_dicom_directory *directory) {
    for (size_t i = 0; i < directory->count; i++) free(directory->paths[i]);
    free(directory->paths);
    *directory = (ang_dicom_directory){0};
}
