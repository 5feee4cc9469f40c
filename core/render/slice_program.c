#include "core/render/slice_program.h"

#include "core/render/limit_texture.h"
#include "core/render/scene_parts.h"
#include "core/render/slice_geometry.h"

#include <shaders.h>

typedef struct sources {
    ang_shader_source vertex, fragment;
} sources;

int ang_slice_group(const ang_scene *scene, const ang_render_options *options) {
    if (scene->mode == ANG_MODE_ISO) return 1; /* a hit must be told from the next by the depth test */
    int wanted = options->pass_steps;
    /* Fewer and larger polygons and fewer blends; measured on llvmpipe, where shading leaves no registers for two. */
    if (wanted == 0) wanted = ang_scene_needs_phong(scene) ? 1 : 2;
    return wanted >= 4 ? 4 : wanted >= 2 ? 2 : 1;
}

bool ang_slice_needs_resolve(const ang_scene *scene) {
    return scene->mode == ANG_MODE_MIP || scene->mode == ANG_MODE_MINIP || scene->mode == ANG_MODE_MEAN;
}

static void compose_value(ang_shader_source *source, bool faces, const ang_slice_recipe *recipe) {
    const ang_scene *scene = recipe->scene;
    ang_field_kind kind = recipe->options->manual_filter ? ANG_FIELD_MANUAL : ANG_FIELD_HARDWARE;
    ang_parts_field(source, kind);
    switch (scene->mode) {
    case ANG_MODE_DVR:
        ang_parts_classification(source, scene, kind, recipe->plan[faces]);
        ang_parts_medium(source, recipe->table, recipe->plan[faces]);
        ANG_SHADER_ADD(source, slice_dvr);
        break;
    case ANG_MODE_MIP:
        ANG_SHADER_ADD(source, slice_mip);
        break;
    case ANG_MODE_MINIP:
        ANG_SHADER_ADD(source, slice_minip);
        break;
    case ANG_MODE_MEAN:
        ang_parts_weight(source, scene, recipe->volume, kind);
        ANG_SHADER_ADD(source, slice_mean);
        break;
    case ANG_MODE_ISO:
        ang_parts_classification(source, scene, kind, recipe->plan[faces]);
        ANG_SHADER_ADD(source, slice_iso);
        break;
    }
}

static void compose_slices(sources *to, bool faces, const ang_slice_recipe *recipe) {
    int group = ang_slice_group(recipe->scene, recipe->options);
    bool counting = recipe->counting;
    ang_slice_geometry_parts(recipe->options->proxy, group, &to->vertex);
    if (ang_plan_uses(recipe->plan[0], ANG_PART_TERMINATION)) ANG_SHADER_ADD(&to->fragment, early);
    ang_parts_ray(&to->fragment, recipe->scene, recipe->plan[faces], faces);
    ang_slice_planes_parts(group, &to->fragment);
    ANG_SHADER_ADD(&to->fragment, slice_sample);
    if (faces)
        ANG_SHADER_ADD(&to->fragment, slice_faces);
    else
        ANG_SHADER_ADD(&to->fragment, slice_inner);
    ANG_SHADER_ADD(&to->fragment, slice_owned);
    compose_value(&to->fragment, faces, recipe);
    bool one = group == 1;
    if (one && counting)
        ANG_SHADER_ADD(&to->fragment, slice_one_counted);
    else if (one)
        ANG_SHADER_ADD(&to->fragment, slice_one);
    else if (counting)
        ANG_SHADER_ADD(&to->fragment, slice_several_counted);
    else
        ANG_SHADER_ADD(&to->fragment, slice_several);
}

static void compose_resolve(ang_shader_source *source, const ang_slice_recipe *recipe) {
    const ang_scene *scene = recipe->scene;
    ang_parts_ray(source, scene, recipe->plan[0], true);
    ANG_SHADER_ADD(source, window);
    if (scene->mode == ANG_MODE_MEAN)
        ANG_SHADER_ADD(source, resolve_mean);
    else
        ANG_SHADER_ADD(source, resolve_extreme);
    ANG_SHADER_ADD(source, resolve);
}

static sources compose(ang_slice_pass pass, const ang_slice_recipe *recipe) {
    sources to = {.vertex = {.count = 0}};
    ANG_SHADER_ADD(&to.vertex, version);
    ANG_SHADER_ADD(&to.fragment, version);
    switch (pass) {
    case ANG_SLICE_INNER:
    case ANG_SLICE_FACES:
        /* Where opaque geometry ends rays, any sample may be the last. */
        compose_slices(&to, pass == ANG_SLICE_FACES || ang_scene_limits_rays(recipe->scene), recipe);
        break;
    case ANG_SLICE_FINISH:
        ANG_SHADER_ADD(&to.vertex, triangle);
        ANG_SHADER_ADD(&to.fragment, slice_finished);
        break;
    case ANG_SLICE_RESOLVE:
        ANG_SHADER_ADD(&to.vertex, triangle);
        compose_resolve(&to.fragment, recipe);
        break;
    case ANG_SLICE_EDGES:
        ANG_SHADER_ADD(&to.vertex, edge);
        ANG_SHADER_ADD(&to.fragment, edge_colour);
        break;
    }
    return to;
}

unsigned ang_slice_program(ang_programs *programs, ang_slice_pass pass, const ang_slice_recipe *recipe,
                           ang_error *err) {
    sources made = compose(pass, recipe);
    return ang_programs_get(programs, "slicing", &made.vertex, &made.fragment, err);
}

void ang_slice_explain_pass(ang_plan *plan, ang_slice_pass pass, const ang_slice_recipe *recipe) {
    static const char *const names[] = {"slices", "slices at the faces", "finished pixels", "values to grey",
                                        "edges of boxes"};
    sources made = compose(pass, recipe);
    bool slices = pass == ANG_SLICE_INNER || pass == ANG_SLICE_FACES;
    int lookups = pass == ANG_SLICE_EDGES ? 0 : 1;
    if (slices)
        lookups = ang_scene_lookups(recipe->scene, recipe->volume) +
                  ang_scene_step_lookups(recipe->scene, recipe->table, true);
    ang_shader_explain(plan, names[pass], &made.vertex, &made.fragment, lookups);
}
