/* What the context backends share; only context*.c include it. */
#ifndef ANG_RENDER_CONTEXT_PRIVATE_H
#define ANG_RENDER_CONTEXT_PRIVATE_H

#include "core/render/context.h"

#include <stddef.h>

struct ang_gl {
    const char *words;       /* the backend in words, static */
    void *state;             /* of the backend */
    void (*close)(ang_gl *); /* releases the context and `state` */
    char renderer[256];
    char version[128];
    char complaint[512]; /* the first debug message of type error since the last check; empty: none */
    int max_texture_3d;
    int max_texture_buffer;
};

/* Why each attempt failed, for the message when none works; cut off where it is full. */
typedef struct ang_gl_attempts {
    char text[768];
} ang_gl_attempts;
void ang_gl_attempt_failed(ang_gl_attempts *attempts, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* After a backend made its context current: loads the functions, refuses GL below 4.3 and reads what it is. The reason
 * goes to `attempts`, led by `who`. */
bool ang_gl_load(ang_gl *gl, ang_gl_lookup lookup, const char *who, ang_gl_attempts *attempts);
/* Stores the address of a library's function through `function`, a pointer to a function pointer; false where the
 * library has none of that name. */
bool ang_gl_find(void *library, const char *name, void *function);

typedef enum ang_egl_kind { ANG_EGL_GPU, ANG_EGL_SOFTWARE } ang_egl_kind;

/* Each makes a context current and loaded, and fills words, state and close; or leaves `gl` closed, nothing current and
 * the reason in `attempts`. Not thread safe. */
bool ang_gl_open_egl(ang_gl *gl, ang_egl_kind kind, ang_gl_attempts *attempts);
bool ang_gl_open_osmesa(ang_gl *gl, ang_gl_attempts *attempts);

#endif
