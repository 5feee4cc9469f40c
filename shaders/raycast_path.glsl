// A ray as the first pass leaves it to the others.
struct Path {
    vec3 start;     // index: where the ray enters the clip box
    vec3 direction; // index per mm
    float reach;    // mm in the clip box
    int count;      // samples
};

// Where step i begins.
vec3 node_place(Path path, int i) {
    return path.start + lattice_node(i, path.count, path.reach) * path.direction;
}
