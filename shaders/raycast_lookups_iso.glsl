// What is looked up along a ray: its entry, its samples, its exit.
int lookup_count(int count) {
    return count > 0 ? count + 2 : 0;
}
// mm from the entry
float lookup_at(int i, Path path) {
    int sample_index = i - 1;
    if (sample_index < 0) return 0.0;
    if (sample_index >= path.count) return path.reach;
    return lattice_place(sample_index, lattice_length(sample_index, path.count, path.reach));
}
