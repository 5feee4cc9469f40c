#include "core/volume/phantom.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static ang_phantom_truth truth;

static ang_volume *make(const ang_phantom_params *params, int threads) {
    ang_error err = {0};
    ang_volume *volume = ang_phantom_make(params, threads, NULL, &truth, &err);
    if (!volume) fail_msg("%s", err.message);
    return volume;
}

/* A small box of fine voxels without noise. */
static ang_volume *close_up(ang_vec3 centre, int size, double spacing) {
    ang_phantom_params params = ang_phantom_params_default;
    for (int i = 0; i < 3; i++) {
        params.dims[i] = size;
        params.spacing_mm[i] = spacing;
    }
    params.centre_mm = centre;
    params.noise_hu = 0;
    return make(&params, 0);
}

/* Where the field falls through half contrast from `start` along `direction`, in mm; 0 where it does not. */
static double edge_at(const ang_volume *volume, ang_vec3 start, ang_vec3 direction, double reach) {
    ang_mat4 to_index;
    assert_true(ang_mat4_inverse(&volume->affine, &to_index));
    const double half = 0.5 * (350 + 30), step = 0.01;
    for (double t = step; t < reach; t += step) {
        ang_vec3 p = ang_mat4_point(&to_index, ang_vec3_along(start, direction, t));
        if (ang_volume_hu(volume, ang_volume_sample(volume, p)) < half) return t;
    }
    return 0;
}

/* The mean diameter over directions at right angles to `axis`. */
static double diameter(const ang_volume *volume, ang_vec3 centre, ang_vec3 axis, double reach) {
    ang_vec3 other = fabs(axis.z) < 0.9 ? (ang_vec3){0, 0, 1} : (ang_vec3){1, 0, 0};
    ang_vec3 a = ang_vec3_unit(ang_vec3_cross(axis, other)), b = ang_vec3_cross(axis, a);
    const int count = 24;
    double sum = 0;
    for (int i = 0; i < count; i++) {
        double angle = 2 * M_PI * i / count;
        double r = edge_at(volume, centre, ang_vec3_along(ang_vec3_scale(a, cos(angle)), b, sin(angle)), reach);
        assert_true(r > 0);
        sum += r;
    }
    return 2 * sum / count;
}

static void near(double value, double wanted, double tolerance) {
    if (!(fabs(value - wanted) <= tolerance)) fail_msg("%g instead of %g", value, wanted);
}

static void tiny(ang_phantom_params *params) {
    *params = ang_phantom_params_default;
    params->dims[0] = params->dims[1] = params->dims[2] = 4;
}

static void aneurysm_has_its_diameter(void **state) {
    (void)state;
    ang_phantom_params params;
    tiny(&params);
    ang_volume_free(make(&params, 1));
    ang_vec3 centre = truth.aneurysm.centre, neck = {36, -6, 8};
    ang_volume *volume = close_up(centre, 96, 0.1);
    near(diameter(volume, centre, ang_vec3_unit(ang_vec3_sub(centre, neck)), 4.6), truth.aneurysm.diameter_mm, 0.03);
    ang_volume_free(volume);
}

static void stenosis_has_its_diameters(void **state) {
    (void)state;
    ang_phantom_params params;
    tiny(&params);
    ang_volume_free(make(&params, 1));
    ang_vec3 centre = truth.stenosis.centre, along = truth.stenosis.direction;
    ang_volume *volume = close_up(centre, 110, 0.1);
    near(diameter(volume, centre, along, 2), truth.stenosis.minimum_mm, 0.04);
    near(truth.stenosis.percent, 100 * (1 - truth.stenosis.minimum_mm / truth.stenosis.normal_mm), 1e-9);
    ang_volume_free(volume);

    const ang_phantom_vessel *parent = NULL;
    for (int i = 0; i < truth.vessel_count; i++) {
        if (strcmp(truth.vessels[i].name, truth.stenosis.parent) == 0) parent = &truth.vessels[i];
    }
    assert_non_null(parent);
    /* A control point beyond half the narrowing is as wide as it says. */
    ang_vec3 beside = parent->points[2];
    assert_true(ang_vec3_length(ang_vec3_sub(beside, centre)) > truth.stenosis.length_mm / 2);
    volume = close_up(beside, 60, 0.1);
    ang_vec3 direction = ang_vec3_unit(ang_vec3_sub(parent->points[3], parent->points[1]));
    near(diameter(volume, beside, direction, 2.8), 2 * parent->radii_mm[2], 0.06);
    ang_volume_free(volume);
}

