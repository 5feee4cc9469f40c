// Jumps over what shows nothing: a grid of blocks holds how many blocks away, in any direction, the nearest visible one
// is; 0 where the block itself is visible.
uniform usampler3D skip_grid;
uniform vec3 skip_scale;  // blocks in one index unit
uniform vec3 skip_offset; // block coordinate of the box's centre
uniform vec3 skip_last;   // the last block

// Steps of the lattice in one block along each axis, signed. A direction this small leads to no other block.
vec3 skip_rate(vec3 direction) {
    vec3 along = direction * skip_scale * lattice_step;
    return 1.0 / mix(along, vec3(1e-9), lessThan(abs(along), vec3(1e-9)));
}

// Steps from the sample at `place` to the first that may show something; 0 where this one may. A sample that lies a
// thousandth of a step before another block is asked again. Where steps count as a whole, `place` is where one begins,
// and those are passed over that also end among invisible blocks.
int skip_steps(vec3 place, vec3 rate) {
    vec3 at = place * skip_scale + skip_offset;
    vec3 block = floor(at);
    float clear = float(texelFetch(skip_grid, ivec3(clamp(block, vec3(0.0), skip_last)), 0).r);
    // To the faces of the cube of invisible blocks: the far one along each axis.
    vec3 exits = (block - at + vec3(lessThan(rate, vec3(0.0)))) * rate + clear * abs(rate);
    float exit = min(min(exits.x, exits.y), exits.z) - 1e-3;
    return clear > 0.0 ? (step_whole ? max(0, int(floor(exit))) : max(1, int(ceil(exit)))) : 0;
}
