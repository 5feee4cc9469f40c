/* What a left drag in a slice does. */
#ifndef ANG_UI_TOOL_H
#define ANG_UI_TOOL_H

typedef enum ang_tool {
    ANG_TOOL_WINDOW,
    ANG_TOOL_CROSSHAIR,
    ANG_TOOL_SCROLL,
    ANG_TOOL_PAN,
    ANG_TOOL_CROP,
    ANG_TOOL_MEASURE,
    ANG_TOOLS
} ang_tool;
const char *ang_tool_name(ang_tool tool);

#endif
