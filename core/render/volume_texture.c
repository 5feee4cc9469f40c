#include "core/render/volume_texture.h"

#include "core/base/memory.h"

#include <glad/gl.h>
#include <stdlib.h>

/* Bytes handed to GL at once: drivers copy what they get. */
static const size_t slab_bytes = (size_t)64 << 20;

typedef void slab_fill(const ang_volume *volume, size_t first, size_t count, uint16_t *out);

static bool fits(ang_gl *gl, const ang_volume *volume, ang_error *err) {
    const int *dims = volume->dims;
    int limit = ang_gl_max_texture_3d(gl);
    for (int axis = 0; axis < 3; axis++)
        if (dims[axis] > limit)
            return ang_fail(
                err, ANG_LIMIT,
                "volume of %dx%dx%d voxels: this OpenGL (%s) takes at most %d a side; clip or resample it, or "
                "choose --method reference",
                dims[0], dims[1], dims[2], ang_gl_renderer(gl), limit);
    GLint width = 0;
    glTexImage3D(GL_PROXY_TEXTURE_3D, 0, GL_R16, dims[0], dims[1], dims[2], 0, GL_RED, GL_UNSIGNED_SHORT, NULL);
    glGetTexLevelParameteriv(GL_PROXY_TEXTURE_3D, 0, GL_TEXTURE_WIDTH, &width);
    if (width != dims[0])
        return ang_fail(
            err, ANG_LIMIT,
            "volume of %dx%dx%d voxels is larger than this OpenGL (%s) takes; clip or resample it, or choose "
            "--method reference",
            dims[0], dims[1], dims[2], ang_gl_renderer(gl));
    return true;
}

/* Where `fill` is NULL the volume's own values are uploaded. */
static bool upload(ang_gl *gl, const ang_volume *volume, slab_fill *fill, ang_error *err) {
    size_t slice = (size_t)volume->dims[0] * (size_t)volume->dims[1];
    size_t slices = slab_bytes / sizeof(uint16_t) / slice;
    if (slices < 1) slices = 1;
    if (slices > (size_t)volume->dims[2]) slices = (size_t)volume->dims[2];
    uint16_t *made = NULL;
    if (fill) {
        made = ang_alloc(slices * slice, sizeof *made, "the weight of the padding", err);
        if (!made) return false;
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int z = 0; z < volume->dims[2]; z += (int)slices) {
        int depth = volume->dims[2] - z < (int)slices ? volume->dims[2] - z : (int)slices;
        const uint16_t *from = volume->data + (size_t)z * slice;
        if (fill) {
            fill(volume, (size_t)z * slice, (size_t)depth * slice, made);
            from = made;
        }
        glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, z, volume->dims[0], volume->dims[1], depth, GL_RED, GL_UNSIGNED_SHORT,
                        from);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    free(made);
    ang_error cause;
    if (ang_gl_check(gl, &cause)) return true;
    return ang_fail(err, ANG_LIMIT, "volume of %dx%dx%d voxels could not be uploaded (%.300s); clip or resample it",
                    volume->dims[0], volume->dims[1], volume->dims[2], cause.message);
}

static bool make_texture(unsigned *name, ang_gl *gl, const ang_volume *volume, slab_fill *fill, ang_error *err) {
    if (!ang_gl_check(gl, err) || !fits(gl, volume, err)) return false;
    glGenTextures(1, name);
    glBindTexture(GL_TEXTURE_3D, *name);
    glTexStorage3D(GL_TEXTURE_3D, 1, GL_R16, volume->dims[0], volume->dims[1], volume->dims[2]);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    bool ok = upload(gl, volume, fill, err);
    glBindTexture(GL_TEXTURE_3D, 0);
    if (!ok) {
        glDeleteTextures(1, name);
        *name = 0;
    }
    return ok;
}

static void fill_weight(const ang_volume *volume, size_t first, size_t count, uint16_t *out) {
    for (size_t i = 0; i < count; i++) out[i] = ang_volume_is_padding(volume, first + i) ? 0 : 65535;
}

bool ang_volume_texture_create(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, ang_error *err) {
    return make_texture(&texture->values, gl, volume, NULL, err);
}

bool ang_volume_texture_add_weight(ang_volume_texture *texture, ang_gl *gl, const ang_volume *volume, ang_error *err) {
    if (texture->weight || !volume->padding) return true;
    return make_texture(&texture->weight, gl, volume, fill_weight, err);
}

void ang_volume_texture_destroy(ang_volume_texture *texture) {
    if (texture->values) glDeleteTextures(1, &texture->values);
    if (texture->weight) glDeleteTextures(1, &texture->weight);
    *texture = (ang_volume_texture){0};
}
