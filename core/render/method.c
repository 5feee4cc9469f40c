#include "core/render/method.h"

const ang_render_options ang_render_options_default = {.step_voxels = 0.5, .termination = 0.999};
