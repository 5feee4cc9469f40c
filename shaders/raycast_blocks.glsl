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
