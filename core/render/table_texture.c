#include "core/render/table_texture.h"

#include <glad/gl.h>
#include <math.h>

static void make_buffer(unsigned *buffer, unsigned *texture, GLenum format, const float *values, size_t count) {
    glGenBuffers(1, buffer);
    glBindBuffer(GL_TEXTURE_BUFFER, *buffer);
    glBufferData(GL_TEXTURE_BUFFER, (GLsizeiptr)(count * sizeof *values), values, GL_STATIC_DRAW);
    glGenTextures(1, texture);
    glBindTexture(GL_TEXTURE_BUFFER, *texture);
    glTexBuffer(GL_TEXTURE_BUFFER, format, *buffer);
    glBindTexture(GL_TEXTURE_BUFFER, 0);
    glBindBuffer(GL_TEXTURE_BUFFER, 0);
}

static void drop(ang_table_texture *texture) {
    ang_prefix_texture_destroy(&texture->prefix);
    if (texture->texture) glDeleteTextures(1, &texture->texture);
    if (texture->buffer) glDeleteBuffers(1, &texture->buffer);
    if (texture->extinction_texture) glDeleteTextures(1, &texture->extinction_texture);
    if (texture->extinctions) glDeleteBuffers(1, &texture->extinctions);
    texture->texture = texture->buffer = texture->extinction_texture = texture->extinctions = 0;
    texture->measured = false;
}

bool ang_table_texture_update(ang_table_texture *texture, ang_gl *gl, const ang_transfer *transfer,
                              const ang_volume *volume, ang_error *err) {
    /* Two texels an interval, and two more of prefix integrals. */
    int limit = ang_gl_max_texture_buffer(gl) / 2 - 1;
    if (limit > 32768) limit = 0;
    bool made;
    if (!ang_table_cache_update(&texture->cache, transfer, volume, limit, &made, err)) return false;
    if (!made) return true;
    drop(texture);
    const ang_table_cache *cache = &texture->cache;
    size_t entries = 2 * (size_t)cache->tables->intervals;
    make_buffer(&texture->buffer, &texture->texture, GL_RGBA32F, cache->tables->entries, 4 * entries);
    if (cache->one_colour)
        make_buffer(&texture->extinctions, &texture->extinction_texture, GL_R32F, cache->extinctions, entries);
    if (ang_gl_check(gl, err)) return true;
    ang_table_texture_destroy(texture);
    return false;
}

bool ang_table_texture_classify(ang_table_texture *texture, ang_gl *gl, const ang_transfer *transfer,
                                const ang_volume *volume, ang_classify wanted, double step, ang_error *err) {
    if (!texture->measured && wanted != ANG_CLASSIFY_PREFIX) {
        texture->stiffness = ang_stiffness_of(transfer);
        ang_stiffness_measure(&texture->stiffness, volume);
        texture->measured = true;
    }
    texture->classification = ang_classification_choose(wanted, &texture->stiffness, step);
    if (!texture->classification.prefix || texture->prefix.sums.texture) return true;
    ang_prefix *prefix = ang_prefix_create(texture->cache.tables, transfer, volume->slope, volume->intercept, err);
    bool made = prefix && ang_prefix_texture_make(&texture->prefix, gl, prefix, err);
    ang_prefix_free(prefix);
    return made;
}

double ang_table_texture_greatest(const ang_table_texture *texture) {
    return texture->classification.prefix ? fmax(texture->cache.greatest, texture->prefix.greatest)
                                          : texture->cache.greatest;
}

void ang_table_texture_destroy(ang_table_texture *texture) {
    drop(texture);
    ang_table_cache_clear(&texture->cache);
    *texture = (ang_table_texture){0};
}

void ang_table_texture_bind(const ang_table_texture *texture, unsigned program, int unit, int alone) {
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_BUFFER, texture->texture);
    ang_uniform_int(program, "transfer_table", unit);
    if (texture->cache.one_colour) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)alone);
        glBindTexture(GL_TEXTURE_BUFFER, texture->extinction_texture);
        ang_uniform_int(program, "transfer_extinction", alone);
        ang_uniform_vec3(program, "transfer_colour",
                         (ang_vec3){texture->cache.colour[0], texture->cache.colour[1], texture->cache.colour[2]});
    }
    ang_uniform_float(program, "transfer_first", texture->cache.tables->first);
    ang_uniform_float(program, "transfer_per_value", texture->cache.tables->per_value);
    ang_uniform_int(program, "transfer_intervals", texture->cache.tables->intervals);
}
