#include "core/scene/object_layer.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/scene/clip_space.h"

#include <stdlib.h>

/* Pixels [x0, x1) x [y0, y1) that may show an object. */
typedef struct pixel_box {
    int x0, y0, x1, y1;
} pixel_box;

typedef struct layer_job {
    ang_object_layer *layer;
    const ang_volume *volume;
    const ang_scene *scene;
    const ang_ray_frame *frame;
    const pixel_box *boxes; /* one an object */
} layer_job;

static void fill_rows(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    const layer_job *job = context;
    const ang_objects *objects = job->scene->objects;
    for (size_t y = begin; y < end; y++) {
        float *limit = job->layer->limit_mm + y * (size_t)job->layer->width;
        float *colour = job->layer->colour + 3 * y * (size_t)job->layer->width;
        for (int x = 0; x < job->layer->width; x++) limit[x] = ANG_NO_LIMIT;
        for (size_t i = 0; i < objects->count; i++) {
            const pixel_box *box = &job->boxes[i];
            if ((int)y < box->y0 || (int)y >= box->y1) continue;
            for (int x = box->x0; x < box->x1; x++) {
                double t = (double)limit[x], seen[3];
                if (!ang_object_hit(&objects->object[i], job->volume, job->scene, job->frame, x + 0.5, (double)y + 0.5,
                                    &t, seen))
                    continue;
                limit[x] = (float)t;
                for (int c = 0; c < 3; c++) colour[3 * x + c] = (float)seen[c];
            }
        }
    }
}

/* The eight corners of what holds the object, in index space about the box's centre. */
static void object_corners(const ang_object *object, const ang_volume *volume, const ang_ray_frame *frame,
                           ang_vec3 corner[8]) {
    ang_vec3 lower, upper;
    if (object->kind == ANG_OBJECT_PLANE) {
        ang_volume_box(volume, &lower, &upper);
        double *ends[2][3] = {{&lower.x, &lower.y, &lower.z}, {&upper.x, &upper.y, &upper.z}};
        *ends[0][object->axis] = *ends[1][object->axis] = object->index;
        for (int i = 0; i < 8; i++)
            corner[i] = ang_vec3_sub(
                (ang_vec3){i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z},
                frame->centre);
        return;
    }
    ang_vec3 a = object->from, b = object->to, middle = ang_volume_centre(volume);
    double r = object->radius_mm;
    lower = (ang_vec3){fmin(a.x, b.x) - r, fmin(a.y, b.y) - r, fmin(a.z, b.z) - r};
    upper = (ang_vec3){fmax(a.x, b.x) + r, fmax(a.y, b.y) + r, fmax(a.z, b.z) + r};
    for (int i = 0; i < 8; i++) {
        ang_vec3 at = {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z};
        corner[i] = ang_mat4_direction(&frame->to_index, ang_vec3_sub(at, middle));
    }
}

/* Where the object may show; the whole picture where some of it lies beside or behind the eye. */
static pixel_box box_of(const ang_object *object, const layer_job *job, const ang_clip_space *space) {
    int width = job->layer->width, height = job->layer->height;
    const pixel_box all = {0, 0, width, height};
    ang_vec3 corner[8];
    object_corners(object, job->volume, job->frame, corner);
    double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
    for (int i = 0; i < 8; i++) {
        double w = ang_linear_form_at(&space->w, corner[i]);
        if (!(w > 0)) return all;
        double x = 0.5 * width * (1 + ang_linear_form_at(&space->x, corner[i]) / w);
        double y = 0.5 * height * (1 + ang_linear_form_at(&space->y, corner[i]) / w);
        x0 = fmin(x0, x);
        x1 = fmax(x1, x);
        y0 = fmin(y0, y);
        y1 = fmax(y1, y);
    }
    return (pixel_box){(int)fmin(fmax(floor(x0 - 1), 0), width), (int)fmin(fmax(floor(y0 - 1), 0), height),
                       (int)fmax(fmin(ceil(x1 + 1), width), 0), (int)fmax(fmin(ceil(y1 + 1), height), 0)};
}

static bool resize(ang_object_layer *layer, int width, int height, ang_error *err) {
    if (layer->limit_mm && layer->width == width && layer->height == height) return true;
    ang_object_layer_clear(layer);
    size_t pixels = (size_t)width * (size_t)height;
    layer->limit_mm = ang_alloc(pixels, sizeof *layer->limit_mm, "the objects of the scene", err);
    layer->colour =
        layer->limit_mm ? ang_alloc(3 * pixels, sizeof *layer->colour, "the objects of the scene", err) : NULL;
    layer->width = width;
    layer->height = height;
    if (layer->colour) return true;
    ang_object_layer_clear(layer);
    return false;
}

bool ang_object_layer_make(ang_object_layer *layer, const ang_volume *volume, const ang_scene *scene,
                           const ang_ray_frame *frame, int threads, ang_error *err) {
    size_t count = scene->objects->count;
    pixel_box *boxes = ang_alloc(count, sizeof *boxes, "the objects of the scene", err);
    bool ok = boxes && resize(layer, scene->width, scene->height, err);
    layer_job job = {layer, volume, scene, frame, boxes};
    if (ok) {
        ang_clip_space space = ang_clip_space_make(frame, scene->width, scene->height);
        for (size_t i = 0; i < count; i++) boxes[i] = box_of(&scene->objects->object[i], &job, &space);
        ang_parallel_for((size_t)scene->height, 8, threads, fill_rows, &job);
    }
    free(boxes);
    return ok;
}

void ang_object_layer_clear(ang_object_layer *layer) {
    free(layer->limit_mm);
    free(layer->colour);
    *layer = (ang_object_layer){0};
}

void ang_object_layer_join(const ang_object_layer *layer, const ang_scene *scene, ang_image *image) {
    bool under = ang_scene_limits_rays(scene);
    for (size_t i = 0; i < (size_t)layer->width * (size_t)layer->height; i++) {
        if (!(layer->limit_mm[i] < ANG_NO_LIMIT)) continue;
        float *rgba = image->rgba + 4 * i, through = under ? 1 - rgba[3] : 1;
        for (int c = 0; c < 3; c++) rgba[c] = (under ? rgba[c] : 0) + through * layer->colour[3 * i + (size_t)c];
        rgba[3] = 1;
    }
}
