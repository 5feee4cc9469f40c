#include "core/render/envelope_hull.h"

#include "core/render/pixel_pad.h"
#include "core/render/scene_parts.h"

#include <glad/gl.h>
#include <shaders.h>
#include <stdlib.h>
#include <string.h>

void ang_envelope_hull_destroy(ang_envelope_hull *hull) {
    if (hull->capture) glDeleteProgram(hull->capture);
    if (hull->active) glDeleteTextures(1, &hull->active);
    if (hull->list) glDeleteTextures(1, &hull->list);
    if (hull->buffer) glDeleteBuffers(1, &hull->buffer);
    if (hull->feedback) glDeleteTransformFeedbacks(1, &hull->feedback);
    if (hull->query) glDeleteQueries(1, &hull->query);
    if (hull->framebuffer) glDeleteFramebuffers(1, &hull->framebuffer);
    if (hull->arrays) glDeleteVertexArrays(1, &hull->arrays);
    ang_target_destroy(&hull->range);
    ang_hull_cells_clear(&hull->cells);
    *hull = (ang_envelope_hull){0};
}

static bool make_objects(ang_envelope_hull *hull, ang_error *err) {
    ang_shader_source vertex = {.count = 0}, geometry = {.count = 0};
    ANG_SHADER_ADD(&vertex, version);
    ANG_SHADER_ADD(&vertex, hull_cells);
    ANG_SHADER_ADD(&geometry, version);
    ANG_SHADER_ADD(&geometry, hull_faces);
    hull->capture = ang_program_capture("envelope", &vertex, &geometry, "hull_face", err);
    if (!hull->capture) return false;
    glGenBuffers(1, &hull->buffer);
    glGenTextures(1, &hull->list);
    glGenTransformFeedbacks(1, &hull->feedback);
    glGenQueries(1, &hull->query);
    glGenVertexArrays(1, &hull->arrays);
    glGenFramebuffers(1, &hull->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, hull->framebuffer);
    glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
    glFramebufferParameteri(GL_FRAMEBUFFER, GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return true;
}

/* The blocks of the clip box, [first, end). */
static void clip_blocks(const ang_block_grid *grid, const ang_ray_frame *frame, int first[3], int end[3]) {
    const ang_octree *octree = grid->octree;
    for (int axis = 0; axis < 3; axis++) {
        double start = -0.5 * octree->cells[axis], leaf = octree->leaf[axis];
        int blocks = octree->level[0].dims[axis];
        first[axis] = (int)fmin(fmax(floor((ang_vec3_at(frame->lower, axis) - start) / leaf), 0), blocks - 1);
        end[axis] = (int)fmin(fmax(ceil((ang_vec3_at(frame->upper, axis) - start) / leaf), first[axis] + 1), blocks);
    }
}

static void upload_cells(ang_envelope_hull *hull) {
    const int *dims = hull->cells.dims;
    if (hull->active) glDeleteTextures(1, &hull->active);
    glGenTextures(1, &hull->active);
    glBindTexture(GL_TEXTURE_3D, hull->active);
    glTexStorage3D(GL_TEXTURE_3D, 1, GL_R8UI, dims[0], dims[1], dims[2]);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, 0, dims[0], dims[1], dims[2], GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                    hull->cells.active);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glBindTexture(GL_TEXTURE_3D, 0);
}

/* Captures the faces; how many there are is known before. */
static bool capture_faces(ang_envelope_hull *hull, ang_gl *gl, ang_error *err) {
    const int *dims = hull->cells.dims;
    glBindBuffer(GL_TEXTURE_BUFFER, hull->buffer);
    glBufferData(GL_TEXTURE_BUFFER, (GLsizeiptr)(hull->cells.faces * sizeof(uint32_t)), NULL, GL_DYNAMIC_COPY);
    glBindBuffer(GL_TEXTURE_BUFFER, 0);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, hull->feedback);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, hull->buffer);
    glUseProgram(hull->capture);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_3D, hull->active);
    ang_uniform_int(hull->capture, "hull_active", 0);
    glBindFramebuffer(GL_FRAMEBUFFER, hull->framebuffer);
    glEnable(GL_RASTERIZER_DISCARD);
    glBindVertexArray(hull->arrays);
    glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, hull->query);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, dims[0] * dims[1] * dims[2]);
    glEndTransformFeedback();
    glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
    glDisable(GL_RASTERIZER_DISCARD);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glBindVertexArray(0);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    glBindTexture(GL_TEXTURE_3D, 0);
    glUseProgram(0);
    GLuint written = 0;
    glGetQueryObjectuiv(hull->query, GL_QUERY_RESULT, &written);
    if (written != hull->cells.faces)
        return ang_fail(err, ANG_GL, "OpenGL (%s) captured %u of %zu faces of the envelope; choose --method singlepass",
                        ang_gl_renderer(gl), written, hull->cells.faces);
    hull->faces = written;
    glBindTexture(GL_TEXTURE_BUFFER, hull->list);
    glTexBuffer(GL_TEXTURE_BUFFER, GL_R32UI, hull->buffer);
    glBindTexture(GL_TEXTURE_BUFFER, 0);
    return ang_gl_check(gl, err);
}

