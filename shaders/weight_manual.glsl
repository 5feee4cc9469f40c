// The share of the interpolated value that is not padding, interpolated as in field_manual.glsl.
uniform sampler3D weight_values;

float weight_at(vec3 coordinate) {
    vec3 last = field_dims - 1.0;
    vec3 place = clamp(coordinate * field_dims - 0.5, vec3(0.0), last);
    vec3 cell = floor(place);
    vec3 f = place - cell;
    float sum = 0.0;
    for (int corner = 0; corner < 8; corner++) {
        vec3 side = vec3(corner & 1, corner >> 1 & 1, corner >> 2);
        vec3 part = mix(1.0 - f, f, side);
        sum += part.x * part.y * part.z * texelFetch(weight_values, ivec3(min(cell + side, last)), 0).r;
    }
    return sum;
}
