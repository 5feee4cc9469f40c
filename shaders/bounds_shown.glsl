// Rays are followed through the box of what shows, on the lattice of the whole ray, with a sample more at both ends for
// rounding.
uniform vec3 shown_lower; // index, about the box's centre
uniform vec3 shown_upper;

void bounds_of(Ray ray, float reach, int count, out int begin, out int end) {
    float from = 0.0;
    float to = reach;
    for (int axis = 0; axis < 3; axis++) {
        float low = shown_lower[axis] - ray.origin[axis];
        float high = shown_upper[axis] - ray.origin[axis];
        float d = ray.direction[axis];
        // A direction this small leads nowhere within the box, but its quotients would overflow.
        if (abs(d) < 1e-12) {
            if (low > 0.0 || high < 0.0) to = -1.0;
        } else {
            float t0 = low / d - ray.enter;
            float t1 = high / d - ray.enter;
            from = max(from, min(t0, t1));
            to = min(to, max(t0, t1));
        }
    }
    bool any = from <= to;
    begin = any ? clamp(int(floor(from / lattice_step)) - 1, 0, count) : 0;
    end = any ? min(int(floor(to / lattice_step)) + 2, count) : 0;
}
