// A main pass: pass_steps lookups along every ray that is not finished, blended with what the passes before have found.
uniform int pass_first; // its first lookup
layout(location = 0) out vec4 found;

void main() {
    Path path = path_here();
    found = pass_value(path, pass_first);
    count_samples(clamp(lookup_count(path.count) - pass_first, 0, pass_steps));
    set_wake(path, pass_first + pass_steps);
}
