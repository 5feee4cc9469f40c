// Central differences one voxel to each side along the index axes; the texture's clamping is the clamping at the box.
uniform mat3 gradient_to_mm; // halved stored differences to HU/mm

vec3 gradient_at(vec3 coordinate) {
    vec3 voxel = 1.0 / field_dims;
    vec3 difference = vec3(
        field_at(coordinate + vec3(voxel.x, 0.0, 0.0)) - field_at(coordinate - vec3(voxel.x, 0.0, 0.0)),
        field_at(coordinate + vec3(0.0, voxel.y, 0.0)) - field_at(coordinate - vec3(0.0, voxel.y, 0.0)),
        field_at(coordinate + vec3(0.0, 0.0, voxel.z)) - field_at(coordinate - vec3(0.0, 0.0, voxel.z)));
    return gradient_to_mm * difference;
}
