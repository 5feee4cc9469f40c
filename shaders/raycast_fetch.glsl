uniform sampler2D path_entry;     // where the ray enters, samples; all 0 where it misses the box
uniform sampler2D path_direction; // index per mm, mm in the box

Path path_here() {
    vec4 entry = texelFetch(path_entry, ivec2(gl_FragCoord.xy), 0);
    vec4 direction = texelFetch(path_direction, ivec2(gl_FragCoord.xy), 0);
    return Path(entry.xyz, direction.xyz, direction.w, int(entry.w));
}
