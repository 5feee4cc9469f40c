/* From what is asked for to a study that is shown: one loading at a time; the study before stays until then. */
#ifndef ANG_UI_OPENING_H
#define ANG_UI_OPENING_H

#include "core/render/painter.h"
#include "ui/state/source.h"

typedef struct ang_viewer ang_viewer;

/* The slice that has been read last while loading. */
typedef struct ang_slice_preview {
    ang_paint_texture texture;
    size_t index, count; /* its place from 0, of how many; count 0: none yet */
    int pictures;        /* made since the window opened */
} ang_slice_preview;

void ang_viewer_open(ang_viewer *viewer, const char *path);
/* The same for any source, which is taken. What is being loaded is stopped; what is shown stays until this is there. */
void ang_viewer_open_source(ang_viewer *viewer, ang_source *source);
/* Opens the next phase of the series that is shown, or with `step` -1 the one before; behind the last comes the first.
 */
void ang_viewer_step_phase(ang_viewer *viewer, int step);
/* Shows what has been loaded meanwhile. */
void ang_viewer_take_loaded(ang_viewer *viewer, const char *wanted_preset);
/* Makes the slice that was read last the one that is shown while loading. */
void ang_viewer_take_preview(ang_viewer *viewer);
/* What the series browser is about: what is shown, or what could not be. */
const ang_source *ang_viewer_subject(const ang_viewer *viewer);
/* Greys, rows from the top, as a texture; it stays as it is where that fails or there are none. */
void ang_viewer_paint_grey(ang_viewer *viewer, const uint8_t *grey, int width, int height, ang_paint_texture *texture);
void ang_viewer_opening_clear(ang_viewer *viewer);

#endif
