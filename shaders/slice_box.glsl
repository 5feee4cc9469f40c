// Box-plane intersection in the vertex program: Rezk-Salama & Kolb 2005, sections 4 and 5, listing 1, in the robust form
// of numerics.md. Vertices come from one static buffer; boxes are instances.
layout(location = 0) in ivec2 slice_vertex; // which of the polygon's six points, which of the box's groups of planes
layout(location = 1) in vec3 box_lower;     // index space about the box's centre
layout(location = 2) in vec3 box_upper;
layout(location = 3) in vec3 box_owner_lower;
layout(location = 4) in vec3 box_owner_upper;
layout(location = 5) in ivec2 box_groups; // the first, how many

uniform int vertex_sequence[64]; // nSequence: vertices in the paper's order for each front vertex
uniform int edge_from[24];       // v1 and v2: four edges to try for each of the six points
uniform int edge_to[24];
uniform int slice_front;      // front vertex: bit 0 x upper, bit 1 y upper, bit 2 z upper
uniform vec4 slice_gradient;  // depth of a place: gradient and constant
uniform vec3 slice_pad_index; // index units in one mm across the faces of the box
uniform vec2 slice_pad;       // mm by which boxes are widened: at depth 0, and more for each mm of depth
uniform vec3 slice_widen;     // index units by which boxes are widened for the other planes of a group
uniform bool slice_reverse;   // from the last group to the first

flat out int slice_which; // group
flat out vec3 slice_owner_lower;
flat out vec3 slice_owner_upper;

vec3 corner_place(int vertex, vec3 lower, vec3 upper) {
    return mix(lower, upper, bvec3(vertex & 1, vertex & 2, vertex & 4));
}

// Depths grow by parts that are never negative, added in one order: along every path from the front vertex they rise,
// whatever the rounding.
float corner_depth(int vertex, float front, vec3 rise) {
    int turned = vertex ^ slice_front;
    float depth = front;
    if ((turned & 1) != 0) depth += rise.x;
    if ((turned & 2) != 0) depth += rise.y;
    if ((turned & 4) != 0) depth += rise.z;
    return depth;
}

void main() {
    bool spare = slice_vertex.y >= box_groups.y;
    slice_which = box_groups.x + (slice_reverse ? box_groups.y - 1 - slice_vertex.y : slice_vertex.y);
    slice_owner_lower = box_owner_lower;
    slice_owner_upper = box_owner_upper;
    // The polygon lies in the middle of its group.
    float depth = slice_depth(slice_which * slice_group) + 0.5 * float(slice_group - 1) * slice_distance;
    // The fragments decide what belongs to the box: its polygon only has to cover them.
    vec3 pad = (slice_pad.x + slice_pad.y * depth) * slice_pad_index + slice_widen;
    vec3 lower = box_lower - pad;
    vec3 upper = box_upper + pad;
    vec3 rise = abs(slice_gradient.xyz) * (upper - lower);
    float front = dot(slice_gradient.xyz, corner_place(slice_front, lower, upper)) + slice_gradient.w;

    vec3 place = vec3(0.0);
    for (int i = 0; i < 4; i++) {
        int edge = 4 * slice_vertex.x + i;
        int a = vertex_sequence[8 * slice_front + edge_from[edge]];
        int b = vertex_sequence[8 * slice_front + edge_to[edge]];
        float depth_a = corner_depth(a, front, rise);
        float depth_b = corner_depth(b, front, rise);
        // Points 1, 3 and 5 first try the edge between two paths, which the plane may miss on either side.
        bool between = i == 0 && (slice_vertex.x & 1) == 1;
        if (depth < depth_b && (!between || depth >= depth_a) || i == 3) {
            float share = depth_b > depth_a ? clamp((depth - depth_a) / (depth_b - depth_a), 0.0, 1.0) : 0.0;
            place = mix(corner_place(a, lower, upper), corner_place(b, lower, upper), share);
            break;
        }
    }
    gl_Position = spare ? vec4(2.0, 2.0, 2.0, 1.0) : slice_project(place, slice_which);
}
