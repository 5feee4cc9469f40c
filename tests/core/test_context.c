/* Contexts on every backend that is here, and what the volume's texture gives back. */
#include "tests/core/fixtures.h"

#include "core/render/context.h"
#include "core/render/scene_parts.h"
#include "core/render/target.h"

#include <glad/gl.h>
#include <string.h>

/* From shaders/, embedded; tests see no generated headers. */
extern const char ang_shader_version[], ang_shader_triangle[], ang_shader_field[], ang_shader_trilinear[],
    ang_shader_field_manual[], ang_shader_field_hardware[], ang_shader_stored_exact[];

static const ang_backend backends[] = {ANG_BACKEND_OSMESA, ANG_BACKEND_EGL};
enum { backend_count = sizeof backends / sizeof *backends };

/* NULL where the backend is not here. */
static ang_gl *open_backend(ang_backend backend) {
    ang_error err = {0};
    ang_gl *gl = ang_gl_create(backend, &err);
    if (gl) return gl;
#ifdef ANG_WITH_OSMESA
    if (backend == ANG_BACKEND_OSMESA) fail_msg("this build has OSMesa, but: %s", err.message);
#endif
    print_message("no %s here: %s\n", ang_backend_name(backend), err.message);
    assert_int_equal(err.code, ANG_GL);
    assert_non_null(strstr(err.message, ang_backend_name(backend)));
    return NULL;
}

static void advice_can_be_followed(void **state) {
    (void)state;
    ang_error err = {0};
    assert_null(ang_gl_create(ANG_BACKEND_NONE, &err));
    assert_int_equal(err.code, ANG_GL);
    assert_non_null(strstr(err.message, "--method reference"));
#ifndef ANG_WITH_OSMESA
    assert_null(ang_gl_create(ANG_BACKEND_OSMESA, &err));
    assert_non_null(strstr(err.message, "left out of this build"));
    assert_null(strstr(err.message, "install"));
#endif
}

static void backend_names_round_trip(void **state) {
    (void)state;
    for (int i = ANG_BACKEND_AUTO; i <= ANG_BACKEND_NONE; i++)
        assert_int_equal(ang_backend_from_name(ang_backend_name((ang_backend)i)), i);
    assert_int_equal(ang_backend_from_name("glx"), -1);
    ang_error err = {0};
    assert_null(ang_gl_create(ANG_BACKEND_NONE, &err));
    assert_int_equal(err.code, ANG_GL);
}

static void contexts_come_and_go_in_turns(void **state) {
    (void)state;
    int opened = 0;
    for (int round = 0; round < 3; round++)
        for (int b = 0; b < backend_count; b++) {
            ang_gl *gl = open_backend(backends[b]);
            if (!gl) continue;
            if (round == 0)
                print_message("%s: %s, GL %s\n", ang_gl_backend(gl), ang_gl_renderer(gl), ang_gl_version(gl));
            assert_memory_equal(ang_gl_backend(gl), ang_backend_name(backends[b]), 3);
            assert_true(ang_gl_max_texture_3d(gl) >= 2048);
            assert_true(ang_gl_max_texture_buffer(gl) >= 65536);
            assert_true(ang_gl_check(gl, NULL));
            ang_gl_destroy(gl);
            opened++;
        }
    ang_gl *gl = open_backend(ANG_BACKEND_AUTO);
    assert_true((gl != NULL) == (opened > 0));
    ang_gl_destroy(gl);
    ang_gl_destroy(NULL);
}

static void errors_are_noticed_once(void **state) {
    (void)state;
    for (int b = 0; b < backend_count; b++) {
        ang_gl *gl = open_backend(backends[b]);
        if (!gl) continue;
        ang_error err = {0};
        assert_true(ang_gl_check(gl, &err));
        glBindTexture(0xdead, 0);
        glEnable(0xbeef);
        assert_false(ang_gl_check(gl, &err));
        assert_int_equal(err.code, ANG_GL);
        assert_non_null(strstr(err.message, ang_gl_renderer(gl)));
        assert_true(ang_gl_check(gl, &err));
        ang_gl_destroy(gl);
    }
}

