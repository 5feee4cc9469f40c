// Central differences, made beforehand (core/render/gradient_texture.h). The lookup is that of field_at at the same
// place, which compilers make once.
uniform mat3 gradient_to_mm; // halved stored differences to HU/mm

vec3 gradient_at(vec3 place, bool wanted) {
    vec3 steps = textureLod(gradient_values, place * field_scale + field_offset, 0.0).rgb;
    return gradient_to_mm * ((steps - 32768.0 / 65535.0) * gradient_range);
}
