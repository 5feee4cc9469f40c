// The planes of slicing: ang_slice_planes of core/plan/planes.h in float. A polygon stands for a group of planes, which its
// fragments composite before they blend.
uniform float slice_first;    // mm along the axis from the plane of p
uniform float slice_distance; // mm
uniform int slice_count;

float slice_depth(int plane) {
    precise float depth = slice_first + float(plane) * slice_distance;
    return depth;
}
