/* The series of an input as the series browser lists them. */
#ifndef ANG_UI_SERIES_LIST_H
#define ANG_UI_SERIES_LIST_H

#include "core/volume/raw_slice.h"

enum { ANG_SERIES_PICTURE = 96 }; /* the most pixels of a thumbnail's side */

typedef struct ang_series_entry {
    int number; /* 1, 2, ... */
    char modality[17];
    char description[96]; /* UTF-8; may identify a patient */
    char date[11];        /* "2024-05-17"; empty: not known */
    int dims[3];          /* columns, rows, slices; 0: not known before it is read */
    int phases;           /* volumes at one place; 0 or 1: it is one */
    double spacing_mm[3];
    bool loadable;
    char remark[400];  /* what it is, or why it cannot be loaded; empty: nothing to say */
    bool looked_at;    /* the rest is known */
    int warnings;      /* that loading it would give */
    int width, height; /* of the thumbnail; 0: there is none */
    uint8_t grey[ANG_SERIES_PICTURE * ANG_SERIES_PICTURE];
} ang_series_entry;

/* Owns its entries; zero-initialise. */
typedef struct ang_series_list {
    ang_series_entry *entry;
    size_t count;
} ang_series_list;

/* Room for `count` entries, all zero. False, and an empty list, where memory is out. */
bool ang_series_list_make(ang_series_list *list, size_t count);
void ang_series_list_clear(ang_series_list *list);
/* Keeps a small picture of the slice. */
void ang_series_entry_picture(ang_series_entry *entry, const ang_raw_slice *slice);
/* "2  CT  Abdomen 1.0", the description only where `described` */
void ang_series_entry_title(const ang_series_entry *entry, bool described, char *text, size_t size);
/* "can be loaded", "2 warnings", or why it cannot. */
void ang_series_entry_verdict(const ang_series_entry *entry, char *text, size_t size);

#endif
