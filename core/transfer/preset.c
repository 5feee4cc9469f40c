#include "core/transfer/preset.h"

#include <stdlib.h>

void ang_preset_free(ang_preset *preset) {
    if (!preset) return;
    free(preset->name);
    free(preset->modality);
    free(preset->description);
    ang_transfer_free(preset->transfer);
    free(preset);
}
