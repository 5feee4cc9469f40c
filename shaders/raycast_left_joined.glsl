uniform sampler2D path_wake; // raycast_wake.glsl

// Has left the volume, or what is left of it shows nothing.
bool has_left() {
    return texelFetch(path_wake, ivec2(gl_FragCoord.xy), 0).r >= 1e9;
}
