#include "core/render/context_private.h"

#include "core/base/memory.h"

#include <dlfcn.h>
#include <glad/gl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const backend_names[] = {"auto", "egl", "osmesa", "none"};

const char *ang_backend_name(ang_backend backend) {
    size_t i = (size_t)backend;
    return i < sizeof backend_names / sizeof *backend_names ? backend_names[i] : NULL;
}

int ang_backend_from_name(const char *name) {
    for (size_t i = 0; i < sizeof backend_names / sizeof *backend_names; i++)
        if (strcmp(name, backend_names[i]) == 0) return (int)i;
    return -1;
}

void ang_gl_attempt_failed(ang_gl_attempts *attempts, const char *format, ...) {
    char reason[256];
    va_list args;
    va_start(args, format);
    vsnprintf(reason, sizeof reason, format, args);
    va_end(args);
    /* A library that cannot be opened fails both for GPUs and for software. */
    if (strstr(attempts->text, reason)) return;
    size_t used = strlen(attempts->text);
    snprintf(attempts->text + used, sizeof attempts->text - used, "%s%s", used > 0 ? "; " : "", reason);
}

static void GLAD_API_PTR remember_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                          const GLchar *message, const void *user) {
    (void)source;
    (void)id;
    (void)severity;
    (void)length;
    /* The GL interface passes the pointer through as const; it is our own, writable object. */
    ang_gl *gl = (ang_gl *)(uintptr_t)user;
    if (type != GL_DEBUG_TYPE_ERROR || gl->complaint[0]) return;
    snprintf(gl->complaint, sizeof gl->complaint, "%s", message);
    gl->complaint[strcspn(gl->complaint, "\r\n")] = 0;
}

static GLADapiproc load_function(void *lookup, const char *name) {
    ang_gl_lookup *find = lookup;
    return (*find)(name);
}

bool ang_gl_load(ang_gl *gl, ang_gl_lookup lookup, const char *who, ang_gl_attempts *attempts) {
    int version = gladLoadGLUserPtr(load_function, &lookup);
    if (version == 0) {
        ang_gl_attempt_failed(attempts, "%s: the GL functions could not be loaded", who);
        return false;
    }
    if (version < GLAD_MAKE_VERSION(4, 3)) {
        ang_gl_attempt_failed(attempts, "%s: GL %d.%d is below 4.3", who, GLAD_VERSION_MAJOR(version),
                              GLAD_VERSION_MINOR(version));
        return false;
    }
    snprintf(gl->renderer, sizeof gl->renderer, "%s", (const char *)glGetString(GL_RENDERER));
    snprintf(gl->version, sizeof gl->version, "%s", (const char *)glGetString(GL_VERSION));
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &gl->max_texture_3d);
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &gl->max_texture_buffer);
    gl->complaint[0] = 0;
    glEnable(GL_DEBUG_OUTPUT);
    /* Otherwise drivers may call back from another thread, beside ang_gl_check. */
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, NULL, GL_FALSE);
    glDebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, NULL, GL_TRUE);
    glDebugMessageCallback(remember_message, gl);
    return true;
}

bool ang_gl_find(void *library, const char *name, void *function) {
    /* POSIX lets a function pointer be stored through a pointer to void *. */
    *(void **)function = dlsym(library, name);
    return *(void **)function != NULL;
}

bool ang_gl_is_software(const ang_gl *gl) {
    static const char *const rasterisers[] = {"llvmpipe", "softpipe", "swrast", "SwiftShader", "Software Rasterizer"};
    for (size_t i = 0; i < sizeof rasterisers / sizeof *rasterisers; i++)
        if (strstr(gl->renderer, rasterisers[i])) return true;
    return false;
}

/* What to install for a backend; NULL where this build cannot use it. */
static const char *packages_for(bool egl, bool osmesa) {
#ifndef ANG_WITH_OSMESA
    osmesa = false;
#endif
    return egl && osmesa ? "libegl1 or libosmesa6" : egl ? "libegl1" : osmesa ? "libosmesa6" : NULL;
}

