// The surface, once a pixel: the hit between two lookups is refined and shaded.
uniform sampler2D pass_found; // raycast_iso.glsl
uniform float iso_stored;     // stored value
uniform vec3 iso_colour;      // the transfer function's at the iso value
layout(location = 0) out vec4 picture;

const int iso_refinements = 18; // halvings of one step

void main() {
    vec4 found = texelFetch(pass_found, ivec2(gl_FragCoord.xy), 0);
    Path path = path_here();
    bool hit = found.a > 0.0;
    bool cut = found.b > 0.0;
    float before = found.r;
    float at = found.g;
    // Software GL leaves a loop when none of its pixels goes on, but runs both sides of a branch.
    int halvings = 0;
    while (hit && !cut && halvings < iso_refinements) {
        float middle = 0.5 * (before + at);
        bool reached = stored_from(field_at(path.start + middle * path.direction)) >= iso_stored;
        at = reached ? middle : at;
        before = reached ? before : middle;
        halvings++;
    }
    vec3 place = path.start + at * path.direction;
    vec3 colour = cut ? transfer_at(stored_from(field_at(place))).rgb : iso_colour;
    vec3 shaded = shade(colour, place, along_mm(gl_FragCoord.xy), hit);
    picture = hit ? vec4(shaded, 1.0) : vec4(0.0);
    count_samples(halvings);
}
