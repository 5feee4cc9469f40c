// Polygons that the CPU has cut (--proxy other than vertex-program).
layout(location = 0) in vec3 polygon_place;
layout(location = 1) in int polygon_group;
layout(location = 2) in vec3 polygon_owner_lower;
layout(location = 3) in vec3 polygon_owner_upper;

flat out int slice_which;
flat out vec3 slice_owner_lower;
flat out vec3 slice_owner_upper;

void main() {
    slice_which = polygon_group;
    slice_owner_lower = polygon_owner_lower;
    slice_owner_upper = polygon_owner_upper;
    gl_Position = slice_project(polygon_place, slice_which);
}
