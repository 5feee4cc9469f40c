uniform float mean_base;  // stored value about which was summed
uniform float mean_empty; // stored value (any) shown where there is only padding

// raycast_mean.glsl
float resolve_value(vec4 parts) {
    vec2 sums = parts.rg + parts.ba;
    return sums.g > 0.0 ? mean_base + sums.r / sums.g : mean_empty;
}
