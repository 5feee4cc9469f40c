// The first two passes of Krueger & Westermann in one: where rays enter and where they lead. Rays that miss the box keep
// the depth of finished pixels.
void main() {
    Ray ray = ray_through(gl_FragCoord.xy);
    if (!(ray.enter < ray.leave)) discard;
    Path path;
    path.reach = ray.leave - ray.enter;
    path.count = lattice_count(path.reach);
    path.start = ray.origin + ray.enter * ray.direction;
    path.direction = ray.direction;
    keep(path);
    set_wake(path, 0);
}
