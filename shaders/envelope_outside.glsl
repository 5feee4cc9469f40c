// The near plane lies before the whole volume: every ray comes in through a face.
const bool envelope_inside = false;
