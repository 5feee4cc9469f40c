/* The plan without OpenGL: given these facts, that is used and that left out, whatever else there is. */
#include "tests/core/fixtures.h"

#include "core/plan/block_box.h"
#include "core/plan/decide.h"

#include <string.h>

/* A shaded picture of a volume of which a quarter shows; everything is needed that can be. */
static ang_plan_facts usual(ang_drawing drawing) {
    return (ang_plan_facts){.drawing = drawing,
                            .mode = ANG_MODE_DVR,
                            .phong = true,
                            .pixels = 1e5,
                            .jumps = true,
                            .extinction = 2,
                            .longest_mm = 300,
                            .sample_mm = 0.5,
                            .ahead = true,
                            .starts_inside = true,
                            .bytes = 1e8,
                            .texture_shared = true,
                            .blocks = 1000,
                            .shown = 250,
                            .share_uploaded = 1,
                            .hull_fits = true,
                            .fragments = 1e7,
                            .most_apron = 17,
                            .gl = true,
                            .has_clip_plane = true,
                            .plane_cuts = true,
                            .software = true,
                            .gradients_fit = true,
                            .gradient_bytes = 4e8,
                            .gradient_limit = 2e9,
                            .termination = 0.999};
}

static bool used(const ang_plan_facts *facts, ang_part part) {
    ang_plan_decisions d = ang_plan_decide(facts);
    return ang_plan_uses(&d, part);
}

static bool says(const ang_plan_facts *facts, ang_part part, const char *why) {
    ang_plan_decisions d = ang_plan_decide(facts);
    return !d.part[part].used && d.part[part].why && strstr(d.part[part].why, why);
}

/* Whether the part is left out for that reason, and used with a reason to leave it out where it is forced. */
static bool spares(ang_plan_facts facts, ang_part part, const char *why) {
    bool left_out = says(&facts, part, why);
    facts.forced = 1u << part;
    ang_plan_decisions d = ang_plan_decide(&facts);
    return left_out && d.part[part].used && d.part[part].why && d.part[part].gone;
}

static void what_a_scene_needs_is_used(void **state) {
    (void)state;
    ang_plan_facts rays = usual(ANG_DRAW_ENVELOPE), passes = usual(ANG_DRAW_PASSES), slices = usual(ANG_DRAW_SLICES);
    static const ang_part common[] = {ANG_PART_GRADIENTS, ANG_PART_EXPONENTIAL, ANG_PART_COLOUR,
                                      ANG_PART_ROUNDING,  ANG_PART_TERMINATION, ANG_PART_SKIPPING,
                                      ANG_PART_REDRAW,    ANG_PART_GL,          ANG_PART_CLIP_PLANE};
    for (size_t i = 0; i < sizeof common / sizeof *common; i++) {
        assert_true(used(&rays, common[i]));
        assert_true(used(&passes, common[i]));
        assert_true(used(&slices, common[i]));
    }
    assert_true(used(&rays, ANG_PART_HULL));
    assert_true(used(&rays, ANG_PART_NEAR_PLANE));
    assert_true(used(&rays, ANG_PART_GRADIENT_TEXTURE));
    assert_true(used(&passes, ANG_PART_DIRECTIONS));
    assert_true(used(&passes, ANG_PART_JOINED));
}