static void a_wrong_shader_is_named(void **state) {
    (void)state;
    for (int b = 0; b < backend_count; b++) {
        ang_gl *gl = open_backend(backends[b]);
        if (!gl) continue;
        ang_programs programs = {0};
        ang_shader_source vertex = {.count = 0}, fragment = {.count = 0};
        ANG_SHADER_ADD(&vertex, version);
        ANG_SHADER_ADD(&vertex, triangle);
        ANG_SHADER_ADD(&fragment, version);
        ang_shader_add(&fragment, "broken.glsl", "void main() {\n    nonsense;\n}\n");
        ang_error err = {0};
        assert_int_equal(ang_programs_get(&programs, "a test", &vertex, &fragment, &err), 0);
        assert_int_equal(err.code, ANG_GL);
        if (!strstr(err.message, "broken.glsl line 2")) fail_msg("%s", err.message);
        assert_non_null(strstr(err.message, "nonsense"));
        fragment.parts[1].text = "void main() {}\n";
        unsigned program = ang_programs_get(&programs, "a test", &vertex, &fragment, &err);
        assert_int_not_equal(program, 0);
        assert_int_equal(ang_programs_get(&programs, "a test", &vertex, &fragment, &err), program);
        assert_int_equal(programs.count, 1);
        ang_programs_clear(&programs);
        ang_gl_destroy(gl);
    }
}

/* Every voxel of `volume` as four floats: fetched, filtered at its centre, and as field_at gives it with the texture
 * unit's and with our interpolation. */
