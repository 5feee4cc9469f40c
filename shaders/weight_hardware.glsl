// The share of the interpolated value that is not padding.
uniform sampler3D weight_values;

float weight_at(vec3 place) {
    return textureLod(weight_values, place * field_scale + field_offset, 0.0).r;
}
