// Only samples that show count: what any method must take.
const bool count_all = false;
