// The medium of a step is that of the value at its middle.
struct StepEnd {
    float unused;
};

StepEnd step_end(vec3 place) {
    return StepEnd(0.0);
}

vec4 step_medium(vec3 middle, vec3 leave, float piece, inout StepEnd at) {
    return transfer_at(stored_from(field_at(middle)));
}
