/* A group of tests run on every backend that is here. */
#ifndef ANG_TESTS_CORE_BACKENDS_H
#define ANG_TESTS_CORE_BACKENDS_H

#include "tests/core/fixtures.h"

#include "core/render/context.h"

/* `*state` is the context, NULL where the backend is not here. */
#define open_gl(state)                                                                                                 \
    ang_gl *gl = *(state);                                                                                             \
    if (!gl) skip()

static inline int open_backend(void **state, ang_backend backend) {
    ang_error err = {0};
    *state = ang_gl_create(backend, &err);
    if (!*state) print_message("no %s here: %s\n", ang_backend_name(backend), err.message);
#ifdef ANG_WITH_OSMESA
    if (!*state && backend == ANG_BACKEND_OSMESA) return -1;
#endif
    return 0;
}
static inline int open_osmesa(void **state) { return open_backend(state, ANG_BACKEND_OSMESA); }
static inline int open_egl(void **state) { return open_backend(state, ANG_BACKEND_EGL); }
static inline int close_backend(void **state) {
    ang_gl_destroy(*state);
    return 0;
}

/* Runs the tests of an array on OSMesa and on EGL. */
#define run_on_backends(tests)                                                                                         \
    (cmocka_run_group_tests_name("osmesa", tests, open_osmesa, close_backend) +                                        \
     cmocka_run_group_tests_name("egl", tests, open_egl, close_backend))

#endif
