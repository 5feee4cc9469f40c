/* OpenGL contexts behind one interface: without a window, or a window's. */
#ifndef ANG_RENDER_CONTEXT_H
#define ANG_RENDER_CONTEXT_H

#include "core/base/error.h"
#include "core/base/notes.h"

#include <stdbool.h>

typedef struct ang_gl ang_gl;

typedef enum ang_backend { ANG_BACKEND_AUTO, ANG_BACKEND_EGL, ANG_BACKEND_OSMESA, ANG_BACKEND_NONE } ang_backend;

/* Names as in --backend (auto, egl, osmesa, none); -1 where there is no such backend. */
const char *ang_backend_name(ang_backend backend);
int ang_backend_from_name(const char *name);

/* A context of GL >= 4.3 core, current on the calling thread, functions loaded. AUTO tries EGL on a GPU, OSMesa, EGL in
 * software, in this order. NULL with ANG_GL and a message that says what was tried and why each failed. The libraries
 * are opened only when a backend is tried. One context at a time may be current in the process. */
ang_gl *ang_gl_create(ang_backend backend, ang_error *err);
/* The same on a GPU alone; NULL where none answers, which is found out without the libraries of OpenGL in software. */
ang_gl *ang_gl_create_on_gpu(void);
/* The same for a context that a window system has made current and goes on owning: `lookup` finds its functions,
 * `words` (static) names it as ang_gl_backend says it. NULL with ANG_GL where it is below 4.3. */
typedef void (*ang_gl_function)(void);
typedef ang_gl_function (*ang_gl_lookup)(const char *name);
ang_gl *ang_gl_adopt(ang_gl_lookup lookup, const char *words, ang_error *err);
/* An adopted context stays with its owner, who must destroy it later than this. */
void ang_gl_destroy(ang_gl *gl);

/* GL_RENDERER and GL_VERSION, and the backend in words ("egl, device", "egl, surfaceless", "osmesa"). Owned by `gl`. */
const char *ang_gl_renderer(const ang_gl *gl);
const char *ang_gl_version(const ang_gl *gl);
const char *ang_gl_backend(const ang_gl *gl);
/* False and ANG_GL with the driver's words where a GL debug message of type error has arrived since the last call. */
bool ang_gl_check(ang_gl *gl, ang_error *err);
/* Whether GL_RENDERER names a rasteriser on the CPU. */
bool ang_gl_is_software(const ang_gl *gl);
/* The largest 3D texture side. */
int ang_gl_max_texture_3d(const ang_gl *gl);
/* The largest buffer texture, in texels. */
int ang_gl_max_texture_buffer(const ang_gl *gl);

#endif
