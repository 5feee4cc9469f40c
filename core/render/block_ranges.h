/* The least and greatest value of every block of a volume, and which of these show something in a scene, as textures:
 * Krueger & Westermann 2003, section 2.3. Include only within core/render/ and its tests. */
#ifndef ANG_RENDER_BLOCK_RANGES_H
#define ANG_RENDER_BLOCK_RANGES_H

#include "core/plan/block_box.h"
#include "core/plan/visibility.h"
#include "core/render/context.h"
#include "core/render/program.h"

enum { ANG_BLOCK_LEVELS = 256 };

/* Zero-initialise; owns all. Blocks are the leaves of the octree, 8^3 cells, with an apron of one voxel: every value
 * that interpolation gives inside a block lies in its range. */
typedef struct ang_block_ranges {
    ang_octree *octree;       /* NULL before the first update */
    unsigned ranges;          /* 3D, GL_RG16, one texel a block */
    unsigned shows;           /* 2D, GL_R8: ANG_BLOCK_LEVELS^2, by quantised least (x) and greatest value (y) */
    uint8_t *table;           /* what `shows` holds: 255 or 0 */
    uint16_t lowest;          /* the least stored value of the volume, padding included... */
    uint16_t highest;         /* ... and the greatest */
    size_t blocks, shown;     /* all, and those that the table says show something */
    ang_block_box box;        /* of those that show something */
    double build_ms;          /* of the last update: the octree */
    uint64_t tables_uploaded; /* rises when the table changes */
} ang_block_ranges;

/* The table for values from `lowest` to `highest`. Entry (a, b), at a + ANG_BLOCK_LEVELS b, is 255 where any range
 * whose ends are quantised to a (down) and b (up) may show something, else 0. Pure. */
void ang_block_table(const ang_visibility *visibility, uint16_t lowest, uint16_t highest, uint8_t *table);
/* The entry of a range, as raycast_blocks.glsl finds it. Pure. */
size_t ang_block_entry(uint16_t lowest, uint16_t highest, ang_minmax range);

/* Brings both textures up to date. False with ANG_LIMIT or ANG_GL. */
bool ang_block_ranges_update(ang_block_ranges *ranges, ang_gl *gl, const ang_volume *volume,
                             const ang_visibility *visibility, int threads, ang_error *err);
/* The context must be current. */
void ang_block_ranges_destroy(ang_block_ranges *ranges);

/* raycast_blocks.glsl; binds the textures to texture units `unit` and `unit` + 1. `centre`: the box's, voxel index. */
void ang_block_ranges_bind(const ang_block_ranges *ranges, unsigned program, int unit, ang_vec3 centre);

#endif
