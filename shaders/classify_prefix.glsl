// The medium of a step, all values between those at its ends taken as often as each other: exact where the field is
// linear over the step, whatever the transfer function (numerics.md, "Prefix integral"; core/transfer/prefix.h).
uniform samplerBuffer prefix_sums; // two texels an interval: colour * extinction and extinction, upper and lower parts

// A value in the transfer function's table.
struct StepEnd {
    float interval; // -1 and transfer_intervals stand for what lies outside the table
    float inside;   // how far from the interval's left end, in intervals: 0 to 1 except outside the table
    vec4 left;      // the entries at the interval's ends
    vec4 right;
};

void fetch_entries(inout StepEnd end) {
    int entry = 2 * clamp(int(end.interval), 0, transfer_intervals - 1);
    end.left = transfer_entry(entry + int(end.interval >= float(transfer_intervals)));
    end.right = transfer_entry(entry + int(end.interval >= 0.0));
}

StepEnd step_end(vec3 place) {
    float x = (stored_from(field_at(place)) - transfer_first) * transfer_per_value;
    StepEnd end;
    end.interval = clamp(floor(x), -1.0, float(transfer_intervals));
    end.inside = x - end.interval;
    fetch_entries(end);
    return end;
}

// Means over part of an interval, in which both extinction and colour are linear: no differences of integrals, which
// would cancel where the part is short.
vec4 mean_inside(StepEnd at, float from, float to) {
    vec4 slope = at.right - at.left;
    vec4 middle = at.left + 0.5 * (from + to) * slope;
    float size = to - from;
    return vec4(middle.rgb * middle.a + slope.rgb * (slope.a * size * size * (1.0 / 12.0)), middle.a);
}

float prefix_span(StepEnd low, StepEnd high) {
    return (high.interval - low.interval) + (high.inside - low.inside);
}

// Means of colour * extinction and extinction between two values.
vec4 mean_between(StepEnd low, StepEnd high) {
    bool same = low.interval == high.interval;
    vec4 first = mean_inside(low, low.inside, same ? high.inside : 1.0);
    int from = 2 * min(int(low.interval) + 1, transfer_intervals);
    int to = 2 * max(int(high.interval), 0);
    // Pairs of floats: above a dense stretch of the transfer function one float would lose what is thin.
    vec4 between = (texelFetch(prefix_sums, to) - texelFetch(prefix_sums, from)) +
                   (texelFetch(prefix_sums, to + 1) - texelFetch(prefix_sums, from + 1));
    vec4 sum = (1.0 - low.inside) * first + between + high.inside * mean_inside(high, 0.0, high.inside);
    float span = (1.0 - low.inside) + (high.interval - low.interval - 1.0) + high.inside;
    return same ? first : sum / max(span, 1e-30);
}

vec4 medium_of(vec4 mean) {
    return vec4(mean.a > 0.0 ? min(mean.rgb / mean.a, vec3(1.0)) : vec3(0.0), mean.a);
}

bool rises(StepEnd a, StepEnd b) {
    return b.interval > a.interval || (b.interval == a.interval && b.inside >= a.inside);
}

vec4 mean_from(StepEnd a, StepEnd b) {
    bool up = rises(a, b);
    StepEnd low = a;
    StepEnd high = b;
    if (!up) {
        low = b;
        high = a;
    }
    return mean_between(low, high);
}

// The light of `piece` mm from a to b: prefix_smooth.glsl or prefix_plateaus.glsl.
vec4 medium_between(StepEnd a, StepEnd b, float piece);

// `at` is where the step begins and becomes where it ends: a march looks up one value a step.
vec4 step_medium(vec3 middle, vec3 leave, float piece, inout StepEnd at) {
    StepEnd before = at;
    at = step_end(leave);
    return medium_between(before, at, piece);
}
