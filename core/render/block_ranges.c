#include "core/render/block_ranges.h"

#include "core/base/clock.h"
#include "core/base/memory.h"

#include <glad/gl.h>
#include <stdlib.h>
#include <string.h>

enum { TABLE_BYTES = ANG_BLOCK_LEVELS * ANG_BLOCK_LEVELS };

/* Entries in one stored value. */
static double per_value(uint16_t lowest, uint16_t highest) {
    return highest > lowest ? (ANG_BLOCK_LEVELS - 1.0) / (highest - lowest) : 0;
}

void ang_block_table(const ang_visibility *visibility, uint16_t lowest, uint16_t highest, uint8_t *table) {
    double width = (highest - lowest) / (ANG_BLOCK_LEVELS - 1.0);
    memset(table, 0, TABLE_BYTES);
    for (int b = 0; b < ANG_BLOCK_LEVELS; b++)
        for (int a = 0; a <= b; a++) {
            ang_minmax range = {(uint16_t)floor(lowest + a * width), (uint16_t)fmin(ceil(lowest + b * width), highest)};
            table[a + ANG_BLOCK_LEVELS * b] = ang_visibility_of(visibility, range) ? 255 : 0;
        }
}

size_t ang_block_entry(uint16_t lowest, uint16_t highest, ang_minmax range) {
    const double last = ANG_BLOCK_LEVELS - 1, scale = per_value(lowest, highest), room = 1e-3;
    double a = fmax(floor((range.min - lowest) * scale - room), 0);
    double b = fmin(ceil((range.max - lowest) * scale + room), last);
    return (size_t)a + ANG_BLOCK_LEVELS * (size_t)b;
}

static void make_texture(unsigned *name, GLenum target) {
    glGenTextures(1, name);
    glBindTexture(target, *name);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static bool make(ang_block_ranges *ranges, const ang_volume *volume, int threads, ang_error *err) {
    double start = ang_now_ms();
    ranges->octree = ang_octree_build(volume, NULL, 1, threads, err);
    if (!ranges->octree) return false;
    ranges->build_ms = ang_now_ms() - start;
    ranges->table = ang_alloc(TABLE_BYTES, 1, "table of ranges that show", err);
    if (!ranges->table) return false;
    const ang_octree *octree = ranges->octree;
    const ang_octree_level *leaves = &octree->level[0];
    /* The range of the volume leaves padding out, that of the root does not. */
    ranges->lowest = octree->level[octree->levels - 1].nodes[0].min;
    ranges->highest = octree->level[octree->levels - 1].nodes[0].max;
    ranges->blocks = (size_t)leaves->dims[0] * (size_t)leaves->dims[1] * (size_t)leaves->dims[2];
    make_texture(&ranges->ranges, GL_TEXTURE_3D);
    glTexStorage3D(GL_TEXTURE_3D, 1, GL_RG16, leaves->dims[0], leaves->dims[1], leaves->dims[2]);
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, 0, leaves->dims[0], leaves->dims[1], leaves->dims[2], GL_RG,
                    GL_UNSIGNED_SHORT, leaves->nodes);
    glBindTexture(GL_TEXTURE_3D, 0);
    make_texture(&ranges->shows, GL_TEXTURE_2D);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_R8, ANG_BLOCK_LEVELS, ANG_BLOCK_LEVELS);
    glBindTexture(GL_TEXTURE_2D, 0);
    return true;
}

static void count_shown(ang_block_ranges *ranges) {
    ranges->shown = 0;
    ranges->box = ang_block_box_none();
    for (size_t i = 0; i < ranges->blocks; i++) {
        ang_minmax range = ranges->octree->level[0].nodes[i];
        if (!ranges->table[ang_block_entry(ranges->lowest, ranges->highest, range)]) continue;
        ranges->shown++;
        ang_block_box_add(&ranges->box, ranges->octree, i);
    }
}

bool ang_block_ranges_update(ang_block_ranges *ranges, ang_gl *gl, const ang_volume *volume,
                             const ang_visibility *visibility, int threads, ang_error *err) {
    bool fresh = !ranges->shows, empty = ranges->tables_uploaded == 0;
    ranges->build_ms = 0;
    if (fresh && !make(ranges, volume, threads, err)) {
        ang_block_ranges_destroy(ranges);
        return false;
    }
    /* To make the table takes less than to find out for certain that nothing in the scene has changed. */
    uint8_t *table = ang_alloc(TABLE_BYTES, 1, "table of ranges that show", err);
    if (!table) return false;
    ang_block_table(visibility, ranges->lowest, ranges->highest, table);
    if (!empty && memcmp(table, ranges->table, TABLE_BYTES) == 0) {
        free(table);
        return true;
    }
    free(ranges->table);
    ranges->table = table;
    glBindTexture(GL_TEXTURE_2D, ranges->shows);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, ANG_BLOCK_LEVELS, ANG_BLOCK_LEVELS, GL_RED, GL_UNSIGNED_BYTE, table);
    glBindTexture(GL_TEXTURE_2D, 0);
    ranges->tables_uploaded++;
    count_shown(ranges);
    return ang_gl_check(gl, err);
}

void ang_block_ranges_destroy(ang_block_ranges *ranges) {
    if (ranges->ranges) glDeleteTextures(1, &ranges->ranges);
    if (ranges->shows) glDeleteTextures(1, &ranges->shows);
    ang_octree_free(ranges->octree);
    free(ranges->table);
    *ranges = (ang_block_ranges){0};
}

void ang_block_ranges_bind(const ang_block_ranges *ranges, unsigned program, int unit, ang_vec3 centre) {
    const int *leaf = ranges->octree->leaf, *dims = ranges->octree->level[0].dims;
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_3D, ranges->ranges);
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit + 1);
    glBindTexture(GL_TEXTURE_2D, ranges->shows);
    ang_uniform_int(program, "block_ranges", unit);
    ang_uniform_int(program, "block_shows", unit + 1);
    ang_uniform_vec3(program, "block_scale", (ang_vec3){1.0 / leaf[0], 1.0 / leaf[1], 1.0 / leaf[2]});
    ang_uniform_vec3(program, "block_offset", (ang_vec3){centre.x / leaf[0], centre.y / leaf[1], centre.z / leaf[2]});
    ang_uniform_vec3(program, "block_last", (ang_vec3){dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0});
    glProgramUniform2f(program, glGetUniformLocation(program, "block_quantise"), ranges->lowest,
                       (float)per_value(ranges->lowest, ranges->highest));
}
