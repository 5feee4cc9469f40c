// The near plane may cut the volume: a ray may start inside the envelope.
const bool envelope_inside = true;
