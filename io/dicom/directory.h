/* A DICOMDIR: the index of a disc, which names the files on it (PS3.3 annex F). */
#ifndef ANG_DICOM_DIRECTORY_H
#define ANG_DICOM_DIRECTORY_H

#include <stdbool.h>
#include <stddef.h>

/* Owns its paths; free with ang_dicom_directory_clear. */
typedef struct ang_dicom_directory {
    char **paths; /* of the files that it names and that are there */
    size_t count;
    size_t missing; /* files that it names and that are not there */
    bool damaged;   /* it cannot be read to its end, or names nothing */
} ang_dicom_directory;

/* Whether the file is a DICOMDIR, by its name or by what it says it is. */
bool ang_dicom_is_directory(const char *path);

/* Finds the files that the DICOMDIR at `path` names, below its folder and nowhere else, in whatever case their names
 * are on disk. One that cannot be read is `damaged`, with what was found before. Thread safe. */
ang_dicom_directory ang_dicom_read_directory(const char *path);
void ang_dicom_directory_clear(ang_dicom_directory *directory);

/* The folder of a file; to be freed. NULL where memory is out. */
char *ang_dicom_folder_of(const char *path);

#endif
