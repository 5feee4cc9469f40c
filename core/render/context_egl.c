#include "core/render/context_private.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef EGL_PLATFORM_DEVICE_EXT
#define EGL_PLATFORM_DEVICE_EXT 0x313F
#endif
#ifndef EGL_PLATFORM_SURFACELESS_MESA
#define EGL_PLATFORM_SURFACELESS_MESA 0x31DD
#endif

enum { MAX_DEVICES = 64 };

typedef struct egl {
    void *library;
    EGLDisplay display;
    EGLContext context;
    __typeof__(eglGetProcAddress) *get_proc_address;
    __typeof__(eglGetError) *get_error;
    __typeof__(eglQueryString) *query_string;
    __typeof__(eglInitialize) *initialize;
    __typeof__(eglTerminate) *terminate;
    __typeof__(eglReleaseThread) *release_thread;
    __typeof__(eglBindAPI) *bind_api;
    __typeof__(eglChooseConfig) *choose_config;
    __typeof__(eglCreateContext) *create_context;
    __typeof__(eglDestroyContext) *destroy_context;
    __typeof__(eglMakeCurrent) *make_current;
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display;
    PFNEGLQUERYDEVICESEXTPROC query_devices;            /* NULL: devices cannot be listed */
    PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string; /* NULL: devices cannot be told apart */
    bool surfaceless;                                   /* the surfaceless platform exists */
} egl;

/* A whole word of a list of extensions, since some names begin others. */
static bool has(const char *extensions, const char *name) {
    size_t length = strlen(name);
    for (const char *at = extensions; at && (at = strstr(at, name)); at += length)
        if ((at == extensions || at[-1] == ' ') && (at[length] == ' ' || at[length] == 0)) return true;
    return false;
}

static void close_display(egl *state) {
    if (state->display == EGL_NO_DISPLAY) return;
    state->make_current(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (state->context != EGL_NO_CONTEXT) state->destroy_context(state->display, state->context);
    state->terminate(state->display);
    state->release_thread();
    state->context = EGL_NO_CONTEXT;
    state->display = EGL_NO_DISPLAY;
}

static void close_library(egl *state) {
    close_display(state);
    if (state->library) dlclose(state->library);
    free(state);
}

static void close_egl(ang_gl *gl) {
    close_library(gl->state);
    gl->state = NULL;
}

static bool open_library(egl *state, ang_gl_attempts *attempts) {
    /* NODELETE: drivers keep thread-local state and exit handlers that do not survive being unloaded. */
    state->library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!state->library) {
        ang_gl_attempt_failed(attempts, "egl: libEGL.so.1 cannot be opened");
        return false;
    }
    void *lib = state->library;
    if (!ang_gl_find(lib, "eglGetProcAddress", &state->get_proc_address) ||
        !ang_gl_find(lib, "eglGetError", &state->get_error) ||
        !ang_gl_find(lib, "eglQueryString", &state->query_string) ||
        !ang_gl_find(lib, "eglInitialize", &state->initialize) ||
        !ang_gl_find(lib, "eglTerminate", &state->terminate) ||
        !ang_gl_find(lib, "eglReleaseThread", &state->release_thread) ||
        !ang_gl_find(lib, "eglBindAPI", &state->bind_api) ||
        !ang_gl_find(lib, "eglChooseConfig", &state->choose_config) ||
        !ang_gl_find(lib, "eglCreateContext", &state->create_context) ||
        !ang_gl_find(lib, "eglDestroyContext", &state->destroy_context) ||
        !ang_gl_find(lib, "eglMakeCurrent", &state->make_current)) {
        ang_gl_attempt_failed(attempts, "egl: libEGL.so.1 lacks a function");
        return false;
    }
    const char *extensions = state->query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!extensions || !has(extensions, "EGL_EXT_platform_base")) {
        ang_gl_attempt_failed(attempts, "egl: no EGL_EXT_platform_base (no driver, or too old)");
        return false;
    }
    state->get_platform_display = (PFNEGLGETPLATFORMDISPLAYEXTPROC)state->get_proc_address("eglGetPlatformDisplayEXT");
    bool base = has(extensions, "EGL_EXT_device_base");
    if (has(extensions, "EGL_EXT_platform_device")) {
        if (base || has(extensions, "EGL_EXT_device_enumeration"))
            state->query_devices = (PFNEGLQUERYDEVICESEXTPROC)state->get_proc_address("eglQueryDevicesEXT");
        if (base || has(extensions, "EGL_EXT_device_query"))
            state->query_device_string =
                (PFNEGLQUERYDEVICESTRINGEXTPROC)state->get_proc_address("eglQueryDeviceStringEXT");
    }
    state->surfaceless = has(extensions, "EGL_MESA_platform_surfaceless");
    return true;
}

static EGLContext make_context(egl *state, EGLConfig config, EGLint minor, bool egl_1_5) {
    /* The value is EGL_TRUE for the one and EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR for the other: 1 for both. */
    const EGLint debug = egl_1_5 ? EGL_CONTEXT_OPENGL_DEBUG : EGL_CONTEXT_FLAGS_KHR;
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 minor,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 debug,
                                 EGL_TRUE,
                                 EGL_NONE};
    return state->create_context(state->display, config, EGL_NO_CONTEXT, attributes);
}

