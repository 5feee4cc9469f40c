// What marching along a ray has in common, whatever is made of the samples.
struct March {
    vec3 start;     // index: where the ray enters the clip box
    vec3 direction; // index per mm
    vec3 rate;      // skip_rate
    float reach;    // mm in the clip box
    int count;      // samples of the whole ray
    int begin;      // those to be looked at: from here
    int end;        // up to, not with, this one
};

March march_along(Ray ray) {
    March m;
    m.reach = ray.leave - ray.enter;
    m.count = lattice_count(m.reach);
    m.start = ray.origin + ray.enter * ray.direction;
    m.direction = ray.direction;
    m.rate = skip_rate(ray.direction);
    bounds_of(ray, m.reach, m.count, m.begin, m.end);
    return m;
}

// Where step i begins.
vec3 march_node(March m, int i) {
    return m.start + lattice_node(i, m.count, m.reach) * m.direction;
}

// Where sample i lies, and the mm that it stands for.
vec3 march_place(March m, int i, out float piece) {
    piece = lattice_length(i, m.count, m.reach);
    return m.start + lattice_place(i, piece) * m.direction;
}
