#include "core/render/volume_texture.h"

#include "core/base/memory.h"

#include <glad/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Bytes handed to GL at once: drivers copy what they get. */
static const size_t slab_bytes = (size_t)64 << 20;

/* Writes `depth` planes of the texture, from plane z on, as 16-bit numbers. */
typedef void slab_fill(const ang_volume_texture *texture, const ang_volume *volume, int z, int depth, uint16_t *out);

bool ang_volume_texture_fits(ang_gl *gl, const int dims[3], ang_error *err) {
    int limit = ang_gl_max_texture_3d(gl);
    for (int axis = 0; axis < 3; axis++)
        if (dims[axis] > limit)
            return ang_fail(
                err, ANG_LIMIT,
                "volume of %dx%dx%d voxels: this OpenGL (%s) takes at most %d a side in one texture; --method "
                "slicing takes larger volumes in bricks (more --bricks make them smaller), --method reference as they "
                "are",
                dims[0], dims[1], dims[2], ang_gl_renderer(gl), limit);
    GLint width = 0;
    glTexImage3D(GL_PROXY_TEXTURE_3D, 0, GL_R16, dims[0], dims[1], dims[2], 0, GL_RED, GL_UNSIGNED_SHORT, NULL);
    glGetTexLevelParameteriv(GL_PROXY_TEXTURE_3D, 0, GL_TEXTURE_WIDTH, &width);
    if (width == dims[0]) return true;
    return ang_fail(
        err, ANG_LIMIT,
        "volume of %dx%dx%d voxels is larger than one texture of this OpenGL (%s) may be; --method "
        "slicing takes larger volumes in bricks (more --bricks make them smaller), --method reference as they "
        "are",
        dims[0], dims[1], dims[2], ang_gl_renderer(gl));
}

static bool covers(const ang_volume_texture *texture, const ang_volume *volume) {
    for (int axis = 0; axis < 3; axis++)
        if (texture->first[axis] != 0 || texture->dims[axis] != volume->dims[axis]) return false;
    return true;
}

/* Index of the voxel that texel `i` along an axis shows: beyond the volume its outermost. */
static int clamped(const ang_volume_texture *texture, const ang_volume *volume, int axis, int i) {
    int index = texture->first[axis] + i, last = volume->dims[axis] - 1;
    return index < 0 ? 0 : index > last ? last : index;
}

/* Index in the volume of the first voxel of a row of texels. */
static size_t row_start(const ang_volume_texture *texture, const ang_volume *volume, int y, int z) {
    return (size_t)volume->dims[0] *
           ((size_t)clamped(texture, volume, 1, y) + (size_t)volume->dims[1] * (size_t)clamped(texture, volume, 2, z));
}

static void fill_values(const ang_volume_texture *texture, const ang_volume *volume, int z, int depth, uint16_t *out) {
    int width = texture->dims[0];
    for (int row = 0; row < depth * texture->dims[1]; row++, out += width) {
        const uint16_t *from =
            volume->data + row_start(texture, volume, row % texture->dims[1], z + row / texture->dims[1]);
        int before = texture->first[0] < 0 ? -texture->first[0] : 0;
        int inside = volume->dims[0] - texture->first[0] < width ? volume->dims[0] - texture->first[0] : width;
        for (int x = 0; x < before; x++) out[x] = from[0];
        if (inside > before)
            memcpy(out + before, from + (texture->first[0] + before), (size_t)(inside - before) * sizeof *out);
        for (int x = inside; x < width; x++) out[x] = from[volume->dims[0] - 1];
    }
}

static void fill_weight(const ang_volume_texture *texture, const ang_volume *volume, int z, int depth, uint16_t *out) {
    int width = texture->dims[0];
    for (int row = 0; row < depth * texture->dims[1]; row++, out += width) {
        size_t from = row_start(texture, volume, row % texture->dims[1], z + row / texture->dims[1]);
        for (int x = 0; x < width; x++)
            out[x] = ang_volume_is_padding(volume, from + (size_t)clamped(texture, volume, 0, x)) ? 0 : 65535;
    }
}

static bool check_upload(const ang_volume_texture *texture, ang_gl *gl, ang_error *err) {
    const int *dims = texture->dims;
    ang_error cause;
    if (ang_gl_check(gl, &cause)) return true;
    return ang_fail(err, ANG_LIMIT, "texture of %dx%dx%d voxels could not be uploaded (%.300s); lower --gpu-memory",
                    dims[0], dims[1], dims[2], cause.message);
}

/* Where `fill` is NULL the volume's own values are uploaded as they lie in memory. */
static bool upload(const ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, slab_fill *fill,
                   ang_error *err) {
    const int *dims = texture->dims;
    size_t slice = (size_t)dims[0] * (size_t)dims[1];
    size_t slices = slab_bytes / sizeof(uint16_t) / slice;
    if (slices < 1) slices = 1;
    if (slices > (size_t)dims[2]) slices = (size_t)dims[2];
    uint16_t *made = NULL;
    if (fill) {
        made = ang_alloc(slices * slice, sizeof *made, "voxels on their way to a texture", err);
        if (!made) return false;
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int z = 0; z < dims[2]; z += (int)slices) {
        int depth = dims[2] - z < (int)slices ? dims[2] - z : (int)slices;
        const uint16_t *from = fill ? made : volume->data + (size_t)z * slice;
        if (fill) fill(texture, volume, z, depth, made);
        glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, z, dims[0], dims[1], depth, GL_RED, GL_UNSIGNED_SHORT, from);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    free(made);
    return check_upload(texture, gl, err);
}

