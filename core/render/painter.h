/* Draws flat, textured triangles onto the window: all that a user interface needs of OpenGL. */
#ifndef ANG_RENDER_PAINTER_H
#define ANG_RENDER_PAINTER_H

#include "core/base/error.h"
#include "core/render/context.h"

#include <stddef.h>
#include <stdint.h>

/* Place in pixels from the window's left top corner, place in the texture (0..1, from its left top corner), and colour:
 * bytes r, g, b, a in memory, not premultiplied; multiplied with the texture's. */
typedef struct ang_paint_vertex {
    float x, y, u, v;
    uint32_t colour;
} ang_paint_vertex;

/* Triangles that share a texture and a clip rectangle (left, top, right, bottom in pixels). */
typedef struct ang_paint_command {
    float clip[4];
    unsigned texture; /* ang_paint_texture's name */
    uint32_t first_index, index_count;
    uint32_t first_vertex; /* is added to the indices */
} ang_paint_command;

/* Borrows its arrays. */
typedef struct ang_paint_list {
    const ang_paint_vertex *vertices;
    const uint16_t *indices;
    const ang_paint_command *commands;
    size_t vertex_count, index_count, command_count;
} ang_paint_list;

/* A picture to paint with. Zero-initialise; free with ang_painter_forget. */
typedef struct ang_paint_texture {
    unsigned name; /* 0: none yet */
    int width, height;
} ang_paint_texture;

typedef struct ang_painter ang_painter;

/* All calls from the thread where the context is current. NULL with ANG_GL, ANG_LIMIT. */
ang_painter *ang_painter_create(ang_gl *gl, ang_error *err);
void ang_painter_destroy(ang_painter *painter);

/* Makes the texture hold this picture: RGBA bytes, rows from the top. `smooth`: pixels are blended where it is drawn
 * larger or smaller. False with ANG_LIMIT or ANG_GL; the texture is then as before or empty. */
bool ang_painter_picture(ang_painter *painter, ang_paint_texture *texture, int width, int height, const uint8_t *rgba,
                         bool smooth, ang_error *err);
void ang_painter_forget(ang_painter *painter, ang_paint_texture *texture);

/* Fills the window of width x height pixels with a colour (r, g, b in 0..1). */
void ang_painter_clear(ang_painter *painter, int width, int height, const float colour[3]);
/* Paints over what is there, in the order of the commands. */
void ang_painter_draw(ang_painter *painter, const ang_paint_list *list);
/* Reads what has been painted since the last clear: RGB bytes, rows from the top, `rgb` with room for them. To be
 * called before the window shows it. */
void ang_painter_read(ang_painter *painter, uint8_t *rgb);
/* False and ANG_GL, ANG_LIMIT where OpenGL has complained since the last call. */
bool ang_painter_check(ang_painter *painter, ang_error *err);

#endif
