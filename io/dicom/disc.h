/* The files of a disc under the names that its index has for them. */
#ifndef ANG_DICOM_DISC_H
#define ANG_DICOM_DISC_H

/* Each folder is read once, when a name first leads into it, so that an index of many names costs no more than the disc
 * is large. Not thread safe. */
typedef struct ang_dicom_disc ang_dicom_disc;

/* The disc below `folder`; free with ang_dicom_disc_close. NULL where memory is out. */
ang_dicom_disc *ang_dicom_disc_open(const char *folder);
/* Path, to be freed, of the file of a ReferencedFileID, "PART\\PART\\...", whatever the case of its names on disk. NULL
 * where it is not there, leads out of the disc or through a link to a folder, and where memory is out. */
char *ang_dicom_disc_find(ang_dicom_disc *disc, const char *id);
void ang_dicom_disc_close(ang_dicom_disc *disc);

#endif
