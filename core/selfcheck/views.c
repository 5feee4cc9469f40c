/* Cameras and grids: the same medium from everywhere, through anisotropic spacing, from inside, and far from the
 * origin. */
#include "core/selfcheck/cases.h"

#include <stdio.h>

/* How far in pixels the silhouette is off at pixel (x, y), which shows the box where it should not, or the reverse: the
 * least distance at which a ray does as the pixel does. */
static double silhouette_error(const ang_stage *stage, double x, double y, bool shown) {
    static const double radii[] = {1 / 16., 1 / 4., 1 / 2., 0.999, 2};
    for (size_t r = 0; r < sizeof radii / sizeof *radii; r++)
        for (int k = 0; k < 16; k++) {
            double angle = k * M_PI / 8;
            if ((ang_stage_length(stage, x + radii[r] * cos(angle), y + radii[r] * sin(angle)) > 0) == shown)
                return radii[r];
        }
    return INFINITY;
}

static bool check_silhouette(ang_stage *stage, const char *where, ang_error *err) {
    if (!ang_stage_draw(stage, err)) return false;
    double greatest = 0;
    for (int i = 0; i < ang_stage_pixels(stage); i++) {
        double x = i % stage->scene.width + 0.5, y = i / stage->scene.width + 0.5;
        bool shown = stage->image.rgba[4 * i + 3] > 0;
        if (shown == (ang_stage_length(stage, x, y) > 0)) continue;
        greatest = fmax(greatest, silhouette_error(stage, x, y, shown));
    }
    ang_bench_error(stage->bench, greatest, 0.999, "pixels that the silhouette is off, %s", where);
    return true;
}

static const double long_voxels[3] = {1, 1, 1000};

static bool silhouettes(ang_stage *stage, ang_error *err) {
    if (!ang_stage_medium(stage, 1, err)) return false;
    ang_stage_look(stage, "left", ANG_PARALLEL);
    stage->scene.camera.half_height = 6;
    if (!check_silhouette(stage, "from the side", err)) return false;
    /* A corner 1.5 m from the centre, large. */
    ang_stage_look(stage, "40,25", ANG_PARALLEL);
    ang_vec3 lower, upper;
    ang_volume_box(stage->volume, &lower, &upper);
    ang_camera *camera = &stage->scene.camera;
    camera->eye = ang_vec3_along(ang_mat4_point(&stage->volume->affine, upper), camera->forward, -camera->focus_mm);
    camera->half_height = 6;
    return check_silhouette(stage, "at a corner", err);
}

/* 1 HU a voxel along x and 1000 along z: in mm a gradient of (1, 0, 1) HU/mm. */
static double oblique_ramp(int x, int y, int z) {
    (void)y;
    return x + 1000 * z;
}

static bool normals(ang_stage *stage, ang_error *err) {
    static const char *const views[] = {"20,10", "70,-30"};
    if (!ang_stage_medium(stage, 0.5, err)) return false;
    ang_scene *scene = &stage->scene;
    scene->shading = ANG_SHADING_PHONG;
    /* The blue channel, whose colour is 1, is then |n . d| alone. */
    scene->phong = (ang_phong){.diffuse = 1, .power = 1, .g0 = 1e-6};
    scene->clip_lower = (ang_vec3){1, 1, 1}; /* at the faces differences are clamped */
    scene->clip_upper = (ang_vec3){6, 2, 4};
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        ang_stage_look(stage, views[v], ANG_PARALLEL);
        scene->camera.half_height = 2;
        if (!ang_stage_draw(stage, err)) return false;
        double expected = acos(fabs(scene->camera.forward.x + scene->camera.forward.z) / sqrt(2)), greatest = 0;
        int seen = 0;
        for (int i = 0; i < ang_stage_pixels(stage); i++) {
            const float *rgba = stage->image.rgba + 4 * i;
            if (!(rgba[3] > 0.1F)) continue;
            greatest = fmax(greatest, fabs(acos(fmin((double)(rgba[2] / rgba[3]), 1)) - expected));
            seen++;
        }
        ang_bench_error(stage->bench, greatest * 180 / M_PI, 0.5, "degrees that normals are off, view %s", views[v]);
        ang_bench_error(stage->bench, seen < 20, 0, "nothing seen, view %s", views[v]);
    }
    return true;
}

bool ang_case_spacing(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(8, 8, 4, long_voxels, ang_field_flat, err), err) &&
                silhouettes(&stage, err);
    ang_stage_close(&stage);
    if (!done) return false;
    done = ang_stage_open(&stage, bench, ang_bench_volume(8, 4, 6, long_voxels, oblique_ramp, err), err) &&
           normals(&stage, err);
    ang_stage_close(&stage);
    return done;
}

