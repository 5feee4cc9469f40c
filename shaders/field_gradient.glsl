// The stored value from the texture that has gradients beside it.
uniform sampler3D gradient_values;
uniform float gradient_range; // stored values in all of a channel

float field_at(vec3 place) {
    return 65535.0 * textureLod(gradient_values, place * field_scale + field_offset, 0.0).a;
}