static void each_part_is_left_out_for_its_reason(void **state) {
    (void)state;
    ang_plan_facts f = usual(ANG_DRAW_ENVELOPE);
    f.phong = false;
    assert_true(spares(f, ANG_PART_GRADIENTS, "shading is none"));
    f.extinction = 0.9;
    assert_true(spares(f, ANG_PART_EXPONENTIAL, "thin"));
    f.extinction = 0.99;
    assert_true(used(&f, ANG_PART_EXPONENTIAL));
    f.one_colour = true;
    assert_true(spares(f, ANG_PART_COLOUR, "one colour"));
    f.jumps = false;
    assert_true(spares(f, ANG_PART_ROUNDING, "no step"));
    f.starts_inside = false;
    assert_true(spares(f, ANG_PART_NEAR_PLANE, "before the whole volume"));
    assert_true(spares(f, ANG_PART_BORDER, "nothing shows"));
    f.share_uploaded = 0.6;
    assert_true(spares(f, ANG_PART_SLABS, "shows"));
    f.shown = f.blocks;
    assert_true(spares(f, ANG_PART_SKIPPING, "no block"));
    assert_true(used(&f, ANG_PART_SLABS));
    assert_true(used(&f, ANG_PART_BORDER));
    assert_false(used(&f, ANG_PART_HULL));
    f.plane_cuts = false;
    assert_true(spares(f, ANG_PART_CLIP_PLANE, "nothing of the box"));
    f.has_clip_plane = false;
    assert_true(spares(f, ANG_PART_CLIP_PLANE, "has none"));
    f.same_as_before = true;
    assert_true(spares(f, ANG_PART_REDRAW, "nothing has changed"));

    f = usual(ANG_DRAW_PASSES);
    f.parallel = true;
    assert_true(spares(f, ANG_PART_DIRECTIONS, "one direction"));
    f.extinction = 0.999 * -log(1 - 0.999) / 300;
    assert_true(spares(f, ANG_PART_TERMINATION, "no ray can reach"));
    f.extinction = 1.001 * -log(1 - 0.999) / 300;
    assert_true(used(&f, ANG_PART_TERMINATION));
    f = usual(ANG_DRAW_SLICES);
    assert_true(spares(f, ANG_PART_DESCENT, "cost"));
    f.all_shows = true;
    assert_true(spares(f, ANG_PART_SKIPPING, "invisible"));
    f.fragments = 7.9 * f.pixels;
    assert_true(says(&f, ANG_PART_TERMINATION, "too few"));
    f = usual(ANG_DRAW_REFERENCE);
    assert_true(spares(f, ANG_PART_GL, "needs none"));
}

/* What the user has switched off stays off, and what has no place in a mode has none when it is forced. */
static void what_is_forbidden_cannot_be_forced(void **state) {
    (void)state;
    ang_plan_facts f = usual(ANG_DRAW_ENVELOPE);
    f.forced = (1u << ANG_FORCIBLE) - 1;
    f.no_skip = true;
    assert_true(says(&f, ANG_PART_SKIPPING, "--no-skip"));
    assert_false(used(&f, ANG_PART_HULL));
    assert_true(used(&f, ANG_PART_SLABS));
    f.termination = 1;
    assert_true(says(&f, ANG_PART_TERMINATION, "not to end early"));
    f.no_skip = false;
    f.mode = ANG_MODE_MEAN;
    assert_true(says(&f, ANG_PART_SKIPPING, "mean"));
    assert_false(used(&f, ANG_PART_GRADIENTS));
    assert_false(used(&f, ANG_PART_TERMINATION));
    f = usual(ANG_DRAW_WHOLE_RAYS);
    f.forced = (1u << ANG_FORCIBLE) - 1;
    assert_true(says(&f, ANG_PART_SKIPPING, "baseline"));
    f = usual(ANG_DRAW_ENVELOPE);
    f.gradients = ANG_GRADIENTS_LOOKUPS;
    assert_true(says(&f, ANG_PART_GRADIENT_TEXTURE, "--gradients lookups"));
    f.gradients = ANG_GRADIENTS_AUTO;
    f.memory = 3e8;
    assert_true(says(&f, ANG_PART_GRADIENT_TEXTURE, "--gpu-memory"));
    f.memory = 0;
    f.gradient_bytes = 3e9;
    assert_true(says(&f, ANG_PART_GRADIENT_TEXTURE, "2 GB"));
    f.gradients = ANG_GRADIENTS_TEXTURE;
    assert_true(used(&f, ANG_PART_GRADIENT_TEXTURE));
    f.ahead = false;
    assert_true(says(&f, ANG_PART_HULL, "in or beside"));
    assert_false(used(&f, ANG_PART_BORDER));
    f.skipping = ANG_SKIP_BETWEEN;
    assert_true(used(&f, ANG_PART_BORDER));
}

