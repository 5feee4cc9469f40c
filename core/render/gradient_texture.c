#include "core/render/gradient_texture.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <glad/gl.h>
#include <math.h>
#include <stdlib.h>

/* Neighbouring blocks along x that are filled together. */
typedef struct run {
    int first[3], count[3]; /* voxels */
    size_t offset;          /* of its texels among those of the batch */
} run;

typedef struct job {
    const ang_volume *volume;
    const run *runs;
    uint16_t (*texels)[4];
    double scale; /* steps in one stored value */
} job;

/* Texels computed before they are uploaded. */
static const size_t batch_texels = (size_t)1 << 20;

static uint16_t step_of(double difference, double scale) { return (uint16_t)(32768 + lrint(difference * scale)); }

static void fill_run(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    const job *work = context;
    const ang_volume *volume = work->volume;
    const int *n = volume->dims;
    size_t strides[3] = {1, (size_t)n[0], (size_t)n[0] * (size_t)n[1]};
    for (size_t r = begin; r < end; r++) {
        const run *now = &work->runs[r];
        uint16_t(*out)[4] = work->texels + now->offset;
        for (int z = now->first[2]; z < now->first[2] + now->count[2]; z++)
            for (int y = now->first[1]; y < now->first[1] + now->count[1]; y++)
                for (int x = now->first[0]; x < now->first[0] + now->count[0]; x++, out++) {
                    const int at[3] = {x, y, z};
                    const uint16_t *voxel = volume->data + (size_t)x + strides[1] * (size_t)y + strides[2] * (size_t)z;
                    for (int axis = 0; axis < 3; axis++) {
                        int after = at[axis] + 1 < n[axis] ? voxel[strides[axis]] : *voxel;
                        int before = at[axis] > 0 ? *(voxel - strides[axis]) : *voxel;
                        (*out)[axis] = step_of(after - before, work->scale);
                    }
                    (*out)[3] = *voxel;
                }
    }
}

static void upload(const run *runs, size_t count, uint16_t (*texels)[4]) {
    for (size_t i = 0; i < count; i++) {
        const run *now = &runs[i];
        glTexSubImage3D(GL_TEXTURE_3D, 0, now->first[0], now->first[1], now->first[2], now->count[0], now->count[1],
                        now->count[2], GL_RGBA, GL_UNSIGNED_SHORT, texels[now->offset]);
    }
}

bool ang_gradient_texture_fits(const ang_volume *volume) {
    GLint width = 0;
    glTexImage3D(GL_PROXY_TEXTURE_3D, 0, GL_RGBA16, volume->dims[0], volume->dims[1], volume->dims[2], 0, GL_RGBA,
                 GL_UNSIGNED_SHORT, NULL);
    glGetTexLevelParameteriv(GL_PROXY_TEXTURE_3D, 0, GL_TEXTURE_WIDTH, &width);
    return width == volume->dims[0];
}

size_t ang_gradient_texture_bytes(const ang_volume *volume) { return 4 * sizeof(uint16_t) * ang_volume_count(volume); }