ang_gl *ang_gl_create(ang_backend backend, ang_error *err) {
    ang_gl *gl = ang_alloc(1, sizeof *gl, "the GL context", err);
    if (!gl) return NULL;
    ang_gl_attempts attempts = {""};
    bool egl = backend == ANG_BACKEND_AUTO || backend == ANG_BACKEND_EGL;
    bool osmesa = backend == ANG_BACKEND_AUTO || backend == ANG_BACKEND_OSMESA;
    if (egl && ang_gl_open_egl(gl, ANG_EGL_GPU, &attempts)) return gl;
    if (osmesa && ang_gl_open_osmesa(gl, &attempts)) return gl;
    if (egl && ang_gl_open_egl(gl, ANG_EGL_SOFTWARE, &attempts)) return gl;
    free(gl);
    const char *packages = packages_for(egl, osmesa);
    if (!egl && !osmesa)
        ang_fail(err, ANG_GL, "no OpenGL was asked for: choose --backend auto or --method reference, which needs none");
    else if (packages)
        ang_fail(err, ANG_GL, "no usable OpenGL (%s); install %s, or choose --method reference", attempts.text,
                 packages);
    else
        ang_fail(err, ANG_GL, "no usable OpenGL (%s); choose another --backend or --method reference", attempts.text);
    return NULL;
}

ang_gl *ang_gl_create_on_gpu(void) {
    ang_gl *gl = ang_alloc(1, sizeof *gl, "the GL context", NULL);
    ang_gl_attempts attempts = {""};
    if (gl && ang_gl_open_egl(gl, ANG_EGL_GPU, &attempts)) return gl;
    free(gl);
    return NULL;
}

static void leave_to_owner(ang_gl *gl) { (void)gl; }

ang_gl *ang_gl_adopt(ang_gl_lookup lookup, const char *words, ang_error *err) {
    ang_gl *gl = ang_alloc(1, sizeof *gl, "the GL context", err);
    if (!gl) return NULL;
    ang_gl_attempts attempts = {""};
    gl->words = words;
    gl->close = leave_to_owner;
    if (ang_gl_load(gl, lookup, words, &attempts)) return gl;
    free(gl);
    ang_fail(err, ANG_GL, "no usable OpenGL for a window (%s)", attempts.text);
    return NULL;
}

void ang_gl_destroy(ang_gl *gl) {
    if (!gl) return;
    glDebugMessageCallback(NULL, NULL);
    gl->close(gl);
    free(gl);
}

const char *ang_gl_renderer(const ang_gl *gl) { return gl->renderer; }
const char *ang_gl_version(const ang_gl *gl) { return gl->version; }
const char *ang_gl_backend(const ang_gl *gl) { return gl->words; }
int ang_gl_max_texture_3d(const ang_gl *gl) { return gl->max_texture_3d; }
int ang_gl_max_texture_buffer(const ang_gl *gl) { return gl->max_texture_buffer; }

bool ang_gl_check(ang_gl *gl, ang_error *err) {
    /* Drivers need not report errors as messages outside debug contexts; OSMesa has no such contexts. */
    GLenum code = glGetError();
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; i++) {
    }
    if (code == GL_NO_ERROR && !gl->complaint[0]) return true;
    if (code == GL_OUT_OF_MEMORY || strstr(gl->complaint, "GL_OUT_OF_MEMORY"))
        ang_fail(err, ANG_LIMIT, "OpenGL (%s) is out of memory: a smaller --size or --gpu-memory may help",
                 gl->renderer);
    else if (gl->complaint[0])
        ang_fail(err, ANG_GL, "OpenGL (%s): %s", gl->renderer, gl->complaint);
    else
        ang_fail(err, ANG_GL, "OpenGL (%s): error 0x%04x", gl->renderer, code);
    gl->complaint[0] = 0;
    return false;
}
