// As raycast_empty.glsl, where the main pass has looked already.
uniform sampler2D path_wake; // raycast_wake.glsl
uniform int pass_next;       // the next pass

void main() {
    if (texelFetch(path_wake, ivec2(gl_FragCoord.xy), 0).r <= float(pass_next)) discard;
}
