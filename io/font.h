/* Where letters come from. */
#ifndef ANG_IO_FONT_H
#define ANG_IO_FONT_H

/* The path of DejaVuSans.ttf (fonts-dejavu-core), NULL where it is not installed. Static. Thread safe. */
const char *ang_font_find(void);

#endif
