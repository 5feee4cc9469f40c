/* GL programs put together from small GLSL parts, and their uniforms. Include only within core/render/ and its tests.
 */
#ifndef ANG_RENDER_PROGRAM_H
#define ANG_RENDER_PROGRAM_H

#include "core/base/error.h"
#include "core/math/vec.h"
#include "core/plan/plan.h"
#include "core/render/context.h"

#include <stddef.h>
#include <stdint.h>

/* A piece of GLSL; its name appears in error messages. Borrows both strings. */
typedef struct ang_shader_part {
    const char *name;
    const char *text;
} ang_shader_part;

enum { ANG_SHADER_PARTS = 48 };

/* One shader: its parts in order, the first with the #version line. */
typedef struct ang_shader_source {
    ang_shader_part parts[ANG_SHADER_PARTS];
    int count;
    bool full; /* a part had no room: no program is made of this */
} ang_shader_source;

/* Appends an embedded file: ANG_SHADER_ADD(&source, dvr) for shaders/dvr.glsl; "shaders.h" must be included. */
#define ANG_SHADER_ADD(source, file) ang_shader_add(source, #file ".glsl", ang_shader_##file)
void ang_shader_add(ang_shader_source *source, const char *name, const char *text);

/* Adds a pass with the names of its parts to the plan. */
void ang_shader_explain(ang_plan *plan, const char *pass, const ang_shader_source *vertex,
                        const ang_shader_source *fragment, int lookups);

/* Programs already linked, by the hash of their text. Zero-initialise; owns the programs. */
typedef struct ang_programs {
    struct ang_program_entry *entries;
    size_t count;
} ang_programs;

/* The program of these shaders, linked now or before; valid until ang_programs_clear. 0 with
 * ANG_GL naming the part and line that does not compile, or with ANG_LIMIT. */
unsigned ang_programs_get(ang_programs *programs, const char *title, const ang_shader_source *vertex,
                          const ang_shader_source *fragment, ang_error *err);
/* A program without fragments whose points are captured: `geometry` gives one varying, `capture`, of one word a point.
 * The caller deletes it. 0 as above. */
unsigned ang_program_capture(const char *title, const ang_shader_source *vertex, const ang_shader_source *geometry,
                             const char *capture, ang_error *err);
/* A compute program, which the caller deletes. 0 as above. */
unsigned ang_program_compute(const char *title, const ang_shader_source *compute, ang_error *err);
/* Deletes all programs; the context must be current. */
void ang_programs_clear(ang_programs *programs);

/* Set a uniform by name; one that the compiler found unused is passed over. */
void ang_uniform_int(unsigned program, const char *name, int value);
void ang_uniform_float(unsigned program, const char *name, double value);
void ang_uniform_vec3(unsigned program, const char *name, ang_vec3 value);
/* `v` and, as the fourth, `w`. */
void ang_uniform_vec4(unsigned program, const char *name, ang_vec3 v, double w);
/* An array of `count` ints. */
void ang_uniform_ints(unsigned program, const char *name, const int *values, int count);
/* The transposed linear part of `a` times `scale`, as a mat3. */
void ang_uniform_transposed(unsigned program, const char *name, const ang_mat4 *a, double scale);

#endif
