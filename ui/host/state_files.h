/* Saved states, as sessions: from what is shown, and back to it; files through the host. */
#ifndef ANG_UI_STATE_FILES_H
#define ANG_UI_STATE_FILES_H

#include <stddef.h>

typedef struct ang_viewer ang_viewer;

/* What is to be read where `path` is opened: itself or, where it is a saved state, the state's data, in `room`. NULL
 * where the state says why not, which is then the viewer's failure. */
const char *ang_session_data(ang_viewer *viewer, const char *path, char *room, size_t size);
/* Shows the study that has just been loaded as the state says that it was opened by; nothing where there is none. */
void ang_session_apply(ang_viewer *viewer);
void ang_session_save(ang_viewer *viewer);

#endif
