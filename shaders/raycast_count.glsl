layout(location = 1) out float counted; // field evaluations, added up by blending

void count_samples(int samples) {
    counted = float(samples);
}
