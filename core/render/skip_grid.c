#include "core/render/skip_grid.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/render/leaf_ranges.h"

#include <glad/gl.h>
#include <stdlib.h>
#include <string.h>

/* The octree with ranges from the texture; NULL without an error where they come from the volume. */
static bool compute_octree(ang_gl *gl, const ang_volume *volume, const ang_volume_texture *field, int threads,
                           ang_octree **octree, ang_error *err) {
    *octree = NULL;
    if (!field) return true;
    ang_octree *computed = ang_block_grid_octree(volume, err);
    if (!computed) return false;
    bool fits = ang_leaf_ranges_fit(computed->level[0].dims);
    if (!fits || !ang_leaf_ranges_compute(gl, field, computed, err)) {
        ang_octree_free(computed);
        return !fits;
    }
    ang_octree_finish(computed, threads);
    *octree = computed;
    return true;
}

static bool make(ang_skip_grid *grid, ang_gl *gl, const ang_volume *volume, const ang_volume_texture *field,
                 int threads, ang_error *err) {
    double start = ang_now_ms();
    ang_octree *octree;
    if (!compute_octree(gl, volume, field, threads, &octree, err) ||
        !ang_block_grid_start(&grid->shown, volume, octree, threads, err))
        return false;
    grid->shown.build_ms = ang_now_ms() - start;
    const int *dims = grid->shown.octree->level[0].dims;
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
    const int *dims = grid->shown.octree->level[0].dims;
    size_t plane = (size_t)dims[0] * (size_t)dims[1];
    int first = 0, end = dims[2];
    if (before) {
        while (first < end &&
               memcmp(before + plane * (size_t)first, grid->shown.distance + plane * (size_t)first, plane) == 0)
            first++;
        while (end > first &&
               memcmp(before + plane * (size_t)(end - 1), grid->shown.distance + plane * (size_t)(end - 1), plane) == 0)
            end--;
    }
    glBindTexture(GL_TEXTURE_3D, grid->texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, first, dims[0], dims[1], end - first, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                    grid->shown.distance + plane * (size_t)first);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glBindTexture(GL_TEXTURE_3D, 0);
    grid->blocks_uploaded = plane * (size_t)(end - first);
}

bool ang_skip_grid_update(ang_skip_grid *grid, ang_gl *gl, const ang_volume *volume, const ang_volume_texture *field,
                          const ang_visibility *visibility, int threads, ang_error *err) {
    bool fresh = !grid->texture;
    grid->shown.build_ms = 0;
    grid->blocks_uploaded = 0;
    if (fresh && !make(grid, gl, volume, field, threads, err)) {
        ang_skip_grid_destroy(grid);
        return false;
    }
    uint8_t *before = fresh ? NULL : ang_alloc(grid->shown.blocks, 1, "grid of distances", err);
    if (!fresh && !before) return false;
    if (before) memcpy(before, grid->shown.distance, grid->shown.blocks);
    bool changed = false, updated = ang_block_grid_update(&grid->shown, visibility, false, threads, &changed, err);
    if (changed) upload(grid, before);
    free(before);
    return updated && (!changed || ang_gl_check(gl, err));
}

void ang_skip_grid_destroy(ang_skip_grid *grid) {
    if (grid->texture) glDeleteTextures(1, &grid->texture);
    ang_block_grid_clear(&grid->shown);
    *grid = (ang_skip_grid){0};
}

void ang_skip_grid_bind(const ang_skip_grid *grid, unsigned program, int unit, ang_vec3 centre) {
    const int *leaf = grid->shown.octree->leaf, *dims = grid->shown.octree->level[0].dims;
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_3D, grid->texture);
    ang_uniform_int(program, "skip_grid", unit);
    ang_uniform_vec3(program, "skip_scale", (ang_vec3){1.0 / leaf[0], 1.0 / leaf[1], 1.0 / leaf[2]});
    ang_uniform_vec3(program, "skip_offset", (ang_vec3){centre.x / leaf[0], centre.y / leaf[1], centre.z / leaf[2]});
    ang_uniform_vec3(program, "skip_last", (ang_vec3){dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0});
}
