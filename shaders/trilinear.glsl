// Interpolation in float, to verify the texture unit's, which may weight in 8 bits. Volumes of the field's size.
float trilinear(sampler3D values, vec3 coordinate) {
    vec3 last = field_dims - 1.0;
    vec3 place = clamp(coordinate * field_dims - 0.5, vec3(0.0), last);
    vec3 cell = floor(place);
    vec3 f = place - cell;
    ivec3 a = ivec3(cell);
    ivec3 b = ivec3(min(cell + 1.0, last));
    float v000 = texelFetch(values, a, 0).r;
    float v100 = texelFetch(values, ivec3(b.x, a.y, a.z), 0).r;
    float v010 = texelFetch(values, ivec3(a.x, b.y, a.z), 0).r;
    float v110 = texelFetch(values, ivec3(b.x, b.y, a.z), 0).r;
    float v001 = texelFetch(values, ivec3(a.x, a.y, b.z), 0).r;
    float v101 = texelFetch(values, ivec3(b.x, a.y, b.z), 0).r;
    float v011 = texelFetch(values, ivec3(a.x, b.y, b.z), 0).r;
    float v111 = texelFetch(values, b, 0).r;
    float near = mix(mix(v000, v100, f.x), mix(v010, v110, f.x), f.y);
    float far = mix(mix(v001, v101, f.x), mix(v011, v111, f.x), f.y);
    return mix(near, far, f.z);
}
