// Every sample is taken.
vec3 skip_rate(vec3 direction) {
    return vec3(0.0);
}

int skip_steps(vec3 place, vec3 rate) {
    return 0;
}