/* Forcing a part never changes whether another is needed, as far as those go that change what is computed. */
/* Steps that are classified by the values at their ends look beyond what shows. */
static void whole_steps_need_what_lies_around(void **state) {
    (void)state;
    ang_plan_facts f = usual(ANG_DRAW_ENVELOPE);
    f.share_uploaded = 0.3;
    assert_true(used(&f, ANG_PART_GRADIENT_TEXTURE) && !used(&f, ANG_PART_SLABS));
    f.whole_steps = true;
    assert_true(says(&f, ANG_PART_GRADIENT_TEXTURE, "values beyond"));
    assert_true(used(&f, ANG_PART_SLABS) && used(&f, ANG_PART_SKIPPING));
    f = usual(ANG_DRAW_SLICES);
    f.apron = f.most_apron + 1;
    assert_true(used(&f, ANG_PART_SKIPPING));
    f.whole_steps = true;
    assert_true(says(&f, ANG_PART_SKIPPING, "so far apart"));
    f.apron = f.most_apron;
    assert_true(used(&f, ANG_PART_SKIPPING));
}

static void forcing_one_part_leaves_the_others(void **state) {
    (void)state;
    uint64_t random = 5;
    for (int n = 0; n < 20000; n++) {
        ang_plan_facts f = usual((ang_drawing)(n % 5));
        f.mode = (ang_mode)(n / 5 % 5);
        f.phong = random_unit(&random) < 0.5;
        f.parallel = random_unit(&random) < 0.5;
        f.one_colour = random_unit(&random) < 0.5;
        f.jumps = random_unit(&random) < 0.5;
        f.all_shows = random_unit(&random) < 0.5;
        f.ahead = random_unit(&random) < 0.5;
        f.extinction = pow(10, 6 * random_unit(&random) - 4);
        if (random_unit(&random) < 0.3) f.shown = f.blocks;
        ang_plan_decisions free = ang_plan_decide(&f);
        ang_part part = (ang_part)(random_unit(&random) * ANG_FORCIBLE);
        f.forced = 1u << part;
        ang_plan_decisions forced = ang_plan_decide(&f);
        for (int i = 0; i < ANG_PARTS; i++) {
            bool border = part == ANG_PART_BORDER && (i == ANG_PART_HULL || i == ANG_PART_NEAR_PLANE);
            bool joined = part == ANG_PART_SKIPPING && i == ANG_PART_JOINED;
            if (i != (int)part && !border && !joined) assert_int_equal(free.part[i].used, forced.part[i].used);
            if (free.part[i].used && !border) assert_true(forced.part[i].used);
        }
    }
}

static void the_way_to_draw_follows_what_is_there(void **state) {
    (void)state;
    const char *why = NULL;
    ang_drawing_facts f = {.gl = true, .fits = true};
    assert_int_equal(ang_plan_drawing(&f, &why), ANG_DRAW_ENVELOPE);
    f.asks_passes = true;
    assert_int_equal(ang_plan_drawing(&f, &why), ANG_DRAW_PASSES);
    f.asks_slices = true;
    assert_int_equal(ang_plan_drawing(&f, &why), ANG_DRAW_SLICES);
    assert_non_null(strstr(why, "option"));
    f = (ang_drawing_facts){.gl = true, .asks_passes = true};
    assert_int_equal(ang_plan_drawing(&f, &why), ANG_DRAW_SLICES);
    assert_non_null(strstr(why, "does not fit"));
    f.gl = false;
    assert_int_equal(ang_plan_drawing(&f, &why), ANG_DRAW_REFERENCE);
    f.lanes = true;
    assert_int_equal(ang_plan_drawing(&f, &why), ANG_DRAW_LANES);
    f = (ang_drawing_facts){.gl = true, .fits = true, .lanes = true, .lanes_do = true};
    assert_int_equal(ang_plan_drawing(&f, &why), ANG_DRAW_ENVELOPE);
    f.software = true;
    assert_int_equal(ang_plan_drawing(&f, &why), ANG_DRAW_LANES);
    assert_non_null(strstr(why, "software"));
    f.lanes_do = false;
    assert_int_equal(ang_plan_drawing(&f, &why), ANG_DRAW_ENVELOPE);
}

/* What is not known yet speaks for a part, so that a method builds what it takes to know. */
static void unknown_facts_speak_for_a_part(void **state) {
    (void)state;
    ang_plan_facts f = usual(ANG_DRAW_ENVELOPE);
    f.blocks = f.shown = 0;
    assert_true(used(&f, ANG_PART_SKIPPING));
    assert_true(used(&f, ANG_PART_HULL));
}

