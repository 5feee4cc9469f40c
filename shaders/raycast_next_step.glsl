// The first step from i on that touches a block where something shows, or `end`: from block to block by whichever face
// the ray leaves each through, so that none is passed over. A step that comes within a thousandth of one counts; the last may be longer by that.
int next_shown(Path path, int i, int end) {
    vec3 along = path.direction * block_scale * lattice_step;
    vec3 rate = 1.0 / mix(along, vec3(1e-9), lessThan(abs(along), vec3(1e-9)));
    vec3 ahead = vec3(greaterThan(rate, vec3(0.0)));
    vec3 at = node_place(path, i) * block_scale + block_offset;
    vec3 block = clamp(floor(at), vec3(0.0), block_last);
    vec3 exits = (block + ahead - at) * rate; // steps from here to the block's faces
    float walked = 0.0;
    while (float(i) + walked < float(end) + 2e-3 && !shows(block)) {
        walked = min(min(exits.x, exits.y), exits.z);
        vec3 through = vec3(lessThanEqual(exits, vec3(walked)));
        // Of several faces at once the first: the block beyond an edge touches the ray at a point alone.
        through.y *= 1.0 - through.x;
        through.z *= (1.0 - through.x) * (1.0 - through.y);
        block = clamp(block + through * sign(rate), vec3(0.0), block_last);
        exits += through * abs(rate);
        walked = max(walked, 0.0);
    }
    return i + max(0, int(floor(walked - 1e-3)));
}
