#include "core/render/context_private.h"

#ifdef ANG_WITH_OSMESA

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

/* From GL/osmesa.h, which is absent where only the library is installed. */
enum {
    OSMESA_RGBA = 0x1908,
    OSMESA_FORMAT = 0x22,
    OSMESA_DEPTH_BITS = 0x30,
    OSMESA_PROFILE = 0x33,
    OSMESA_CORE_PROFILE = 0x34,
    OSMESA_CONTEXT_MAJOR_VERSION = 0x36,
    OSMESA_CONTEXT_MINOR_VERSION = 0x37,
    UNSIGNED_BYTE = 0x1401,
    BUFFER_SIDE = 16,
};

typedef struct osmesa {
    void *library;
    void *context;
    void *(*create)(const int *attributes, void *share);
    void (*destroy)(void *context);
    unsigned char (*make_current)(void *context, void *buffer, unsigned type, int width, int height);
    ang_gl_function (*lookup)(const char *name);
    /* OSMesa draws into memory of ours; we only ever draw into framebuffer objects. */
    unsigned char buffer[BUFFER_SIDE * BUFFER_SIDE * 4];
} osmesa;

static void close_library(osmesa *state) {
    if (state->context) {
        state->make_current(NULL, NULL, UNSIGNED_BYTE, 0, 0);
        state->destroy(state->context);
    }
    if (state->library) dlclose(state->library);
    free(state);
}

static void close_osmesa(ang_gl *gl) {
    close_library(gl->state);
    gl->state = NULL;
}

static bool open_library(osmesa *state, ang_gl_attempts *attempts) {
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
    /* NODELETE: Mesa and LLVM keep thread-local state and exit handlers that do not survive being unloaded. */
    for (size_t i = 0; i < sizeof names / sizeof *names && !state->library; i++)
        state->library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!state->library) {
        ang_gl_attempt_failed(attempts, "osmesa: libOSMesa.so.8 and libOSMesa.so.6 cannot be opened");
        return false;
    }
    if (ang_gl_find(state->library, "OSMesaCreateContextAttribs", &state->create) &&
        ang_gl_find(state->library, "OSMesaDestroyContext", &state->destroy) &&
        ang_gl_find(state->library, "OSMesaMakeCurrent", &state->make_current) &&
        ang_gl_find(state->library, "OSMesaGetProcAddress", &state->lookup))
        return true;
    ang_gl_attempt_failed(attempts, "osmesa: the library lacks a function (too old)");
    return false;
}

static bool make_context(osmesa *state, ang_gl_attempts *attempts) {
    static const int minors[] = {5, 3};
    for (size_t i = 0; i < sizeof minors / sizeof *minors && !state->context; i++) {
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_DEPTH_BITS,
                                  0,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  4,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  minors[i],
                                  0};
        state->context = state->create(attributes, NULL);
    }
    if (!state->context) {
        ang_gl_attempt_failed(attempts, "osmesa: no GL 4.3 core context");
        return false;
    }
    if (state->make_current(state->context, state->buffer, UNSIGNED_BYTE, BUFFER_SIDE, BUFFER_SIDE)) return true;
    ang_gl_attempt_failed(attempts, "osmesa: the context cannot be made current");
    return false;
}

bool ang_gl_open_osmesa(ang_gl *gl, ang_gl_attempts *attempts) {
    osmesa *state = calloc(1, sizeof *state);
    if (!state) {
        ang_gl_attempt_failed(attempts, "osmesa: out of memory");
        return false;
    }
    if (!open_library(state, attempts) || !make_context(state, attempts) ||
        !ang_gl_load(gl, state->lookup, "osmesa", attempts)) {
        close_library(state);
        return false;
    }
    gl->words = "osmesa";
    gl->state = state;
    gl->close = close_osmesa;
    return true;
}

#else

bool ang_gl_open_osmesa(ang_gl *gl, ang_gl_attempts *attempts) {
    (void)gl;
    ang_gl_attempt_failed(attempts, "osmesa: left out of this build");
    return false;
}

#endif
