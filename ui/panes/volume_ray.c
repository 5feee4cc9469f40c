#include "ui/panes/volume_ray.h"

#include "core/scene/annotation.h"
#include "ui/viewer_private.h"

#include <math.h>

bool ang_volume_pick(ang_viewer *viewer, double x, double y, ang_vec3 *mm) {
    const ang_volume *volume = viewer->study.volume;
    const ang_document *document = &viewer->document;
    ang_volume_picture *picture = &viewer->volume;
    ang_error err = {0};
    ang_ray_frame frame;
    ang_scene scene = ang_volume_scene(viewer, document, picture->transfer, picture->size[0], picture->size[1]);
    if (!picture->transfer || !ang_ray_frame_make(volume, &scene, &frame, &err)) return false;
    ang_ray ray = ang_ray_through(&frame, x, y);
    double step = ang_volume_smallest_spacing(volume) / 2, through = 0, best = 0, chosen = NAN;
    int steps = (int)fmax((ray.leave - ray.enter) / step, 0);
    for (int i = 0; i < steps; i++) {
        double t = ray.enter + (i + 0.5) * step;
        ang_vec3 at = ang_vec3_add(ang_vec3_along(ray.origin, ray.direction, t), frame.centre);
        double hu = ang_volume_hu(volume, ang_volume_sample(volume, at));
        if (document->mode == ANG_MODE_DVR) {
            /* Where half of the light has been stopped, or the most, where less is. */
            double more = ang_transfer_extinction(picture->transfer, hu) * step;
            if (more > best) best = more, chosen = t;
            through += more;
            if (through < M_LN2) continue;
            chosen = t;
            break;
        }
        if (document->mode == ANG_MODE_ISO) {
            if (hu < document->iso_hu) continue;
            chosen = t;
            break;
        }
        double value = document->mode == ANG_MODE_MINIP ? -hu : hu;
        if (isnan(chosen) || value > best) best = value, chosen = t;
    }
    if (isnan(chosen)) return false;
    ang_vec3 index = ang_vec3_add(ang_vec3_along(ray.origin, ray.direction, chosen), frame.centre);
    *mm = ang_mat4_point(&volume->affine, index);
    return true;
}

bool ang_sight_make(const ang_viewer *viewer, int width, int height, ang_sight *sight) {
    const ang_volume *volume = viewer->study.volume;
    const ang_transfer *transfer = viewer->volume.transfer;
    double spacing = ang_volume_smallest_spacing(volume);
    if (!transfer) return false;
    *sight = (ang_sight){.volume = volume,
                         .scene = ang_volume_scene(viewer, &viewer->document, transfer, width, height),
                         .step = spacing,
                         .slack = 2 * spacing};
    return ang_ray_frame_make(volume, &sight->scene, &sight->frame, NULL);
}

/* What of the light from `end` (mm along the ray) comes through. */
static double passes(const ang_sight *sight, const ang_ray *ray, double end) {
    const ang_scene *scene = &sight->scene;
    double through = 0;
    int steps = (int)fmax((end - ray->enter) / sight->step, 0);
    for (int i = 0; i < steps; i++) {
        double t = ray->enter + (i + 0.5) * sight->step;
        ang_vec3 at = ang_vec3_add(ang_vec3_along(ray->origin, ray->direction, t), sight->frame.centre);
        double hu = ang_volume_hu(sight->volume, ang_volume_sample(sight->volume, at));
        if (scene->mode == ANG_MODE_ISO && hu >= scene->iso_hu) return 0;
        if (scene->mode == ANG_MODE_DVR) through += ang_transfer_extinction(scene->transfer, hu) * sight->step;
        if (through > 10) return 0;
    }
    return exp(-through);
}

double ang_sight_share(const ang_sight *sight, ang_vec3 mm, double *x, double *y) {
    double depth;
    if (!ang_annotation_place(&sight->scene, mm, x, y, &depth)) return -1;
    if (sight->scene.mode != ANG_MODE_DVR && sight->scene.mode != ANG_MODE_ISO) return 1;
    const ang_ray_frame *frame = &sight->frame;
    ang_ray ray = ang_ray_through(frame, *x, *y);
    ang_vec3 away = ang_vec3_sub(ang_vec3_sub(ang_mat4_point(&frame->to_index, mm), frame->centre), ray.origin);
    double t = ang_vec3_dot(ang_mat4_direction(&frame->to_mm, away), ray.direction_mm);
    return passes(sight, &ray, fmin(t - sight->slack, ray.leave));
}
