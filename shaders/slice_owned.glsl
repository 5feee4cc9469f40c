// Each sample belongs to one box: from its lower faces up to, not at, its upper ones (numerics.md). What lies outside
// the clip box belongs to none.
flat in int slice_which; // group of planes
flat in vec3 slice_owner_lower;
flat in vec3 slice_owner_upper;

bool slice_owns(vec3 place) {
    return all(greaterThanEqual(place, slice_owner_lower)) && all(lessThan(place, slice_owner_upper));
}
