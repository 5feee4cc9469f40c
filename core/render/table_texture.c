#include "core/render/table_texture.h"

#include "core/base/memory.h"

#include <glad/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Contents, not the pointer: a transfer function that was freed may have its address taken by the next. */
static bool is_current(const ang_table_texture *texture, const ang_transfer *transfer) {
    return texture->tables && texture->count == transfer->count && texture->unit_distance == transfer->unit_distance &&
           texture->by_extinction == transfer->by_extinction &&
           memcmp(texture->points, transfer->points, transfer->count * sizeof *transfer->points) == 0;
}

/* Whether all intervals in which anything has extinction have one colour; where nothing has, any does. */
static bool find_colour(ang_table_texture *texture) {
    const float *colour = NULL, *entry = texture->tables->entries;
    for (int i = 0; i < texture->tables->intervals; i++, entry += 8) {
        if (!(entry[3] > 0 || entry[7] > 0)) continue;
        if (!colour) colour = entry;
        if (memcmp(colour, entry, 3 * sizeof *entry) != 0 || memcmp(colour, entry + 4, 3 * sizeof *entry) != 0)
            return false;
    }
    for (int k = 0; k < 3; k++) texture->colour[k] = colour ? colour[k] : 0;
    return true;
}

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

static bool upload(ang_table_texture *texture, ang_error *err) {
    size_t entries = 2 * (size_t)texture->tables->intervals;
    make_buffer(&texture->buffer, &texture->texture, GL_RGBA32F, texture->tables->entries, 4 * entries);
    if (!texture->one_colour) return true;
    float *alone = ang_alloc(entries, sizeof *alone, "table of extinctions", err);
    if (!alone) return false;
    for (size_t i = 0; i < entries; i++) alone[i] = texture->tables->entries[4 * i + 3];
    make_buffer(&texture->extinctions, &texture->extinction_texture, GL_R32F, alone, entries);
    free(alone);
    return true;
}

bool ang_table_texture_update(ang_table_texture *texture, ang_gl *gl, const ang_transfer *transfer,
                              const ang_volume *volume, ang_error *err) {
    if (is_current(texture, transfer)) return true;
    /* Two texels an interval, and two more of prefix integrals. */
    int limit = ang_gl_max_texture_buffer(gl) / 2 - 1;
    if (limit > 32768) limit = 0;
    /* The range of the volume leaves padding out, but its voxels are interpolated and classified like any other. */
    uint16_t padding = volume->padding_count > 0 ? ang_volume_padding_value(volume) : volume->minimum;
    uint16_t minimum = padding < volume->minimum ? padding : volume->minimum;
    uint16_t maximum = padding > volume->maximum ? padding : volume->maximum;
    ang_transfer_tables *tables =
        ang_tables_create(transfer, volume->slope, volume->intercept, minimum, maximum, limit, err);
    ang_transfer_point *points =
        tables ? ang_alloc(transfer->count, sizeof *points, "the transfer function's points", err) : NULL;
    if (!points) {
        ang_tables_free(tables);
        return false;
    }
    memcpy(points, transfer->points, transfer->count * sizeof *points);
    ang_table_texture_destroy(texture);
    *texture = (ang_table_texture){.tables = tables,
                                   .points = points,
                                   .count = transfer->count,
                                   .unit_distance = transfer->unit_distance,
                                   .by_extinction = transfer->by_extinction};
    for (int i = 0; i < 2 * tables->intervals; i++)
        texture->greatest = fmax(texture->greatest, tables->entries[4 * i + 3]);
    texture->one_colour = find_colour(texture);
    if (upload(texture, err) && ang_gl_check(gl, err)) return true;
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
    ang_prefix *prefix = ang_prefix_create(texture->tables, transfer, volume->slope, volume->intercept, err);
    bool made = prefix && ang_prefix_texture_make(&texture->prefix, gl, prefix, err);
    ang_prefix_free(prefix);
    return made;
}

double ang_table_texture_greatest(const ang_table_texture *texture) {
    return texture->classification.prefix ? fmax(texture->greatest, texture->prefix.greatest) : texture->greatest;
}

void ang_table_texture_destroy(ang_table_texture *texture) {
    ang_prefix_texture_destroy(&texture->prefix);
    if (texture->texture) glDeleteTextures(1, &texture->texture);
    if (texture->buffer) glDeleteBuffers(1, &texture->buffer);
    if (texture->extinction_texture) glDeleteTextures(1, &texture->extinction_texture);
    if (texture->extinctions) glDeleteBuffers(1, &texture->extinctions);
    if (texture->tables) ang_tables_free(texture->tables);
    free(texture->points);
    *texture = (ang_table_texture){0};
}

void ang_table_texture_bind(const ang_table_texture *texture, unsigned program, int unit, int alone) {
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_BUFFER, texture->texture);
    ang_uniform_int(program, "transfer_table", unit);
    if (texture->one_colour) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)alone);
        glBindTexture(GL_TEXTURE_BUFFER, texture->extinction_texture);
        ang_uniform_int(program, "transfer_extinction", alone);
        ang_uniform_vec3(program, "transfer_colour",
                         (ang_vec3){texture->colour[0], texture->colour[1], texture->colour[2]});
    }
    ang_uniform_float(program, "transfer_first", texture->tables->first);
    ang_uniform_float(program, "transfer_per_value", texture->tables->per_value);
    ang_uniform_int(program, "transfer_intervals", texture->tables->intervals);
}
