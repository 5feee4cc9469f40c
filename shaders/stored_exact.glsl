// Stored values that were whole become whole again: k / 65535 * 65535 is off by up to two units in the last place, and a
// step of the transfer function or the iso value may lie on k.
float stored_from(float field) {
    float whole = roundEven(field);
    return abs(field - whole) <= 5e-7 * field ? whole : field;
}
