#include "core/render/leaf_ranges.h"

#include "core/render/program.h"

#include <glad/gl.h>
#include <shaders.h>

_Static_assert(sizeof(ang_minmax) == sizeof(uint32_t), "a range is what the shader packs: min low, max high");

bool ang_leaf_ranges_fit(const int dims[3]) {
    GLint64 most = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    return (GLint64)dims[0] * dims[1] * dims[2] * (GLint64)sizeof(ang_minmax) <= most;
}

bool ang_leaf_ranges_compute(ang_gl *gl, const ang_volume_texture *field, ang_octree *octree, ang_error *err) {
    enum { GROUP = 4 };
    ang_shader_source source = {.count = 0};
    ANG_SHADER_ADD(&source, version);
    ANG_SHADER_ADD(&source, leaf_ranges);
    GLuint program = ang_program_compute("leaf ranges", &source, err), buffer = 0;
    if (!program) return false;
    const int *dims = octree->level[0].dims, *leaf = octree->leaf;
    GLsizeiptr bytes = (GLsizeiptr)((size_t)dims[0] * (size_t)dims[1] * (size_t)dims[2] * sizeof(ang_minmax));
    glGenBuffers(1, &buffer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    glBufferData(GL_SHADER_STORAGE_BUFFER, bytes, NULL, GL_STREAM_READ);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_3D, field->values);
    ang_uniform_int(program, "field_values", 0);
    glProgramUniform3i(program, glGetUniformLocation(program, "leaf_cells"), leaf[0], leaf[1], leaf[2]);
    glProgramUniform3i(program, glGetUniformLocation(program, "leaf_count"), dims[0], dims[1], dims[2]);
    glUseProgram(program);
    glDispatchCompute((GLuint)(dims[0] + GROUP - 1) / GROUP, (GLuint)(dims[1] + GROUP - 1) / GROUP,
                      (GLuint)(dims[2] + GROUP - 1) / GROUP);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, bytes, octree->level[0].nodes);
    glUseProgram(0);
    glBindTexture(GL_TEXTURE_3D, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, 0);
    glDeleteBuffers(1, &buffer);
    glDeleteProgram(program);
    return ang_gl_check(gl, err);
}
