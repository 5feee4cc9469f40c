// The share of the interpolated value that is not padding.
uniform sampler3D weight_values;

float weight_at(vec3 place) {
    return trilinear(weight_values, place);
}
