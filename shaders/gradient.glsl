// Central differences one voxel to each side along the index axes; the texture's clamping is the clamping at the box.
uniform mat3 gradient_to_mm; // halved stored differences to HU/mm

vec3 gradient_at(vec3 place) {
    const vec2 voxel = vec2(1.0, 0.0);
    vec3 difference = vec3(field_at(place + voxel.xyy) - field_at(place - voxel.xyy),
                           field_at(place + voxel.yxy) - field_at(place - voxel.yxy),
                           field_at(place + voxel.yyx) - field_at(place - voxel.yyx));
    return gradient_to_mm * difference;
}
