// The first lookup of a stretch at or above the iso value: mm of the one before it and of itself, whether it is the entry
// (a cut face), and 1, which hides what later passes find. Back to front, so that the nearest is kept (section 2.2).
uniform float iso_stored; // stored value

vec4 pass_value(Path path, int first) {
    int hit = -1;
    for (int k = pass_steps - 1; k >= 0; k--) {
        int i = first + k;
        float value = stored_from(field_at(path.start + lookup_at(i, path) * path.direction));
        hit = i < lookup_count(path.count) && value >= iso_stored ? i : hit;
    }
    if (hit < 0) return vec4(0.0);
    return vec4(hit > 0 ? lookup_at(hit - 1, path) : 0.0, lookup_at(hit, path), hit == 0, 1.0);
}
