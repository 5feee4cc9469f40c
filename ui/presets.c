#include "ui/presets.h"

#include "ui/viewer_private.h"

#include <string.h>

int ang_presets(const ang_viewer *viewer, const ang_preset *presets[ANG_PRESETS]) {
    int count = 0;
    if (viewer->own_preset) presets[count++] = viewer->own_preset;
    for (int i = 0; viewer->host->presets[i] && count < ANG_PRESETS; i++) presets[count++] = viewer->host->presets[i];
    return count;
}

int ang_preset_chosen(const ang_viewer *viewer, const ang_preset *const *presets, int count) {
    for (int i = 0; i < count; i++)
        if (strcmp(presets[i]->name, viewer->document.preset) == 0) return i;
    return -1;
}

const ang_preset *ang_preset_named(const ang_viewer *viewer, const char *name) {
    for (int i = 0; viewer->host->presets[i]; i++)
        if (strcmp(viewer->host->presets[i]->name, name) == 0) return viewer->host->presets[i];
    return NULL;
}

void ang_viewer_choose_preset(ang_viewer *viewer, const ang_preset *preset) {
    ang_document_take_preset(&viewer->document, preset);
    viewer->chosen = viewer->document;
    viewer->point = -1;
}

void ang_viewer_step_preset(ang_viewer *viewer, int by) {
    const ang_preset *presets[ANG_PRESETS];
    int count = ang_presets(viewer, presets), now = ang_preset_chosen(viewer, presets, count);
    if (count > 0) ang_viewer_choose_preset(viewer, presets[now < 0 ? 0 : (now + by + count) % count]);
}

const ang_document *ang_viewer_shown_document(ang_viewer *viewer) {
    if (!viewer->comparing) return &viewer->document;
    viewer->compared = viewer->document;
    ang_document_take_look(&viewer->compared, &viewer->chosen);
    return &viewer->compared;
}
