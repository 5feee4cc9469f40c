#include "core/render/skip_grid.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/plan/distance.h"
#include "core/render/leaf_ranges.h"

#include <glad/gl.h>
#include <stdlib.h>
#include <string.h>

static bool make_octree(ang_skip_grid *grid, ang_gl *gl, const ang_volume *volume, const ang_volume_texture *field,
                        int threads, ang_error *err) {
    static const int leaf[3] = {ANG_SKIP_BLOCK, ANG_SKIP_BLOCK, ANG_SKIP_BLOCK};
    grid->octree = field ? ang_octree_allocate(volume, leaf, 1, err) : ang_octree_build(volume, leaf, 1, threads, err);
    if (!grid->octree || !field) return grid->octree != NULL;
    if (!ang_leaf_ranges_fit(grid->octree->level[0].dims)) {
        ang_octree_free(grid->octree);
        grid->octree = ang_octree_build(volume, leaf, 1, threads, err);
        return grid->octree != NULL;
    }
    if (!ang_leaf_ranges_compute(gl, field, grid->octree, err)) return false;
    ang_octree_finish(grid->octree, threads);
    return true;
}

static bool make(ang_skip_grid *grid, ang_gl *gl, const ang_volume *volume, const ang_volume_texture *field,
                 int threads, ang_error *err) {
    double start = ang_now_ms();
    if (!make_octree(grid, gl, volume, field, threads, err)) return false;
    grid->build_ms = ang_now_ms() - start;
    const int *dims = grid->octree->level[0].dims;
    grid->blocks = (size_t)dims[0] * (size_t)dims[1] * (size_t)dims[2];
    grid->visible = ang_alloc(grid->blocks, 1, "grid of visible blocks", err);
    grid->distance = ang_alloc(grid->blocks, 1, "grid of distances", err);
    if (!grid->visible || !grid->distance) return false;
    glGenTextures(1, &grid->texture);
    glBindTexture(GL_TEXTURE_3D, grid->texture);
    glTexStorage3D(GL_TEXTURE_3D, 1, GL_R8UI, dims[0], dims[1], dims[2]);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glBindTexture(GL_TEXTURE_3D, 0);
    return true;
}

/* Only the planes whose distances have changed. */
static void upload(ang_skip_grid *grid, const uint8_t *before) {
    const int *dims = grid->octree->level[0].dims;
    size_t plane = (size_t)dims[0] * (size_t)dims[1];
    int first = 0, end = dims[2];
    if (before) {
        while (first < end &&
               memcmp(before + plane * (size_t)first, grid->distance + plane * (size_t)first, plane) == 0)
            first++;
        while (end > first &&
               memcmp(before + plane * (size_t)(end - 1), grid->distance + plane * (size_t)(end - 1), plane) == 0)
            end--;
    }
    glBindTexture(GL_TEXTURE_3D, grid->texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, first, dims[0], dims[1], end - first, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                    grid->distance + plane * (size_t)first);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glBindTexture(GL_TEXTURE_3D, 0);
    grid->blocks_uploaded = plane * (size_t)(end - first);
}

bool ang_skip_grid_update(ang_skip_grid *grid, ang_gl *gl, const ang_volume *volume, const ang_volume_texture *field,
                          const ang_visibility *visibility, int threads, ang_error *err) {
    bool fresh = !grid->texture;
    grid->build_ms = 0;
    grid->blocks_uploaded = 0;
    if (fresh && !make(grid, gl, volume, field, threads, err)) {
        ang_skip_grid_destroy(grid);
        return false;
    }
    bool changed = fresh;
    uint8_t *before = fresh ? NULL : ang_alloc(grid->blocks, 1, "grid of distances", err);
    if (!fresh && !before) return false;
    grid->visible_blocks = 0;
    grid->box = ang_block_box_none();
    for (size_t i = 0; i < grid->blocks; i++) {
        uint8_t shows = ang_visibility_of(visibility, grid->octree->level[0].nodes[i]);
        changed = changed || shows != grid->visible[i];
        grid->visible[i] = shows;
        grid->visible_blocks += shows;
        if (shows) ang_block_box_add(&grid->box, grid->octree, i);
    }
    if (!changed) {
        free(before);
        return true;
    }
    if (before) memcpy(before, grid->distance, grid->blocks);
    ang_block_distances(grid->octree->level[0].dims, grid->visible, grid->distance);
    upload(grid, before);
    free(before);
    grid->changes++;
    return ang_gl_check(gl, err);
}

void ang_skip_grid_destroy(ang_skip_grid *grid) {
    if (grid->texture) glDeleteTextures(1, &grid->texture);
    ang_octree_free(grid->octree);
    free(grid->visible);
    free(grid->distance);
    *grid = (ang_skip_grid){0};
}

void ang_skip_grid_bind(const ang_skip_grid *grid, unsigned program, int unit, ang_vec3 centre) {
    const int *leaf = grid->octree->leaf, *dims = grid->octree->level[0].dims;
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_3D, grid->texture);
    ang_uniform_int(program, "skip_grid", unit);
    ang_uniform_vec3(program, "skip_scale", (ang_vec3){1.0 / leaf[0], 1.0 / leaf[1], 1.0 / leaf[2]});
    ang_uniform_vec3(program, "skip_offset", (ang_vec3){centre.x / leaf[0], centre.y / leaf[1], centre.z / leaf[2]});
    ang_uniform_vec3(program, "skip_last", (ang_vec3){dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0});
}
