// A ray as the first pass leaves it to the others.
struct Path {
    vec3 start;     // index: where the ray enters the clip box
    vec3 direction; // index per mm
    float reach;    // mm in the clip box
    int count;      // samples
};