/* Directions of one kind must give one picture, and a mirrored one. */
static bool check_directions(ang_stage *stage, const double (*directions)[2], int count, const char *kind,
                             ang_error *err) {
    ang_image first = {0};
    bool done = true;
    for (int d = 0; d < count && done; d++) {
        char view[64];
        snprintf(view, sizeof view, "%.17g,%.17g", directions[d][0], directions[d][1]);
        ang_stage_look(stage, view, ANG_PARALLEL);
        done = ang_stage_draw(stage, err);
        if (!done) break;
        ang_bench_error(stage->bench, ang_stage_homogeneous(stage), 1e-6, "error along a %s, view %s", kind, view);
        int side = stage->scene.width;
        double mirrored = 0;
        for (int i = 0; i < side * side; i++) {
            int other = i - i % side + side - 1 - i % side;
            mirrored = fmax(mirrored, fabs((double)stage->image.rgba[4 * i + 3] - stage->image.rgba[4 * other + 3]));
        }
        ang_bench_error(stage->bench, mirrored, 1e-6, "asymmetry along a %s, view %s", kind, view);
        if (d > 0) {
            ang_bench_error(stage->bench, ang_image_difference(&first, &stage->image), 1e-6,
                            "difference along a %s, view %s", kind, view);
        } else {
            first = stage->image;
            stage->image = (ang_image){0};
        }
    }
    ang_image_clear(&first);
    return done;
}

static bool directions(ang_stage *stage, ang_error *err) {
    const double up = atan(sqrt(0.5)) * 180 / M_PI; /* of a cube's space diagonal */
    const double faces[][2] = {{0, 0}, {90, 0}, {180, 0}, {-90, 0}, {0, 90}, {0, -90}};
    const double upright[][2] = {{45, 0}, {135, 0}, {-135, 0}, {-45, 0}};
    const double lifted[][2] = {{0, 45}, {90, 45}, {180, 45}, {-90, 45}, {0, -45}, {90, -45}, {180, -45}, {-90, -45}};
    const double space[][2] = {{45, up},  {135, up},  {-135, up},  {-45, up},
                               {45, -up}, {135, -up}, {-135, -up}, {-45, -up}};
    if (!ang_stage_medium(stage, 0.2, err)) return false;
    stage->scene.width = stage->scene.height = 24;
    return check_directions(stage, faces, 6, "axis", err) &&
           check_directions(stage, upright, 4, "face diagonal", err) &&
           check_directions(stage, lifted, 8, "face diagonal", err) &&
           check_directions(stage, space, 8, "space diagonal", err);
}

bool ang_case_symmetry(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(9, 9, 9, ang_bench_unit, ang_field_flat, err), err) &&
                directions(&stage, err);
    ang_stage_close(&stage);
    return done;
}

/* The cosine between a pixel's ray and the line of sight in perspective, from the field of view alone. */
static double ray_cosine(const ang_scene *scene, int pixel) {
    double half = tan(scene->camera.fov_deg * M_PI / 360), unit = 2 * half / scene->height;
    double x = (pixel % scene->width + 0.5 - scene->width / 2.) * unit;
    double y = (pixel / scene->width + 0.5 - scene->height / 2.) * unit;
    return 1 / sqrt(1 + x * x + y * y);
}

/* Greatest error of what comes through a slab of depth `depth` (mm along the line of sight) in any pixel. */
static double slab_error(const ang_stage *stage, double kappa, double depth) {
    double greatest = 0;
    for (int i = 0; i < ang_stage_pixels(stage); i++) {
        double through = exp(-kappa * depth / ray_cosine(&stage->scene, i));
        greatest = fmax(greatest, fabs(1 - (double)stage->image.rgba[4 * i + 3] - through));
    }
    return greatest;
}

static bool look_ahead(ang_stage *stage, ang_error *err) {
    /* Along y through a box 20 mm deep; rays leave it by the far face alone. */
    static const struct {
        const char *where;
        double y, near, depth;
    } eyes[] = {{"inside", 5, 0.01, 14.99},
                {"on the near face", 0, 0.01, 19.99},
                {"before the box, near plane inside", -3, 6, 17},
                {"inside, near plane inside", 2, 7.25, 10.75},
                {"just before the far face", 19, 0.01, 0.99}};
    const double kappa = 0.1;
    ang_scene *scene = &stage->scene;
    if (!ang_stage_medium(stage, kappa, err)) return false;
    scene->width = scene->height = 24;
    for (size_t e = 0; e < sizeof eyes / sizeof *eyes; e++) {
        ang_stage_look(stage, "anterior", ANG_PERSPECTIVE);
        scene->camera.eye = (ang_vec3){8, eyes[e].y, 8};
        scene->camera.near_mm = eyes[e].near;
        if (!ang_stage_draw(stage, err)) return false;
        ang_bench_error(stage->bench, slab_error(stage, kappa, eyes[e].depth), 1e-5, "error with the camera %s",
                        eyes[e].where);
    }
    return true;
}

