// The slab of a sample that may be the first or the last of its ray, or both: a ray that crosses the box between two
// planes gets its one sample half-way, from the nearest plane. So no ray through the box is without. Behind opaque
// geometry no plane is met.
bool slice_met(int plane, vec3 place, float slant, float limit) {
    return slice_in_box(place) && slice_depth(plane) * slant <= limit;
}

bool slab_at(vec2 pixel, int plane, out Slab slab) {
    vec3 across = slice_across(pixel);
    Ray ray = ray_through(pixel);
    float slant = slice_slant(pixel);
    float limit = ray_limit(pixel);
    float at = slice_depth(plane) * slant;
    float half_way = 0.5 * slice_distance * slant;
    bool met = slice_met(plane, slice_place(plane, across), slant, limit);
    slab.before = slice_place(plane - 1, across);
    slab.first = plane == 0 || !slice_in_box(slab.before);
    slab.last = plane == slice_count - 1 || !slice_met(plane + 1, slice_place(plane + 1, across), slant, limit);
    if (!met) {
        at = 0.5 * (ray.enter + ray.leave);
        float nearest = clamp(roundEven((at / slant - slice_first) / slice_distance), 0.0, float(slice_count - 1));
        if (!(ray.enter < ray.leave && slab.first && slab.last && nearest == float(plane))) return false;
    }
    slab.place = met ? slice_place(plane, across) : clamp(ray.origin + at * ray.direction, box_lower, box_upper);
    slab.before = slab.first ? ray.origin + ray.enter * ray.direction : slab.before;
    slab.beyond = slab.last ? ray.origin + ray.leave * ray.direction : slab.place;
    float begin = slab.first ? min(ray.enter, at) : at - half_way;
    float end = slab.last ? max(ray.leave, at) : at + half_way;
    // With neighbours on both sides the same bits as in slice_inner.glsl: which of the two draws a sample depends on the
    // boxes.
    slab.length = slab.first || slab.last ? end - begin : slice_distance * slant;
    return true;
}
