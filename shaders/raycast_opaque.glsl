uniform sampler2D pass_found;
uniform float termination; // accumulated opacity at which a pixel is finished; of a surface any is

bool is_opaque() {
    return texelFetch(pass_found, ivec2(gl_FragCoord.xy), 0).a >= termination;
}
