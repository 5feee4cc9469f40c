/* Windows of slices by name. */
#ifndef ANG_UI_WINDOW_PRESETS_H
#define ANG_UI_WINDOW_PRESETS_H

typedef struct ang_viewer ang_viewer;

/* The first nine by keys. */
typedef struct ang_window_preset {
    const char *name;
    double width, centre; /* HU; NaN: as the file asks */
} ang_window_preset;

const ang_window_preset *ang_window_presets(int *count);
void ang_window_preset_choose(ang_viewer *viewer, int index);

#endif
