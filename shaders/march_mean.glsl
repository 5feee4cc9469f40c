// The mean by mm of what is not padding.
uniform float mean_base;  // stored value about which is summed: that of padding, where there is any
uniform float mean_empty; // stored value (any) shown where there is only padding

vec4 march(Ray ray, out float samples) {
    March m = march_along(ray);
    // x: about padding, the share of padding drops out; y: mm of tissue. Thousands of terms are summed: what a sum loses
    // to rounding is kept in `lost` and added to the next term (Kahan).
    vec2 sum = vec2(0.0);
    precise vec2 lost = vec2(0.0);
    for (int i = 0; i < m.count; i++) {
        float piece;
        vec3 place = march_place(m, i, piece);
        precise vec2 term = piece * vec2(field_at(place) - mean_base, weight_at(place)) - lost;
        precise vec2 next = sum + term;
        lost = (next - sum) - term;
        sum = next;
    }
    samples = float(m.count);
    return window_grey(sum.y > 0.0 ? mean_base + sum.x / sum.y : mean_empty);
}
