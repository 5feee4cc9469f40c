// The volume's texture, 16 bits normalised. Places are in voxel index space about the box's centre.
uniform sampler3D field_values;
uniform vec3 field_scale;  // texture coordinate = scale * place + offset
uniform vec3 field_offset;

// Stored values that were whole stay whole: k / 65535 * 65535 is off by up to two units in the last place, and a step
// of the transfer function may lie on k.
float field_stored(float normalised) {
    float stored = normalised * 65535.0;
    float whole = roundEven(stored);
    return abs(stored - whole) <= 5e-7 * stored ? whole : stored;
}
