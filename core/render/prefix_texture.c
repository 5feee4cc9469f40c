#include "core/render/prefix_texture.h"

#include "core/render/program.h"

bool ang_prefix_texture_make(ang_prefix_texture *texture, ang_gl *gl, const ang_prefix *prefix, ang_error *err) {
    ang_prefix_texture_destroy(texture);
    texture->greatest = prefix->greatest;
    ang_float_buffer_make(&texture->sums, 4, prefix->sums, 8 * ((size_t)prefix->intervals + 1));
    if (prefix->plateaus)
        ang_float_buffer_make(&texture->plateaus, 2, prefix->plateaus, 2 * ((size_t)prefix->intervals + 2));
    if (ang_gl_check(gl, err)) return true;
    ang_prefix_texture_destroy(texture);
    return false;
}

void ang_prefix_texture_destroy(ang_prefix_texture *texture) {
    ang_float_buffer_destroy(&texture->sums);
    ang_float_buffer_destroy(&texture->plateaus);
    *texture = (ang_prefix_texture){0};
}

void ang_prefix_texture_bind(const ang_prefix_texture *texture, unsigned program, int unit) {
    ang_float_buffer_bind(&texture->sums, unit);
    ang_uniform_int(program, "prefix_sums", unit);
    ang_float_buffer_bind(&texture->plateaus, unit + 1);
    ang_uniform_int(program, "prefix_plateaus", unit + 1);
}
