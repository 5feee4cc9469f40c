// What is looked up along a ray: its samples.
int lookup_count(int count) {
    return count;
}
// mm from the entry
float lookup_at(int i, Path path) {
    return lattice_place(i, lattice_length(i, path.count, path.reach));
}
