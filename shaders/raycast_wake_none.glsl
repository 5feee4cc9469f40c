void set_wake(Path path, int from) {
}
