#include "ui/state/tool.h"

const char *ang_tool_name(ang_tool tool) {
    static const char *const names[ANG_TOOLS] = {"window", "crosshair", "scroll", "pan", "crop", "measure"};
    return names[tool];
}
