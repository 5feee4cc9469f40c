// What the passes read again by raycast_fetch_parallel.glsl.
layout(location = 0) out vec4 entry;

void keep(Path path) {
    entry = vec4(path.start, path.reach);
}
