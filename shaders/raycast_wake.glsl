// For the passes between: the next pass in which this ray meets something that may show. Not just whether the next one
// does, as in the paper: a pixel that a pass skips does not run, and could not say it of the pass after that.
layout(location = 2) out float wake;

void set_wake(Path path, int from) {
    int end = lookup_count(path.count);
    int next = next_shown(path, from, end);
    wake = next < end ? float(next / pass_steps) : 1e9;
}
