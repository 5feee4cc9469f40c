// Nothing of the box is cut away.
bool half_space_has(vec3 place) {
    return true;
}

void half_space_cut(vec3 origin, vec3 direction, inout float enter, inout float leave) {
}
