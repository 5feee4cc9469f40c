// The slab of a sample that has neighbours on both sides: its box is farther from the faces than a step.
bool slab_at(vec2 pixel, int plane, out Slab slab) {
    vec3 across = slice_across(pixel);
    slab.place = slice_place(plane, across);
    slab.before = slice_place(plane - 1, across);
    slab.beyond = slab.place;
    slab.length = slice_distance * slice_slant(pixel);
    slab.first = false;
    slab.last = false;
    return true;
}
