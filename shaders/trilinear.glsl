// Interpolation in float, to verify the texture unit's, which may weight in 8 bits. The weights come from the place in
// the whole volume, so that they are the same bits whichever texture holds the voxels.
uniform vec3 trilinear_centre; // voxel index of the box's centre
uniform vec3 trilinear_last;   // index of the volume's last voxel
uniform vec3 trilinear_first;  // voxel index of the texture's first texel

float trilinear(sampler3D values, vec3 place) {
    vec3 voxel = clamp(place + trilinear_centre, vec3(0.0), trilinear_last);
    vec3 cell = floor(voxel);
    vec3 f = voxel - cell;
    ivec3 a = ivec3(cell - trilinear_first);
    ivec3 b = min(ivec3(min(cell + 1.0, trilinear_last) - trilinear_first), textureSize(values, 0) - 1);
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
