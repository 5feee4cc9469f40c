// Rays are followed through all of the clip box.
void bounds_of(Ray ray, float reach, int count, out int begin, out int end) {
    begin = 0;
    end = count;
}
