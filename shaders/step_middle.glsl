// A step stands for the value at its middle.
const bool step_whole = false;
