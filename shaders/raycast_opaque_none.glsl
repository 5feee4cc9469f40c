bool is_opaque() {
    return false;
}
