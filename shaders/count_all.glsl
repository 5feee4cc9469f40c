// Every sample counts.
const bool count_all = true;