/* Opens one display and makes a context on it current; `who` names the display. */
static bool open_display(egl *state, EGLenum platform, void *native, const char *who, ang_gl_attempts *attempts) {
    EGLint major = 0, minor = 0;
    state->display = state->get_platform_display(platform, native, NULL);
    if (state->display == EGL_NO_DISPLAY || !state->initialize(state->display, &major, &minor)) {
        ang_gl_attempt_failed(attempts, "%s: not initialised (EGL error 0x%04x)", who, (unsigned)state->get_error());
        return false;
    }
    const char *extensions = state->query_string(state->display, EGL_EXTENSIONS);
    bool egl_1_5 = major > 1 || (major == 1 && minor >= 5);
    if ((!egl_1_5 && !has(extensions, "EGL_KHR_create_context")) || !has(extensions, "EGL_KHR_surfaceless_context")) {
        ang_gl_attempt_failed(attempts, "%s: no EGL_KHR_create_context or EGL_KHR_surfaceless_context", who);
        return false;
    }
    if (!state->bind_api(EGL_OPENGL_API)) {
        ang_gl_attempt_failed(attempts, "%s: no desktop OpenGL", who);
        return false;
    }
    EGLConfig config = NULL; /* EGL_NO_CONFIG_KHR */
    if (!has(extensions, "EGL_KHR_no_config_context")) {
        const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
        EGLint count = 0;
        if (!state->choose_config(state->display, wanted, &config, 1, &count) || count < 1) {
            ang_gl_attempt_failed(attempts, "%s: no configuration for OpenGL", who);
            return false;
        }
    }
    state->context = make_context(state, config, 5, egl_1_5);
    if (state->context == EGL_NO_CONTEXT) state->context = make_context(state, config, 3, egl_1_5);
    if (state->context == EGL_NO_CONTEXT) {
        ang_gl_attempt_failed(attempts, "%s: no GL 4.3 core context (EGL error 0x%04x)", who,
                              (unsigned)state->get_error());
        return false;
    }
    if (!state->make_current(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state->context)) {
        ang_gl_attempt_failed(attempts, "%s: the context cannot be made current (EGL error 0x%04x)", who,
                              (unsigned)state->get_error());
        return false;
    }
    return true;
}

/* One display and the kind of renderer wanted on it. */
static bool try_display(ang_gl *gl, egl *state, EGLenum platform, void *native, const char *who, ang_egl_kind kind,
                        ang_gl_attempts *attempts) {
    bool opened =
        open_display(state, platform, native, who, attempts) && ang_gl_load(gl, state->get_proc_address, who, attempts);
    if (opened && kind == ANG_EGL_GPU && ang_gl_is_software(gl)) {
        ang_gl_attempt_failed(attempts, "%s: no GPU behind it (%s)", who, gl->renderer);
        opened = false;
    }
    if (!opened) close_display(state);
    return opened;
}

static bool try_devices(ang_gl *gl, egl *state, ang_egl_kind kind, ang_gl_attempts *attempts) {
    EGLDeviceEXT devices[MAX_DEVICES];
    EGLint count = 0;
    if (!state->query_devices || !state->query_devices(MAX_DEVICES, devices, &count)) return false;
    int tried = 0;
    for (EGLint i = 0; i < count; i++) {
        const char *extensions =
            state->query_device_string ? state->query_device_string(devices[i], EGL_EXTENSIONS) : NULL;
        bool software = extensions && has(extensions, "EGL_MESA_device_software");
        if (software != (kind == ANG_EGL_SOFTWARE)) continue;
        tried++;
        char who[32];
        snprintf(who, sizeof who, "egl device %d", (int)i);
        if (try_display(gl, state, EGL_PLATFORM_DEVICE_EXT, devices[i], who, kind, attempts)) {
            gl->words = "egl, device";
            return true;
        }
    }
    if (tried == 0)
        ang_gl_attempt_failed(attempts, "egl: no %s among %d devices",
                              kind == ANG_EGL_GPU ? "GPU" : "software renderer", (int)count);
    return false;
}

static bool try_surfaceless(ang_gl *gl, egl *state, ang_egl_kind kind, ang_gl_attempts *attempts) {
    /* Where devices can be listed, a GPU would have been among them. */
    if (kind == ANG_EGL_GPU && state->query_devices) return false;
    if (!state->surfaceless) {
        ang_gl_attempt_failed(attempts, "egl surfaceless: not offered");
        return false;
    }
    if (!try_display(gl, state, EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "egl surfaceless", kind, attempts))
        return false;
    gl->words = "egl, surfaceless";
    return true;
}

bool ang_gl_open_egl(ang_gl *gl, ang_egl_kind kind, ang_gl_attempts *attempts) {
    egl *state = calloc(1, sizeof *state);
    if (!state) {
        ang_gl_attempt_failed(attempts, "egl: out of memory");
        return false;
    }
    state->display = EGL_NO_DISPLAY;
    state->context = EGL_NO_CONTEXT;
    if (!open_library(state, attempts) ||
        (!try_devices(gl, state, kind, attempts) && !try_surfaceless(gl, state, kind, attempts))) {
        close_library(state);
        return false;
    }
    gl->state = state;
    gl->close = close_egl;
    return true;
}
