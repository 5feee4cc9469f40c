// A step stands for all values from its one end to the other.
const bool step_whole = true;
