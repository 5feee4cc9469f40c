/* A transfer function on the GL side. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_TABLE_TEXTURE_H
#define ANG_RENDER_TABLE_TEXTURE_H

#include "core/plan/classification.h"
#include "core/render/context.h"
#include "core/render/prefix_texture.h"
#include "core/render/program.h"
#include "core/transfer/table_cache.h"

/* The entries of ang_transfer_tables as a buffer texture of GL_RGBA32F. Zero-initialise; owns all. */
typedef struct ang_table_texture {
    ang_table_cache cache;
    unsigned buffer, texture;
    unsigned extinctions, extinction_texture; /* GL_R32F: extinction alone; where one_colour, else 0 */
    ang_stiffness stiffness;                  /* of the transfer function in the volume, once it has been asked for */
    bool measured;
    ang_classification classification; /* of the last ang_table_texture_classify; of use in mode dvr alone */
    ang_prefix_texture prefix;         /* made when it is first used */
} ang_table_texture;

/* Makes and uploads the tables for this volume where `transfer` is not what they were made from. False with ANG_LIMIT
 * or ANG_GL. */
bool ang_table_texture_update(ang_table_texture *texture, ang_gl *gl, const ang_transfer *transfer,
                              const ang_volume *volume, ang_error *err);
/* Chooses how steps of `step` mm are classified, after ang_table_texture_update with the same transfer function and
 * volume, and makes and uploads prefix integrals where they are used. False with ANG_LIMIT or ANG_GL. */
bool ang_table_texture_classify(ang_table_texture *texture, ang_gl *gl, const ang_transfer *transfer,
                                const ang_volume *volume, ang_classify wanted, double step, ang_error *err);
/* The greatest extinction per mm that a step can have. */
double ang_table_texture_greatest(const ang_table_texture *texture);
/* Deletes everything. The context must be current. */
void ang_table_texture_destroy(ang_table_texture *texture);
/* Sets the uniforms of transfer.glsl and binds the table to texture unit `unit`; for transfer_one.glsl, too, what is
 * there where one_colour, to unit `alone`. */
void ang_table_texture_bind(const ang_table_texture *texture, unsigned program, int unit, int alone);

#endif
