// Planes in a group. Software GL unrolls a loop of a known length, and runs that in half the time.
const int slice_group = 4;
