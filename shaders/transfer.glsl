// The transfer function's table (core/transfer/tables.h): two entries an interval, r, g, b and extinction per mm.
uniform float transfer_first;     // stored value
uniform float transfer_per_value; // intervals in one stored value
uniform int transfer_intervals;

vec4 transfer_at(float stored) {
    float x = (stored - transfer_first) * transfer_per_value;
    float interval = clamp(floor(x), 0.0, float(transfer_intervals - 1));
    float inside = clamp(x - interval, 0.0, 1.0);
    int entry = 2 * int(interval);
    return mix(transfer_entry(entry), transfer_entry(entry + 1), inside);
}
