#include "core/render/program.h"

#include <glad/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct ang_program_entry {
    uint64_t hash;
    GLuint program;
};

/* Lines of part i are numbered from PART_LINES i + 1: not every compiler hands on the file numbers of #line. */
enum { LINE_LENGTH = 24, LOG_LENGTH = 2048, PART_LINES = 1000 };

void ang_shader_add(ang_shader_source *source, const char *name, const char *text) {
    source->full |= source->count == ANG_SHADER_PARTS;
    if (!source->full) source->parts[source->count++] = (ang_shader_part){name, text};
}

/* Names without their ending, separated by blanks. */
static void list_parts(const ang_shader_source *source, char *out, size_t size) {
    size_t used = 0;
    out[0] = '\0';
    for (int i = 0; i < source->count; i++) {
        int length = (int)strcspn(source->parts[i].name, ".");
        int written = snprintf(out + used, size - used, "%s%.*s", i ? " " : "", length, source->parts[i].name);
        used += (size_t)written;
        if (used >= size) return;
    }
}

void ang_shader_explain(ang_plan *plan, const char *pass, const ang_shader_source *vertex,
                        const ang_shader_source *fragment, int lookups) {
    char parts[2][512], both[1100];
    list_parts(vertex, parts[0], sizeof parts[0]);
    list_parts(fragment, parts[1], sizeof parts[1]);
    snprintf(both, sizeof both, "%s | %s", parts[0], parts[1]);
    ang_plan_add_pass(plan, pass, both, lookups);
}

/* FNV-1a, 64 bits. */
static uint64_t hash_source(uint64_t hash, const ang_shader_source *source) {
    for (int i = 0; i < source->count; i++)
        for (const char *c = source->parts[i].text; *c; c++) hash = (hash ^ (unsigned char)*c) * 0x100000001b3u;
    return (hash ^ 0xff) * 0x100000001b3u;
}

/* The line of a compiler's log that holds the first error, in place. */
static char *first_error(char *log) {
    char *at = strstr(log, "error");
    if (!at) at = log;
    while (at > log && at[-1] != '\n') at--;
    at[strcspn(at, "\r\n")] = 0;
    return at;
}

static bool compile(GLuint shader, const char *title, const ang_shader_source *source, ang_error *err) {
    const char *strings[2 * ANG_SHADER_PARTS];
    char lines[ANG_SHADER_PARTS][LINE_LENGTH];
    GLsizei count = 0;
    for (int i = 0; i < source->count; i++) {
        snprintf(lines[i], LINE_LENGTH, "#line %d\n", PART_LINES * i + 1);
        if (i > 0) strings[count++] = lines[i];
        strings[count++] = source->parts[i].text;
    }
    glShaderSource(shader, count, strings, NULL);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return true;
    char log[LOG_LENGTH] = "";
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    const char *line = first_error(log);
    /* "file:line(column)" of Mesa and "file(line)" of NVIDIA; the driver's own words follow. */
    int number = 0;
    if (sscanf(line, "%*d%*[:(]%d", &number) != 1) sscanf(line, "ERROR: %*d:%d", &number);
    int part = number / PART_LINES;
    if (part < 0 || part >= source->count) part = 0;
    return ang_fail(err, ANG_GL,
                    "shader of %s does not compile, %s line %d: %.600s; report this with the graphics driver's name",
                    title, source->parts[part].name, number % PART_LINES, line);
}

static bool link_program(GLuint program, const char *title, ang_error *err) {
    glLinkProgram(program);
    GLint ok = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok) return true;
    char log[LOG_LENGTH] = "";
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    return ang_fail(err, ANG_GL, "shaders of %s do not link: %.600s; report this with the graphics driver's name",
                    title, first_error(log));
}

