// Nothing in the scene changes at once with the value, so that the last bits do not matter.
float stored_from(float field) {
    return field;
}
