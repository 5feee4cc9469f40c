// Skipping by the least and greatest value of every block and a table that says which of these show something.
uniform sampler3D block_ranges; // least and greatest stored value, 16 bits normalised
uniform sampler2D block_shows;  // by the quantised two: 1 where something shows
uniform vec3 block_scale;       // blocks in one index unit
uniform vec3 block_offset;      // block coordinate of the box's centre
uniform vec3 block_last;        // the last block
uniform vec2 block_quantise;    // the least value of the table; its entries in one stored value

bool shows(vec3 block) {
    vec2 range = 65535.0 * texelFetch(block_ranges, ivec3(block), 0).rg;
    // Outwards, with room for rounding: the table's entries cover as much (block_ranges.c).
    vec2 entry = (range - block_quantise.x) * block_quantise.y;
    ivec2 at = clamp(ivec2(floor(entry.x - 1e-3), ceil(entry.y + 1e-3)), ivec2(0), ivec2(255));
    return texelFetch(block_shows, at, 0).r > 0.5;
}

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