/* A vertex shader (or NULL) and another of `kind`; `capture`: the varying that transform feedback keeps, or NULL. */
static GLuint build(const char *title, const ang_shader_source *vertex, GLenum kind, const ang_shader_source *other,
                    const char *capture, ang_error *err) {
    GLuint program = glCreateProgram();
    GLuint shaders[2] = {glCreateShader(kind), vertex ? glCreateShader(GL_VERTEX_SHADER) : 0};
    bool ok = compile(shaders[0], title, other, err) && (!vertex || compile(shaders[1], title, vertex, err));
    int count = vertex ? 2 : 1;
    if (ok) {
        for (int i = 0; i < count; i++) glAttachShader(program, shaders[i]);
        if (capture) glTransformFeedbackVaryings(program, 1, &capture, GL_INTERLEAVED_ATTRIBS);
        ok = link_program(program, title, err);
        for (int i = 0; i < count; i++) glDetachShader(program, shaders[i]);
    }
    for (int i = 0; i < count; i++) glDeleteShader(shaders[i]);
    if (ok) return program;
    glDeleteProgram(program);
    return 0;
}

unsigned ang_program_compute(const char *title, const ang_shader_source *compute, ang_error *err) {
    return build(title, NULL, GL_COMPUTE_SHADER, compute, NULL, err);
}

unsigned ang_program_capture(const char *title, const ang_shader_source *vertex, const ang_shader_source *geometry,
                             const char *capture, ang_error *err) {
    return build(title, vertex, GL_GEOMETRY_SHADER, geometry, capture, err);
}

unsigned ang_programs_get(ang_programs *programs, const char *title, const ang_shader_source *vertex,
                          const ang_shader_source *fragment, ang_error *err) {
    uint64_t hash = hash_source(hash_source(0xcbf29ce484222325u, vertex), fragment);
    for (size_t i = 0; i < programs->count; i++)
        if (programs->entries[i].hash == hash) return programs->entries[i].program;
    if (vertex->full || fragment->full) {
        ang_fail(err, ANG_GL, "the shaders of %s have more than %d parts; report this", title, ANG_SHADER_PARTS);
        return 0;
    }
    struct ang_program_entry *grown = realloc(programs->entries, (programs->count + 1) * sizeof *grown);
    if (!grown) {
        ang_fail(err, ANG_LIMIT, "out of memory for the programs of %s; close other programs", title);
        return 0;
    }
    programs->entries = grown;
    GLuint program = build(title, vertex, GL_FRAGMENT_SHADER, fragment, NULL, err);
    if (program) grown[programs->count++] = (struct ang_program_entry){hash, program};
    return program;
}

void ang_programs_clear(ang_programs *programs) {
    for (size_t i = 0; i < programs->count; i++) glDeleteProgram(programs->entries[i].program);
    free(programs->entries);
    *programs = (ang_programs){0};
}

void ang_uniform_int(unsigned program, const char *name, int value) {
    glProgramUniform1i(program, glGetUniformLocation(program, name), value);
}

void ang_uniform_float(unsigned program, const char *name, double value) {
    glProgramUniform1f(program, glGetUniformLocation(program, name), (float)value);
}

void ang_uniform_vec3(unsigned program, const char *name, ang_vec3 value) {
    glProgramUniform3f(program, glGetUniformLocation(program, name), (float)value.x, (float)value.y, (float)value.z);
}

void ang_uniform_vec4(unsigned program, const char *name, ang_vec3 v, double w) {
    glProgramUniform4f(program, glGetUniformLocation(program, name), (float)v.x, (float)v.y, (float)v.z, (float)w);
}

void ang_uniform_ints(unsigned program, const char *name, const int *values, int count) {
    glProgramUniform1iv(program, glGetUniformLocation(program, name), count, values);
}

void ang_uniform_transposed(unsigned program, const char *name, const ang_mat4 *a, double scale) {
    /* GL takes columns first, so that rows handed over in order are the transpose. */
    float m[9];
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) m[3 * row + column] = (float)(scale * a->m[row][column]);
    glProgramUniformMatrix3fv(program, glGetUniformLocation(program, name), 1, GL_FALSE, m);
}
