// Pixels whose next stretch shows nothing get a depth that the next main pass does not pass, but the one after it does.
uniform int pass_next; // the next pass

void main() {
    Path path = path_here();
    int end = min((pass_next + 1) * pass_steps, lookup_count(path.count));
    if (next_shown(path, pass_next * pass_steps, end) < end) discard;
}