static bool look_around(ang_stage *stage, ang_error *err) {
    static const struct {
        const char *where;
        ang_vec3 eye;
        double near;
    } eyes[] = {{"inside", {7, 11, 5}, 0.02},
                {"on a face", {16, 9.3, 6.1}, 0.02},
                {"in a corner", {0, 0, 16}, 0.02},
                {"outside, near plane cutting a corner", {-6, -5, -4}, 14}};
    ang_scene *scene = &stage->scene;
    for (size_t e = 0; e < sizeof eyes / sizeof *eyes; e++) {
        ang_stage_look(stage, "-35,-25,12", ANG_PERSPECTIVE);
        scene->camera.eye = eyes[e].eye;
        scene->camera.near_mm = eyes[e].near;
        scene->camera.fov_deg = 100;
        if (!ang_stage_draw(stage, err)) return false;
        ang_bench_error(stage->bench, ang_stage_homogeneous(stage), 1e-5, "error around the camera %s", eyes[e].where);
    }
    return true;
}

bool ang_case_inside(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(17, 21, 17, ang_bench_unit, ang_field_flat, err), err) &&
                look_ahead(&stage, err) && look_around(&stage, err);
    ang_stage_close(&stage);
    return done;
}

static double smooth(int x, int y, int z) {
    return 300 + 250 * sin(0.31 * x + 0.2) * cos(0.27 * y) + 150 * sin(0.4 * z + 0.13 * x);
}

static bool from_afar(ang_stage *stage, ang_image *parallel, ang_error *err) {
    double change;
    if (!ang_stage_vessels(stage, err)) return false;
    ang_stage_look(stage, "33,21,10", ANG_PARALLEL);
    if (!ang_stage_keep(stage, parallel, err)) return false;
    ang_camera *camera = &stage->scene.camera;
    camera->projection = ANG_PERSPECTIVE;
    camera->fov_deg = 0.002;
    double distance = camera->half_height / tan(0.001 * M_PI / 180);
    camera->eye = ang_vec3_along(ang_volume_centre(stage->volume), camera->forward, -distance);
    if (!ang_stage_change(stage, parallel, &change, err)) return false;
    ang_bench_error(stage->bench, change, 1e-3, "difference from %.0f m away", distance / 1000);
    return true;
}

bool ang_case_from_afar(ang_bench *bench, ang_error *err) {
    ang_stage stage;
    ang_image parallel = {0};
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(16, 18, 14, ang_bench_unit, smooth, err), err) &&
                from_afar(&stage, &parallel, err);
    ang_image_clear(&parallel);
    ang_stage_close(&stage);
    return done;
}

static bool fields_of_view(ang_stage *stage, ang_error *err) {
    static const double degrees[] = {1, 30, 60, 90, 120, 150, 170};
    const double kappa = 0.2;
    ang_scene *scene = &stage->scene;
    if (!ang_stage_medium(stage, kappa, err)) return false;
    scene->width = scene->height = 24;
    for (size_t d = 0; d < sizeof degrees / sizeof *degrees; d++) {
        ang_stage_look(stage, "anterior", ANG_PERSPECTIVE);
        scene->camera.eye = (ang_vec3){160, -1, 160};
        scene->camera.near_mm = 0.01;
        scene->camera.fov_deg = degrees[d];
        if (!ang_stage_draw(stage, err)) return false;
        ang_bench_error(stage->bench, slab_error(stage, kappa, 2), 1e-4, "error at %g degrees", degrees[d]);
    }
    return true;
}

bool ang_case_field_of_view(ang_bench *bench, ang_error *err) {
    static const double spacing[3] = {10, 1, 10};
    ang_stage stage;
    bool done = ang_stage_open(&stage, bench, ang_bench_volume(33, 3, 33, spacing, ang_field_flat, err), err) &&
                fields_of_view(&stage, err);
    ang_stage_close(&stage);
    return done;
}

static bool draw_at(ang_bench *bench, double origin, ang_image *image, ang_error *err) {
    ang_stage stage;
    ang_volume *volume = ang_bench_sheared(err);
    for (int axis = 0; volume && axis < 3; axis++) volume->affine.m[axis][3] = axis == 1 ? -origin : origin;
    bool done = ang_stage_open(&stage, bench, volume, err) && ang_stage_vessels(&stage, err);
    if (done) {
        ang_stage_look(&stage, "33,21,10", ANG_PERSPECTIVE);
        stage.scene.shading = ANG_SHADING_PHONG;
        done = ang_stage_keep(&stage, image, err);
    }
    ang_stage_close(&stage);
    return done;
}

bool ang_case_far_origin(ang_bench *bench, ang_error *err) {
    ang_image near = {0}, far = {0};
    bool done = draw_at(bench, 0, &near, err) && draw_at(bench, 1e5, &far, err);
    if (done) ang_bench_error(bench, ang_image_difference(&near, &far), 1e-5, "difference at 100 m from the origin");
    ang_image_clear(&near);
    ang_image_clear(&far);
    return done;
}
