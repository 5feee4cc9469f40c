#include "core/render/filtering.h"

#include "core/render/program.h"

#include <glad/gl.h>
#include <math.h>
#include <shaders.h>

/* More probes than 2^16 lie in no step of 16 bits twice; a power of two is exact in float. */
enum { PROBES = 1 << 17, GROUP = 64, MOST_BITS = 16 };

static GLuint make_texture(void) {
    static const GLushort texels[2] = {0, 65535};
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_3D, texture);
    glTexStorage3D(GL_TEXTURE_3D, 1, GL_R16, 2, 1, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, 0, 2, 1, 1, GL_RED, GL_UNSIGNED_SHORT, texels);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    return texture;
}

static double greatest_deviation(const float *probes) {
    double greatest = 0;
    /* Not by fmax: GCC 12 fails inside on this loop for ARM64. */
    for (int i = 0; i < PROBES; i++) {
        double off = fabs((double)probes[i] - (i + 0.5) / PROBES);
        if (off > greatest) greatest = off;
    }
    return greatest;
}

int ang_gl_filter_bits(ang_gl *gl, double *deviation, ang_error *err) {
    ang_shader_source source = {.count = 0};
    ANG_SHADER_ADD(&source, version);
    ANG_SHADER_ADD(&source, filter_probe);
    GLuint program = ang_program_compute("filter probe", &source, err), buffer = 0;
    if (!program) return 0;
    GLuint texture = make_texture();
    glGenBuffers(1, &buffer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    glBufferData(GL_SHADER_STORAGE_BUFFER, PROBES * sizeof(float), NULL, GL_STREAM_READ);
    ang_uniform_int(program, "field_values", 0);
    ang_uniform_int(program, "probe_count", PROBES);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_3D, texture);
    glUseProgram(program);
    glDispatchCompute(PROBES / GROUP, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const float *probes = glMapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, PROBES * sizeof(float), GL_MAP_READ_BIT);
    double greatest = probes ? greatest_deviation(probes) : (double)NAN;
    if (probes) glUnmapBuffer(GL_SHADER_STORAGE_BUFFER);
    glUseProgram(0);
    glBindTexture(GL_TEXTURE_3D, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, 0);
    glDeleteBuffers(1, &buffer);
    glDeleteTextures(1, &texture);
    glDeleteProgram(program);
    if (!ang_gl_check(gl, err)) return 0;
    if (!(greatest < 0.5)) {
        ang_fail(err, ANG_GL, "the texture unit does not interpolate between texels of 16 bits");
        return 0;
    }
    if (deviation) *deviation = greatest;
    /* An eighth of a bit for the rounding of what is read. */
    double bits = greatest > 0 ? floor(-log2(2 * greatest) + 0.125) : MOST_BITS;
    return bits > MOST_BITS ? MOST_BITS : bits < 1 ? 1 : (int)bits;
}