static bool reserve(unsigned *name, const ang_volume_texture *texture, ang_gl *gl, ang_error *err) {
    const int *dims = texture->dims;
    if (*name) return true;
    if (!ang_gl_check(gl, err) || !ang_volume_texture_fits(gl, dims, err)) return false;
    glGenTextures(1, name);
    glBindTexture(GL_TEXTURE_3D, *name);
    glTexStorage3D(GL_TEXTURE_3D, 1, GL_R16, dims[0], dims[1], dims[2]);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_3D, 0);
    return true;
}

/* Makes the texture where there is none yet, and fills it. */
static bool make_texture(unsigned *name, const ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume,
                         slab_fill *fill, ang_error *err) {
    if (!reserve(name, texture, gl, err)) return false;
    glBindTexture(GL_TEXTURE_3D, *name);
    bool ok = upload(texture, gl, volume, fill, err);
    glBindTexture(GL_TEXTURE_3D, 0);
    if (!ok) {
        glDeleteTextures(1, name);
        *name = 0;
    }
    return ok;
}

bool ang_volume_texture_create(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, ang_error *err) {
    return ang_volume_texture_reserve(texture, gl, volume, err) &&
           ang_volume_texture_hold(texture, gl, volume, (const int[3]){0, 0, 0}, volume->dims, err);
}

bool ang_volume_texture_reserve(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, ang_error *err) {
    ang_volume_texture_destroy(texture);
    *texture = (ang_volume_texture){.dims = {volume->dims[0], volume->dims[1], volume->dims[2]}};
    return reserve(&texture->values, texture, gl, err) && ang_gl_check(gl, err);
}

/* A box of voxels as it lies in memory. */
static void upload_box(const ang_volume *volume, const int first[3], const int end[3]) {
    const int *dims = volume->dims;
    size_t plane = (size_t)dims[0] * (size_t)dims[1];
    int at_once = (int)fmax((double)slab_bytes / sizeof(uint16_t) / (double)plane, 1);
    for (int z = first[2]; z < end[2]; z += at_once) {
        int depth = end[2] - z < at_once ? end[2] - z : at_once;
        const uint16_t *from = volume->data + (size_t)first[0] + (size_t)dims[0] * (size_t)first[1] + plane * (size_t)z;
        glTexSubImage3D(GL_TEXTURE_3D, 0, first[0], first[1], z, end[0] - first[0], end[1] - first[1], depth, GL_RED,
                        GL_UNSIGNED_SHORT, from);
    }
}

/* What of the box [first, end) lies outside the box [held, held_end) inside it: below and above along z, then y, x. */
static void upload_around(const ang_volume *volume, const int first[3], const int end[3], const int held[3],
                          const int held_end[3]) {
    int from[3] = {first[0], first[1], first[2]}, to[3] = {end[0], end[1], end[2]};
    for (int axis = 2; axis >= 0; axis--) {
        int above[3] = {from[0], from[1], from[2]}, below_end[3] = {to[0], to[1], to[2]};
        below_end[axis] = held[axis];
        above[axis] = held_end[axis];
        if (from[axis] < held[axis]) upload_box(volume, from, below_end);
        if (held_end[axis] < to[axis]) upload_box(volume, above, to);
        from[axis] = held[axis];
        to[axis] = held_end[axis];
    }
}

bool ang_volume_texture_hold(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, const int first[3],
                             const int end[3], ang_error *err) {
    int from[3], to[3], *held = texture->held_first, *held_end = texture->held_end;
    bool empty = held_end[0] <= held[0], grows = false;
    for (int axis = 0; axis < 3; axis++) {
        from[axis] = first[axis] > 0 ? first[axis] : 0;
        to[axis] = end[axis] < volume->dims[axis] ? end[axis] : volume->dims[axis];
        if (to[axis] <= from[axis]) return true;
        if (!empty && held[axis] < from[axis]) from[axis] = held[axis];
        if (!empty && held_end[axis] > to[axis]) to[axis] = held_end[axis];
        grows = grows || empty || from[axis] < held[axis] || to[axis] > held_end[axis];
    }
    if (!grows) return true;
    glBindTexture(GL_TEXTURE_3D, texture->values);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, volume->dims[0]);
    glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, volume->dims[1]);
    if (empty)
        upload_box(volume, from, to);
    else
        upload_around(volume, from, to, held, held_end);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, 0);
    glBindTexture(GL_TEXTURE_3D, 0);
    if (!check_upload(texture, gl, err)) return false;
    memcpy(held, from, sizeof from);
    memcpy(held_end, to, sizeof to);
    return true;
}

bool ang_volume_texture_set_part(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, const int first[3],
                                 const int dims[3], ang_error *err) {
    bool keep = true;
    for (int axis = 0; axis < 3; axis++) keep = keep && texture->dims[axis] == dims[axis];
    if (!keep) ang_volume_texture_destroy(texture);
    for (int axis = 0; axis < 3; axis++) {
        texture->first[axis] = first[axis];
        texture->dims[axis] = dims[axis];
    }
    slab_fill *fill = covers(texture, volume) ? NULL : fill_values;
    if (!make_texture(&texture->values, texture, gl, volume, fill, err)) return false;
    return !texture->weight || make_texture(&texture->weight, texture, gl, volume, fill_weight, err);
}

bool ang_volume_texture_add_weight(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, ang_error *err) {
    if (texture->weight || !volume->padding) return true;
    return make_texture(&texture->weight, texture, gl, volume, fill_weight, err);
}

void ang_volume_texture_destroy(ang_volume_texture *texture) {
    if (texture->values) glDeleteTextures(1, &texture->values);
    if (texture->weight) glDeleteTextures(1, &texture->weight);
    *texture = (ang_volume_texture){0};
}