static void names_are_read_and_refused(void **state) {
    (void)state;
    unsigned forced = 0;
    ang_error err = {0};
    for (int part = 0; part < ANG_FORCIBLE; part++) {
        assert_int_equal(ang_part_from_name(ang_part_name((ang_part)part)), part);
        assert_true(ang_parts_parse(ang_part_name((ang_part)part), &forced, NULL));
        assert_int_equal(forced, 1u << part);
    }
    assert_true(ang_parts_parse("gl,slabs", &forced, NULL));
    assert_int_equal(forced, 1u << ANG_PART_GL | 1u << ANG_PART_SLABS);
    assert_true(ang_parts_parse("all", &forced, NULL));
    assert_int_equal(forced, (1u << ANG_FORCIBLE) - 1);
    static const char *const bad[] = {"", "gl,", "sla", "gl,none", "all,gl"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_false(ang_parts_parse(bad[i], &forced, &err));
        assert_int_equal(err.code, ANG_USAGE);
        assert_non_null(strstr(err.message, "near-plane"));
    }
    assert_null(ang_part_name(ANG_PART_HULL));
}

static void plans_say_what_is_saved(void **state) {
    (void)state;
    ang_plan_facts f = usual(ANG_DRAW_ENVELOPE);
    f.share_uploaded = 0.25;
    f.phong = false;
    f.forced = 1u << ANG_PART_GRADIENTS;
    ang_plan_decisions d = ang_plan_decide(&f);
    ang_plan plan = {0};
    ang_plan_explain(&d, &plan);
    bool slabs = false, gradients = false;
    for (size_t i = 0; i < plan.left_out.count; i++)
        slabs =
            slabs || (plan.left_out.item[i].saves && strcmp(plan.left_out.item[i].saves, "75 % of the upload") == 0);
    for (size_t i = 0; i < plan.uses.count; i++) gradients = gradients || strstr(plan.uses.item[i].what, "by --force");
    assert_true(slabs);
    assert_true(gradients);
    ang_plan_clear(&plan);
}

/* Against a look at every voxel. */
static void boxes_of_blocks_hold_what_is_touched(void **state) {
    (void)state;
    const double spacing[3] = {1, 1, 1};
    ang_volume *volume = ang_volume_create((int[3]){37, 20, 9}, NULL);
    (void)spacing;
    ang_octree *octree = ang_octree_build(volume, (int[3]){4, 4, 4}, 1, 1, NULL);
    assert_non_null(octree);
    const int *dims = octree->level[0].dims;
    ang_block_box box = ang_block_box_none();
    int first[3], end[3];
    ang_vec3 none = {0, 0, 0};
    assert_close(ang_block_box_voxels(&box, octree, volume, none, first, end), 0, 0);
    ang_block_box_add(&box, octree, (size_t)(3 + dims[0] * (1 + dims[1] * 0)));
    ang_block_box_add(&box, octree, (size_t)(5 + dims[0] * (2 + dims[1] * 1)));
    double share = ang_block_box_voxels(&box, octree, volume, none, first, end);
    /* Cells 12..23, 4..11, 0..7: voxels to the end of the last cell. */
    assert_int_equal(first[0], 12);
    assert_int_equal(end[0], 25);
    assert_int_equal(first[1], 4);
    assert_int_equal(end[1], 13);
    assert_int_equal(first[2], 0);
    assert_int_equal(end[2], 9);
    assert_close(share, 13.0 * 9 * 9 / (37 * 20 * 9), 1e-12);
    ang_block_box_voxels(&box, octree, volume, (ang_vec3){1.5, 100, 0}, first, end);
    assert_int_equal(first[0], 10);
    assert_int_equal(end[0], 27);
    assert_int_equal(first[1], 0);
    assert_int_equal(end[1], 20);
    ang_octree_free(octree);
    ang_volume_free(volume);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_a_scene_needs_is_used),
        cmocka_unit_test(the_way_to_draw_follows_what_is_there),
        cmocka_unit_test(each_part_is_left_out_for_its_reason),
        cmocka_unit_test(what_is_forbidden_cannot_be_forced),
        cmocka_unit_test(whole_steps_need_what_lies_around),
        cmocka_unit_test(forcing_one_part_leaves_the_others),
        cmocka_unit_test(unknown_facts_speak_for_a_part),
        cmocka_unit_test(names_are_read_and_refused),
        cmocka_unit_test(plans_say_what_is_saved),
        cmocka_unit_test(boxes_of_blocks_hold_what_is_touched),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
