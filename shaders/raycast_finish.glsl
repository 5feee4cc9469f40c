// Finished pixels get a depth that nothing passes: neither main passes nor this one run for them again.
void main() {
    if (!is_opaque() && !has_left()) discard;
}
