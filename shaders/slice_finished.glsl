// Marks pixels whose opacity has reached the threshold, by depth, for the early depth test of what follows.
uniform sampler2D slice_accumulated;
uniform float termination; // accumulated opacity at which a pixel is finished

void main() {
    if (texelFetch(slice_accumulated, ivec2(gl_FragCoord.xy), 0).a < termination) discard;
}
