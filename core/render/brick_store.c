#include "core/render/brick_store.h"

#include "core/base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct ang_brick_slot {
    ang_volume_texture texture;
    int node[3];
    uint64_t used;    /* clock when it was asked for last */
    uint64_t picture; /* and which picture that was for */
};

/* Cells a side of a brick: smaller ones share more of their voxels with neighbours, greater ones are left out less
 * often. */
enum { WANTED_CELLS = 128, LEAST_SLOTS = 8 };

static void tell_budget(ang_brick_store *store, size_t bytes) {
    snprintf(store->reason, sizeof store->reason, "its %.1f MB are more than --gpu-memory %.6g", (double)bytes / 1e6,
             (double)store->budget / 1e6);
}

bool ang_brick_store_make(ang_brick_store *store, ang_gl *gl, const ang_volume *volume, size_t budget, ang_error *err) {
    *store = (ang_brick_store){.gl = gl, .volume = volume, .budget = budget};
    size_t bytes = ang_volume_count(volume) * sizeof *volume->data;
    ang_error limit = {0};
    if (budget && bytes > budget)
        tell_budget(store, bytes);
    else if (!ang_volume_texture_fits(gl, volume->dims, &limit))
        snprintf(store->reason, sizeof store->reason, "it is larger than one texture of this OpenGL may be");
    if (store->reason[0]) return true;
    store->whole = true;
    return ang_volume_texture_create(&store->texture, gl, volume, err);
}

static void release_slots(ang_brick_store *store) {
    for (size_t i = 0; i < store->used; i++) ang_volume_texture_destroy(&store->slot[i].texture);
    free(store->slot);
    store->slot = NULL;
    store->slots = store->used = 0;
}

void ang_brick_store_destroy(ang_brick_store *store) {
    ang_volume_texture_destroy(&store->texture);
    release_slots(store);
    *store = (ang_brick_store){0};
}

/* Texels of a brick's texture along each axis, and its bytes: the planes of voxels at both ends belong to it. */
static size_t measure(const ang_octree *octree, int level, ang_brick_needs needs, int dims[3]) {
    size_t bytes = sizeof(uint16_t) * (needs.weight ? 2 : 1);
    for (int axis = 0; axis < 3; axis++) {
        int64_t cells = (int64_t)octree->leaf[axis] << level;
        if (cells > octree->cells[axis]) cells = octree->cells[axis];
        dims[axis] = (int)cells + 1 + 2 * needs.reach;
        bytes *= (size_t)dims[axis];
    }
    return bytes;
}

static bool is_wanted_size(const ang_brick_store *store, const int dims[3], size_t bytes) {
    if (store->budget && bytes > store->budget / LEAST_SLOTS) return false;
    for (int axis = 0; axis < 3; axis++)
        if (dims[axis] > WANTED_CELLS + 1 + 2 * store->needs.reach) return false;
    return ang_volume_texture_fits(store->gl, dims, NULL);
}

bool ang_brick_store_arrange(ang_brick_store *store, const ang_octree *octree, ang_brick_needs needs, ang_error *err) {
    store->picture++;
    size_t with_weight = 2 * ang_volume_count(store->volume) * sizeof *store->volume->data;
    if (store->whole && needs.weight && store->budget && with_weight > store->budget) {
        ang_volume_texture_destroy(&store->texture);
        store->whole = false;
        tell_budget(store, with_weight);
    }
    if (store->whole)
        return !needs.weight || ang_volume_texture_add_weight(&store->texture, store->gl, store->volume, err);
    bool same = store->slot && store->octree && memcmp(store->leaf, octree->leaf, sizeof store->leaf) == 0 &&
                store->needs.reach == needs.reach && store->needs.weight == needs.weight;
    store->octree = octree;
    if (same) return true;
    release_slots(store);
    memcpy(store->leaf, octree->leaf, sizeof store->leaf);
    store->needs = needs;
    store->level = 0;
    for (int level = 1; level < octree->levels; level++) {
        int dims[3];
        size_t bytes = measure(octree, level, needs, dims);
        if (is_wanted_size(store, dims, bytes)) store->level = level;
    }
    size_t bytes = measure(octree, store->level, needs, store->dims);
    if (!ang_volume_texture_fits(store->gl, store->dims, err)) return false;
    if (store->budget && bytes > store->budget)
        return ang_fail(err, ANG_LIMIT,
                        "--gpu-memory %.6g: one brick of the volume takes %.1f MB; give more, or more "
                        "--bricks",
                        (double)store->budget / 1e6, (double)bytes / 1e6);
    const ang_octree_level *nodes = &octree->level[store->level];
    store->slots = (size_t)nodes->dims[0] * (size_t)nodes->dims[1] * (size_t)nodes->dims[2];
    if (store->budget && store->budget / bytes < store->slots) store->slots = store->budget / bytes;
    store->slot = ang_alloc(store->slots, sizeof *store->slot, "list of bricks", err);
    return store->slot != NULL;
}

int ang_brick_store_level(const ang_brick_store *store) { return store->whole ? ANG_OCTREE_MAX_LEVELS : store->level; }

bool ang_brick_store_same(const ang_brick_store *store, int level_a, const int a[3], int level_b, const int b[3]) {
    if (store->whole) return true;
    for (int axis = 0; axis < 3; axis++)
        if (a[axis] >> (store->level - level_a) != b[axis] >> (store->level - level_b)) return false;
    return true;
}

/* Whether the brick in `a` is needed later than that in `b`: one that the last picture did without is not expected at
 * all; then one that this picture is done with, the last one first, since the next picture begins at the other end. */
static bool is_needed_later(const ang_brick_store *store, const struct ang_brick_slot *a,
                            const struct ang_brick_slot *b) {
    bool idle_a = a->picture + 1 < store->picture, idle_b = b->picture + 1 < store->picture;
    if (idle_a != idle_b) return idle_a;
    return idle_a ? a->used < b->used : a->used > b->used;
}

/* A free slot, or the one whose brick is needed last. */
static struct ang_brick_slot *make_room(ang_brick_store *store) {
    if (store->used < store->slots) return &store->slot[store->used++];
    struct ang_brick_slot *last = &store->slot[0];
    for (size_t i = 1; i < store->used; i++)
        if (is_needed_later(store, &store->slot[i], last)) last = &store->slot[i];
    return last;
}

const ang_volume_texture *ang_brick_store_get(ang_brick_store *store, int level, const int node[3], ang_error *err) {
    if (store->whole) return &store->texture;
    int brick[3], first[3], end[3];
    for (int axis = 0; axis < 3; axis++) brick[axis] = node[axis] >> (store->level - level);
    store->clock++;
    for (size_t i = 0; i < store->used; i++)
        if (memcmp(store->slot[i].node, brick, sizeof brick) == 0) {
            store->slot[i].used = store->clock;
            store->slot[i].picture = store->picture;
            return &store->slot[i].texture;
        }
    struct ang_brick_slot *slot = make_room(store);
    memcpy(slot->node, brick, sizeof brick);
    slot->used = store->clock;
    slot->picture = store->picture;
    ang_octree_cells(store->octree, store->level, brick, first, end);
    for (int axis = 0; axis < 3; axis++) first[axis] -= store->needs.reach;
    bool ok = ang_volume_texture_set_part(&slot->texture, store->gl, store->volume, first, store->dims, err) &&
              (!store->needs.weight || ang_volume_texture_add_weight(&slot->texture, store->gl, store->volume, err));
    if (!ok) {
        slot->node[0] = -1; /* no brick */
        return NULL;
    }
    store->uploads++;
    return &slot->texture;
}