static void radii_lie_in_range(void **state) {
    (void)state;
    ang_phantom_params params;
    tiny(&params);
    ang_volume_free(make(&params, 1));
    assert_true(truth.vessel_count > 40);
    for (int i = 0; i < truth.vessel_count; i++) {
        const ang_phantom_vessel *v = &truth.vessels[i];
        assert_true(v->count >= 2 && v->count <= ang_phantom_max_points && v->length_mm > 3);
        for (int k = 0; k < v->count && v->arterial; k++) {
            assert_true(v->radii_mm[k] >= 0.5 - 1e-12 && v->radii_mm[k] <= 3 + 1e-12);
        }
    }
}

static void same_for_every_number_of_threads(void **state) {
    (void)state;
    ang_phantom_params params = ang_phantom_params_default;
    params.dims[0] = 61;
    params.dims[1] = 53;
    params.dims[2] = 29;
    ang_volume *one = make(&params, 1), *many = make(&params, 5);
    size_t bytes = ang_volume_count(one) * sizeof *one->data;
    assert_memory_equal(one->data, many->data, bytes);
    params.seed = 2;
    ang_volume *other = make(&params, 2);
    assert_memory_not_equal(one->data, other->data, bytes);
    ang_volume_free(one);
    ang_volume_free(many);
    ang_volume_free(other);
}

static void geometry_is_centred(void **state) {
    (void)state;
    ang_phantom_params params = ang_phantom_params_default;
    params.dims[0] = 64;
    params.dims[1] = 32;
    params.dims[2] = 16;
    ang_volume *volume = make(&params, 0);
    near(ang_volume_spacing(volume, 0), 3.6, 1e-12);
    near(ang_volume_spacing(volume, 1), 7.2, 1e-12);
    near(ang_volume_spacing(volume, 2), 6, 1e-12);
    ang_vec3 centre = ang_volume_centre(volume);
    near(centre.x, 0, 1e-9);
    near(centre.y, 5, 1e-9);
    near(centre.z, 8, 1e-9);
    ang_volume_free(volume);
}

/* Noise as asked for in the air outside the head, where nothing else varies; the clamp at -1024 HU is far off. */
static void noise_has_its_deviation(void **state) {
    (void)state;
    ang_phantom_params params = ang_phantom_params_default;
    for (int i = 0; i < 3; i++) {
        params.dims[i] = 40;
        params.spacing_mm[i] = 0.2;
    }
    params.centre_mm = (ang_vec3){110, -110, 100};
    params.noise_hu = 5;
    ang_volume *volume = make(&params, 0);
    double sum = 0, squares = 0, count = (double)ang_volume_count(volume);
    for (size_t i = 0; i < ang_volume_count(volume); i++) {
        double hu = ang_volume_hu(volume, volume->data[i]) + 1000;
        sum += hu;
        squares += hu * hu;
    }
    near(sum / count, 0, 0.1);
    near(sqrt(squares / count), 5, 0.1);
    ang_volume_free(volume);
}

static void bad_params_are_refused(void **state) {
    (void)state;
    ang_error err = {0};
    ang_phantom_params params = ang_phantom_params_default;
    params.dims[1] = 0;
    assert_null(ang_phantom_make(&params, 0, NULL, NULL, &err));
    assert_int_equal(err.code, ANG_USAGE);
    tiny(&params);
    params.spacing_mm[0] = NAN;
    assert_null(ang_phantom_make(&params, 0, NULL, NULL, &err));
    tiny(&params);
    params.noise_hu = -1;
    assert_null(ang_phantom_make(&params, 0, NULL, NULL, &err));
    tiny(&params);
    params.dims[0] = params.dims[1] = params.dims[2] = 1;
    ang_volume_free(make(&params, 0));
}

static bool stop(void *context, const char *what, double fraction) {
    (void)context, (void)what, (void)fraction;
    return false;
}

static void can_be_interrupted(void **state) {
    (void)state;
    ang_phantom_params params;
    tiny(&params);
    ang_error err = {0};
    ang_progress progress = {stop, NULL};
    assert_null(ang_phantom_make(&params, 2, &progress, NULL, &err));
    assert_int_equal(err.code, ANG_INTERRUPTED);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(aneurysm_has_its_diameter), cmocka_unit_test(stenosis_has_its_diameters),
        cmocka_unit_test(radii_lie_in_range),        cmocka_unit_test(same_for_every_number_of_threads),
        cmocka_unit_test(geometry_is_centred),       cmocka_unit_test(noise_has_its_deviation),
        cmocka_unit_test(bad_params_are_refused),    cmocka_unit_test(can_be_interrupted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
