// As raycast_fetch.glsl in parallel projection, where all rays have one direction and the way in the box is beside the
// entry.
uniform sampler2D path_entry; // where the ray enters, mm in the box; all 0 where it misses the box
uniform vec3 path_along;      // index per mm

Path path_here() {
    vec4 entry = texelFetch(path_entry, ivec2(gl_FragCoord.xy), 0);
    return Path(entry.xyz, path_along, entry.w, entry.w > 0.0 ? lattice_count(entry.w) : 0);
}
