void count_samples(int samples) {
}