static void read_voxels(ang_gl *gl, const ang_volume *volume, bool manual, ang_image *image) {
    static const char text[] = "layout(location = 0) out vec4 values;\n"
                               "uniform int picture_width;\n"
                               "void main() {\n"
                               "    ivec3 dims = textureSize(field_values, 0);\n"
                               "    int i = int(gl_FragCoord.y) * picture_width + int(gl_FragCoord.x);\n"
                               "    ivec3 voxel = ivec3(i % dims.x, i / dims.x % dims.y, i / (dims.x * dims.y));\n"
                               "    vec3 coordinate = (vec3(voxel) + 0.5) / vec3(dims);\n"
                               "    values = vec4(texelFetch(field_values, voxel, 0).r * 65535.0,\n"
                               "                  textureLod(field_values, coordinate, 0.0).r * 65535.0,\n"
                               "                  stored_from(field_at(vec3(voxel) - 0.5 * vec3(dims - 1))),\n"
                               "                  stored_from(65535.0 * texelFetch(field_values, voxel, 0).r));\n"
                               "}\n";
    ang_error err = {0};
    ang_volume_texture texture = {0};
    ang_target target = {0};
    ang_programs programs = {0};
    if (!ang_volume_texture_create(&texture, gl, volume, &err)) fail_msg("%s", err.message);
    assert_true(ang_target_resize(&target, gl, image->width, image->height, 0, &err));
    ang_shader_source vertex = {.count = 0}, fragment = {.count = 0};
    ANG_SHADER_ADD(&vertex, version);
    ANG_SHADER_ADD(&vertex, triangle);
    ANG_SHADER_ADD(&fragment, version);
    ANG_SHADER_ADD(&fragment, field);
    if (manual) {
        ANG_SHADER_ADD(&fragment, trilinear);
        ANG_SHADER_ADD(&fragment, field_manual);
    } else {
        ANG_SHADER_ADD(&fragment, field_hardware);
    }
    ANG_SHADER_ADD(&fragment, stored_exact);
    ang_shader_add(&fragment, "test", text);
    unsigned program = ang_programs_get(&programs, "a test", &vertex, &fragment, &err);
    if (!program) fail_msg("%s", err.message);
    GLuint vertices;
    glGenVertexArrays(1, &vertices);
    glBindVertexArray(vertices);
    glUseProgram(program);
    ang_scene scene = ang_scene_default(volume);
    ang_ray_frame frame;
    assert_true(ang_ray_frame_make(volume, &scene, &frame, &err));
    ang_uniforms_field(program, &texture, volume, &frame);
    ang_uniform_int(program, "picture_width", image->width);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    glViewport(0, 0, image->width, image->height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    ang_target_read(&target, 0, image->height, image);
    glDeleteVertexArrays(1, &vertices);
    ang_programs_clear(&programs);
    ang_target_destroy(&target);
    ang_volume_texture_destroy(&texture);
    if (!ang_gl_check(gl, &err)) fail_msg("%s", err.message);
}

/* `filter_tolerance`: where the texture unit filters at a voxel's centre, its coordinate is off by float rounding,
 * which lets a neighbour in by that share. */
static void check_voxels(ang_gl *gl, const ang_volume *volume, int width, int height, double filter_tolerance,
                         double field_tolerance) {
    for (int manual = 0; manual < 2; manual++) {
        ang_image image;
        assert_true(ang_image_create(&image, width, height, NULL));
        read_voxels(gl, volume, manual, &image);
        for (size_t i = 0; i < ang_volume_count(volume); i++) {
            const float *values = image.rgba + 4 * i;
            double stored = volume->data[i];
            assert_close(values[0], stored, stored * 2.5e-7);
            assert_close(values[1], stored, filter_tolerance);
            /* What renderers read: whole stored values come back whole. */
            assert_close(values[2], stored, field_tolerance);
            assert_true(values[3] == stored);
        }
        ang_image_clear(&image);
    }
}

static void all_65536_values_are_read_back(void **state) {
    (void)state;
    int dims[3] = {64, 32, 32};
    ang_volume *volume = ang_volume_create(dims, NULL);
    for (int i = 0; i < 65536; i++) volume->data[i] = (uint16_t)i;
    for (int b = 0; b < backend_count; b++) {
        ang_gl *gl = open_backend(backends[b]);
        if (!gl) continue;
        /* Coordinates are exact where the sides are powers of two. */
        check_voxels(gl, volume, 256, 256, 0.02, 0);
        ang_gl_destroy(gl);
    }
    ang_volume_free(volume);
}

static void rows_of_odd_length_are_not_padded(void **state) {
    (void)state;
    int dims[3] = {3, 5, 7};
    ang_volume *volume = ang_volume_create(dims, NULL);
    for (int i = 0; i < 105; i++) volume->data[i] = (uint16_t)(i * 617);
    for (int b = 0; b < backend_count; b++) {
        ang_gl *gl = open_backend(backends[b]);
        if (!gl) continue;
        check_voxels(gl, volume, 15, 7, 0.02, 0.02);
        ang_gl_destroy(gl);
    }
    ang_volume_free(volume);
}

static void volumes_beyond_the_limit_are_refused(void **state) {
    (void)state;
    for (int b = 0; b < backend_count; b++) {
        ang_gl *gl = open_backend(backends[b]);
        if (!gl) continue;
        int dims[3] = {1, ang_gl_max_texture_3d(gl) + 1, 1};
        ang_volume *volume = ang_volume_create(dims, NULL);
        ang_volume_texture texture = {0};
        ang_error err = {0};
        assert_false(ang_volume_texture_create(&texture, gl, volume, &err));
        assert_int_equal(err.code, ANG_LIMIT);
        assert_int_equal(texture.values, 0);
        ang_target target = {0};
        assert_false(ang_target_resize(&target, gl, 1 << 20, 4, 0, &err));
        assert_int_equal(err.code, ANG_LIMIT);
        assert_true(ang_gl_check(gl, NULL));
        ang_volume_free(volume);
        ang_gl_destroy(gl);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(advice_can_be_followed),
        cmocka_unit_test(backend_names_round_trip),
        cmocka_unit_test(contexts_come_and_go_in_turns),
        cmocka_unit_test(errors_are_noticed_once),
        cmocka_unit_test(a_wrong_shader_is_named),
        cmocka_unit_test(all_65536_values_are_read_back),
        cmocka_unit_test(rows_of_odd_length_are_not_padded),
        cmocka_unit_test(volumes_beyond_the_limit_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
