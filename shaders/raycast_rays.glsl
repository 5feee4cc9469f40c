// The first two passes of Krueger & Westermann in one: where rays enter and where they lead. Rays that miss the box keep
// the depth of finished pixels.
layout(location = 0) out vec4 entry;
layout(location = 1) out vec4 direction;

void main() {
    Ray ray = ray_through(gl_FragCoord.xy);
    if (!(ray.enter < ray.leave)) discard;
    Path path;
    path.reach = ray.leave - ray.enter;
    path.count = lattice_count(path.reach);
    path.start = ray.origin + ray.enter * ray.direction;
    path.direction = ray.direction;
    entry = vec4(path.start, float(path.count));
    direction = vec4(path.direction, path.reach);
    set_wake(path, 0);
}
