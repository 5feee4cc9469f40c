// Plateaus at opacity 1: the first that a step meets ends it, behind what lies before it.
uniform samplerBuffer prefix_plateaus; // of each interval, from -1 on: the nearest plateau at or above it, at or below it

vec4 medium_between(StepEnd a, StepEnd b, float piece) {
    bool up = rises(a, b);
    vec2 nearest = texelFetch(prefix_plateaus, int(a.interval) + 1).rg;
    StepEnd edge;
    edge.interval = up ? nearest.r : nearest.g;
    bool meets = up ? edge.interval <= b.interval : edge.interval >= b.interval;
    bool inside = edge.interval == a.interval;
    edge.interval = meets ? edge.interval : b.interval;
    edge.inside = !meets ? b.inside : inside ? a.inside : up ? 0.0 : 1.0;
    fetch_entries(edge);
    vec4 mean = mean_from(a, edge);
    vec4 medium = medium_of(mean);
    float share = abs(prefix_span(a, edge)) / max(abs(prefix_span(a, b)), 1e-30);
    float before = inside ? 0.0 : opacity_of(min(mean.a, 1e20) * share * piece);
    vec3 surface = mix(edge.left.rgb, edge.right.rgb, clamp(edge.inside, 0.0, 1.0));
    // 1e30: opaque at once (core/transfer/tables.h).
    return meets ? vec4(mix(surface, medium.rgb, before), 1e30) : medium;
}
