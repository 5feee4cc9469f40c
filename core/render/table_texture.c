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

bool ang_table_texture_update(ang_table_texture *texture, ang_gl *gl, const ang_transfer *transfer,
                              const ang_volume *volume, ang_error *err) {
    if (is_current(texture, transfer)) return true;
    int limit = ang_gl_max_texture_buffer(gl) / 2;
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
    glGenBuffers(1, &texture->buffer);
    glBindBuffer(GL_TEXTURE_BUFFER, texture->buffer);
    glBufferData(GL_TEXTURE_BUFFER, (GLsizeiptr)((size_t)tables->intervals * 8 * sizeof(float)), tables->entries,
                 GL_STATIC_DRAW);
    glGenTextures(1, &texture->texture);
    glBindTexture(GL_TEXTURE_BUFFER, texture->texture);
    glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, texture->buffer);
    glBindTexture(GL_TEXTURE_BUFFER, 0);
    glBindBuffer(GL_TEXTURE_BUFFER, 0);
    if (ang_gl_check(gl, err)) return true;
    ang_table_texture_destroy(texture);
    return false;
}

void ang_table_texture_destroy(ang_table_texture *texture) {
    if (texture->texture) glDeleteTextures(1, &texture->texture);
    if (texture->buffer) glDeleteBuffers(1, &texture->buffer);
    if (texture->tables) ang_tables_free(texture->tables);
    free(texture->points);
    *texture = (ang_table_texture){0};
}

void ang_table_texture_bind(const ang_table_texture *texture, unsigned program, int unit) {
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_BUFFER, texture->texture);
    ang_uniform_int(program, "transfer_table", unit);
    ang_uniform_float(program, "transfer_first", texture->tables->first);
    ang_uniform_float(program, "transfer_per_value", texture->tables->per_value);
    ang_uniform_int(program, "transfer_intervals", texture->tables->intervals);
}
