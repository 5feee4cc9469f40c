// Samples at enter + (i + 1/2) step; the last piece has its true length and its sample in its middle.
uniform float lattice_step; // mm

// How many samples `reach` mm take. A remainder below a thousandth of a step joins the piece before it, since the
// float ends of a ray are not more certain than that.
int lattice_count(float reach) {
    return int(max(1.0, ceil(reach / lattice_step - 1e-3)));
}
// Length of sample i of `count`, mm.
float lattice_length(int i, int count, float reach) {
    return i + 1 < count ? lattice_step : reach - float(count - 1) * lattice_step;
}
// Where step i of `count` begins and the one before it ends, mm from the entry.
float lattice_node(int i, int count, float reach) {
    return i < count ? float(i) * lattice_step : reach;
}
// Where sample i lies, mm from the entry; `piece` is its length.
float lattice_place(int i, float piece) {
    return float(i) * lattice_step + 0.5 * piece;
}