bool ang_envelope_hull_update(ang_envelope_hull *hull, ang_gl *gl, const ang_block_grid *grid,
                              const ang_ray_frame *frame, size_t budget, ang_error *err) {
    int first[3], end[3];
    clip_blocks(grid, frame, first, end);
    hull->made_now = false;
    if (hull->changes == grid->changes && hull->budget == budget && memcmp(first, hull->first, sizeof first) == 0 &&
        memcmp(end, hull->end, sizeof end) == 0)
        return true;
    hull->faces = 0;
    hull->changes = 0;
    if (!hull->capture && !make_objects(hull, err)) return false;
    if (!ang_hull_cells_make(&hull->cells, grid->octree->level[0].dims, grid->visible, first, end, budget, err))
        return false;
    if (hull->cells.side > 0 && hull->cells.faces > 0) {
        upload_cells(hull);
        if (!capture_faces(hull, gl, err)) return false;
    }
    hull->made_now = true;
    hull->changes = grid->changes;
    hull->budget = budget;
    memcpy(hull->first, first, sizeof first);
    memcpy(hull->end, end, sizeof end);
    return true;
}

void ang_envelope_hull_parts(ang_shader_source *vertex, ang_shader_source *fragment, bool cuts) {
    ANG_SHADER_ADD(vertex, version);
    ANG_SHADER_ADD(vertex, hull_expand);
    ANG_SHADER_ADD(fragment, version);
    ANG_SHADER_ADD(fragment, limit_none); /* the pass that reads the ranges ends its rays itself */
    ang_parts_half_space(fragment, cuts); /* ranges are measured from where rays enter */
    ANG_SHADER_ADD(fragment, ray);
    ANG_SHADER_ADD(fragment, hull_range);
}

static void set_uniforms(const ang_envelope_hull *hull, GLuint program, const ang_block_grid *grid,
                         const ang_ray_frame *frame, int width, int height) {
    const ang_octree *octree = grid->octree;
    ang_uniforms_ray(program, frame);
    ang_clip_space space = ang_clip_space_make(frame, width, height);
    ang_uniforms_clip_space(program, &space);
    ang_vec3 start = {-0.5 * octree->cells[0], -0.5 * octree->cells[1], -0.5 * octree->cells[2]};
    ang_vec3 leaf = {octree->leaf[0], octree->leaf[1], octree->leaf[2]};
    ang_uniform_vec3(program, "hull_origin", start);
    ang_uniform_vec3(program, "hull_side", ang_vec3_scale(leaf, hull->cells.side));
    ang_pixel_pad pad = ang_pixel_pad_make(frame);
    ang_uniform_vec3(program, "hull_pad_index", pad.index);
    /* mm for each of w, which is mm from the eye in perspective and 1 in parallel projection. */
    glProgramUniform2f(program, glGetUniformLocation(program, "hull_pad"),
                       (float)(frame->perspective ? pad.rounding : pad.pixel + pad.rounding),
                       (float)(frame->perspective ? pad.growth : 0));
    ang_uniform_int(program, "hull_list", 0);
}

bool ang_envelope_hull_draw(ang_envelope_hull *hull, ang_gl *gl, unsigned program, const ang_block_grid *grid,
                            const ang_ray_frame *frame, int width, int height, ang_error *err) {
    if (!ang_target_resize(&hull->range, gl, width, height, 0, err)) return false;
    glBindFramebuffer(GL_FRAMEBUFFER, hull->range.framebuffer);
    glViewport(0, 0, width, height);
    glDisable(GL_SCISSOR_TEST);
    const float nothing[4] = {1e30f, 1e30f, 1e30f, 0};
    glClearBufferfv(GL_COLOR, 0, nothing);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_MIN);
    glUseProgram(program);
    set_uniforms(hull, program, grid, frame, width, height);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_BUFFER, hull->list);
    glBindVertexArray(hull->arrays);
    glDrawArrays(GL_TRIANGLES, 0, (GLsizei)(6 * hull->faces));
    glBindVertexArray(0);
    glBindTexture(GL_TEXTURE_BUFFER, 0);
    glUseProgram(0);
    glDisable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return ang_gl_check(gl, err);
}

void ang_envelope_hull_bind(const ang_envelope_hull *hull, unsigned program, int unit) {
    glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
    glBindTexture(GL_TEXTURE_2D, hull->range.colour);
    ang_uniform_int(program, "envelope_range", unit);
}
