// The faces of the clip box, a little widened, without vertex data: those that face the eye are culled, so that every
// ray through the box is drawn once, from inside it too. Which rays meet the box is not decided here.
uniform vec3 cover_lower; // index, about the box's centre
uniform vec3 cover_upper;
uniform vec4 clip_x;
uniform vec4 clip_y;
uniform vec4 clip_w;

const int cover_corner[6] = int[6](0, 1, 2, 2, 1, 3);

void main() {
    int face = gl_VertexID / 6;
    int corner = cover_corner[gl_VertexID % 6];
    int axis = face >> 1;
    bool upper = (face & 1) == 1;
    // Seen from outside the corners of an upper face turn the same way as those of a lower face with its axes exchanged.
    int a = upper ? corner & 1 : corner >> 1;
    int b = upper ? corner >> 1 : corner & 1;
    bvec3 to;
    to[axis] = upper;
    to[(axis + 1) % 3] = a == 1;
    to[(axis + 2) % 3] = b == 1;
    vec3 place = mix(cover_lower, cover_upper, to);
    // The depth is the pass's (glDepthRange).
    float w = dot(clip_w.xyz, place) + clip_w.w;
    gl_Position = vec4(dot(clip_x.xyz, place) + clip_x.w, dot(clip_y.xyz, place) + clip_y.w, 0.0, w);
}
