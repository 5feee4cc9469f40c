// What the passes read again by raycast_fetch.glsl.
layout(location = 0) out vec4 entry;
layout(location = 1) out vec4 direction;

void keep(Path path) {
    entry = vec4(path.start, float(path.count));
    direction = vec4(path.direction, path.reach);
}
