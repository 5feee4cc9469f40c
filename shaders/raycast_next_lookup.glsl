// The first lookup from i on that lies in a block where something shows, or at or beyond `end`. Only lookups count:
// blocks that a ray touches between two of them give the picture nothing. Block by block by where the ray leaves each: a
// lookup within a thousandth of a step of a face is tested in both blocks.
int next_shown(Path path, int i, int end) {
    vec3 along = path.direction * block_scale * lattice_step;
    vec3 rate = 1.0 / mix(along, vec3(1e-9), lessThan(abs(along), vec3(1e-9)));
    vec3 ahead = vec3(greaterThan(rate, vec3(0.0)));
    while (i < end) {
        vec3 at = (path.start + lookup_at(i, path) * path.direction) * block_scale + block_offset;
        vec3 block = clamp(floor(at), vec3(0.0), block_last);
        if (shows(block)) break;
        // Lookups lie at most a step apart, so that none is passed over.
        vec3 exits = (block + ahead - at) * rate;
        i += max(1, int(ceil(min(min(exits.x, exits.y), exits.z) - 1e-3)));
    }
    return i;
}
