// The twelve edges of a box, as lines (--show-bricks).
layout(location = 0) in vec3 box_lower; // index space about the box's centre
layout(location = 1) in vec3 box_upper;

uniform vec4 clip_x;
uniform vec4 clip_y;
uniform vec4 clip_w;

// Corners of the edges: bit 0 x upper, bit 1 y upper, bit 2 z upper.
const int edge_corners[24] = int[24](0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7);

void main() {
    int corner = edge_corners[gl_VertexID];
    vec3 place = mix(box_lower, box_upper, bvec3(corner & 1, corner & 2, corner & 4));
    float w = dot(clip_w.xyz, place) + clip_w.w;
    gl_Position = vec4(dot(clip_x.xyz, place) + clip_x.w, dot(clip_y.xyz, place) + clip_y.w, 0.0, w);
}
