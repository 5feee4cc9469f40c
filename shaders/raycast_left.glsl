uniform int pass_next; // the next pass

// The paper writes opacity 1 where a ray has left the volume, which would be seen; its length says the same.
bool has_left() {
    return lookup_count(path_here().count) <= pass_next * pass_steps;
}