static bool make(ang_gradient_texture *gradients, ang_gl *gl, const ang_volume *volume, const ang_block_grid *grid,
                 ang_error *err) {
    gradients->filled = ang_alloc(grid->blocks, 1, "list of blocks with gradients", err);
    if (!gradients->filled) return false;
    uint16_t least = UINT16_MAX, greatest = 0;
    const ang_octree_level *top = &grid->octree->level[grid->octree->levels - 1];
    least = top->nodes[0].min;
    greatest = top->nodes[0].max;
    gradients->range = greatest > least ? greatest - least : 1;
    glGenTextures(1, &gradients->texture);
    glBindTexture(GL_TEXTURE_3D, gradients->texture);
    glTexStorage3D(GL_TEXTURE_3D, 1, GL_RGBA16, volume->dims[0], volume->dims[1], volume->dims[2]);
    static const GLenum wraps[] = {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R};
    for (int axis = 0; axis < 3; axis++) glTexParameteri(GL_TEXTURE_3D, wraps[axis], GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glBindTexture(GL_TEXTURE_3D, 0);
    return ang_gl_check(gl, err);
}

/* The voxels of blocks [x, end) of a row: those that interpolation inside them touches. */
static run make_run(const ang_volume *volume, const ang_block_grid *grid, int x, int end, int y, int z) {
    const int first[3] = {x, y, z}, last[3] = {end - 1, y, z}, *leaf = grid->octree->leaf;
    run now = {.offset = 0};
    for (int axis = 0; axis < 3; axis++) {
        now.first[axis] = first[axis] * leaf[axis];
        int stop = (last[axis] + 1) * leaf[axis] + 1;
        now.count[axis] = (stop < volume->dims[axis] ? stop : volume->dims[axis]) - now.first[axis];
    }
    return now;
}

/* The next run at or after block `*at`, which becomes the one behind it; false where there is none. */
static bool next_run(ang_gradient_texture *gradients, const ang_volume *volume, const ang_block_grid *grid, size_t *at,
                     run *now) {
    const int *dims = grid->octree->level[0].dims;
    size_t i = *at, width = (size_t)dims[0];
    while (i < grid->blocks && !(grid->visible[i] && !gradients->filled[i])) i++;
    if (i == grid->blocks) return false;
    size_t row = i / width, end = i;
    while (end < (row + 1) * width && grid->visible[end] && !gradients->filled[end]) {
        gradients->filled[end++] = 1;
        gradients->blocks_filled++;
    }
    *now = make_run(volume, grid, (int)(i % width), (int)(i % width + (end - i)), (int)(row % (size_t)dims[1]),
                    (int)(row / (size_t)dims[1]));
    *at = end;
    return true;
}

bool ang_gradient_texture_update(ang_gradient_texture *gradients, ang_gl *gl, const ang_volume *volume,
                                 const ang_block_grid *grid, int threads, ang_error *err) {
    double start = ang_now_ms();
    gradients->build_ms = 0;
    if (!gradients->texture && !make(gradients, gl, volume, grid, err)) {
        ang_gradient_texture_destroy(gradients);
        return false;
    }
    size_t most_runs = grid->blocks < 4096 ? grid->blocks : 4096;
    size_t longest = (size_t)(volume->dims[0] + 1) * 9 * 9;
    run *runs = ang_alloc(most_runs, sizeof *runs, "rows of gradients", err);
    uint16_t(*texels)[4] = ang_alloc(batch_texels + longest, sizeof *texels, "gradients on their way", err);
    bool ok = runs && texels;
    glBindTexture(GL_TEXTURE_3D, gradients->texture);
    for (size_t at = 0; ok && at < grid->blocks;) {
        size_t count = 0, used = 0;
        while (count < most_runs && used < batch_texels && next_run(gradients, volume, grid, &at, &runs[count])) {
            run *now = &runs[count++];
            now->offset = used;
            used += (size_t)now->count[0] * (size_t)now->count[1] * (size_t)now->count[2];
        }
        if (count == 0) break;
        job work = {volume, runs, texels, 32767 / gradients->range};
        ang_parallel_for(count, 16, threads, fill_run, &work);
        upload(runs, count, texels);
        gradients->bytes += used * sizeof *texels;
        gradients->build_ms = ang_now_ms() - start;
    }
    glBindTexture(GL_TEXTURE_3D, 0);
    free(runs);
    free(texels);
    ok = ok && ang_gl_check(gl, err);
    /* Blocks count as filled already. */
    if (!ok) ang_gradient_texture_destroy(gradients);
    return ok;
}

void ang_gradient_texture_bind(const ang_gradient_texture *gradients, unsigned program, int unit) {
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_3D, gradients->texture);
    ang_uniform_int(program, "gradient_values", unit);
    ang_uniform_float(program, "gradient_range", 65535.0 / 32767 * gradients->range);
}

void ang_gradient_texture_destroy(ang_gradient_texture *gradients) {
    if (gradients->texture) glDeleteTextures(1, &gradients->texture);
    free(gradients->filled);
    *gradients = (ang_gradient_texture){0};
}
