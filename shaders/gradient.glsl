// Central differences one voxel to each side along the index axes; the texture's clamping is the clamping at the box.
uniform mat3 gradient_to_mm; // halved stored differences to HU/mm

// Where `wanted` is false nobody looks at the result.
vec3 gradient_at(vec3 place, bool wanted) {
    vec3 difference = vec3(0.0);
    vec3 voxel = vec3(1.0, 0.0, 0.0);
    int axis = 0;
    // Software GL runs both sides of every branch but leaves a loop when none of its pixels goes on: where none wants a
    // gradient one axis is looked up instead of three.
    do {
        difference += (field_at(place + voxel) - field_at(place - voxel)) * voxel;
        voxel = voxel.zxy;
        axis++;
    } while (wanted && axis < 3);
    return gradient_to_mm * difference;
}
