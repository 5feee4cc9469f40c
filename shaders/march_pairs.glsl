// The sample after a visible one is taken without asking for its block again: what is invisible changes nothing, and to
// ask costs software GL as much as to look. A loop of a known length is unrolled.
const int march_group = 2;
