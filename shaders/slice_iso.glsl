// The first point at or above the iso value up to this plane; the depth test keeps the nearest. A ray that starts inside
// meets a cut face, which shows its own value.
uniform float iso_stored; // stored value
uniform vec3 iso_colour;  // the transfer function's at the iso value

const int iso_refinements = 18; // halvings of one step

vec4 slice_value(vec2 pixel, Slab slab) {
    float value = stored_from(field_at(slab.place));
    bool cut = slab.first && stored_from(field_at(slab.before)) >= iso_stored;
    bool leaving = slab.last && !cut && value < iso_stored && stored_from(field_at(slab.beyond)) >= iso_stored;
    if (!(cut || leaving || value >= iso_stored)) discard;
    vec3 before = leaving ? slab.place : slab.before;
    vec3 at = cut ? slab.before : leaving ? slab.beyond : slab.place;
    for (int i = 0; i < iso_refinements && !cut; i++) {
        vec3 middle = 0.5 * (before + at);
        bool reached = stored_from(field_at(middle)) >= iso_stored;
        at = reached ? middle : at;
        before = reached ? before : middle;
    }
    vec3 colour = cut ? transfer_at(stored_from(field_at(at))).rgb : iso_colour;
    return vec4(shade(colour, at, slice_along_mm(pixel), true), 1.0);
}
