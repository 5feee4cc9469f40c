uniform float mean_typical; // stored value about which was summed
uniform float mean_empty;   // stored value (any) shown where there is only padding

float resolve_value(vec4 sums) {
    return sums.g > 0.0 ? mean_typical + sums.r / sums.g : mean_empty;
}
