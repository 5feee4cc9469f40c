// Two triangles for every packed face (hull_faces.glsl), cut to the clip box and widened by a fraction of a pixel so that
// the rasteriser's rounding never loses one at an edge: where faces overlap the least and the greatest parameter count,
// which are those of the planes and not of the triangles.
uniform usamplerBuffer hull_list;
uniform vec3 hull_origin;    // index, about the box's centre: the lower corner of cell 0
uniform vec3 hull_side;      // index units in a cell
uniform vec3 hull_pad_index; // index units in one mm across the faces of the box
uniform vec2 hull_pad;       // mm: of a face at w 0, and more for each w
uniform vec3 box_lower;       // clip box, index
uniform vec3 box_upper;
uniform vec4 clip_x;
uniform vec4 clip_y;
uniform vec4 clip_w;

flat out int hull_axis;
flat out float hull_plane;
flat out float hull_outward; // 1 or -1: the normal along the axis

const int corner_of[6] = int[6](0, 1, 2, 2, 1, 3);

void main() {
    uint face = texelFetch(hull_list, gl_VertexID / 6).r;
    int corner = corner_of[gl_VertexID % 6];
    int axis = int(face >> 30);
    float upper = float(face >> 9 & 1u);
    vec3 cell = vec3(face & 511u, face >> 10 & 511u, face >> 20 & 511u);
    vec3 to = vec3(corner & 1, corner & 1, corner & 1);
    to[(axis + 2) % 3] = float(corner >> 1);
    to[axis] = upper;
    vec3 place = clamp(hull_origin + (cell + to) * hull_side, box_lower, box_upper);
    hull_axis = axis;
    hull_plane = place[axis];
    hull_outward = 2.0 * upper - 1.0;
    float w = dot(clip_w.xyz, place) + clip_w.w;
    place += (2.0 * to - 1.0) * (hull_pad.x + hull_pad.y * max(w, 0.0)) * hull_pad_index;
    w = dot(clip_w.xyz, place) + clip_w.w;
    gl_Position = vec4(dot(clip_x.xyz, place) + clip_x.w, dot(clip_y.xyz, place) + clip_y.w, 0.0, w);
}
