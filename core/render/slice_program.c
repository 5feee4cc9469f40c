#include "core/render/slice_program.h"

#include "core/render/scene_parts.h"
#include "core/render/slice_geometry.h"

#include <shaders.h>

typedef struct sources {
    ang_shader_source vertex, fragment;
} sources;

bool ang_slice_needs_resolve(const ang_scene *scene) {
    return scene->mode == ANG_MODE_MIP || scene->mode == ANG_MODE_MINIP || scene->mode == ANG_MODE_MEAN;
}

static void compose_value(ang_shader_source *source, const ang_scene *scene, const ang_volume *volume, bool manual) {
    ang_parts_field(source, manual);
    switch (scene->mode) {
    case ANG_MODE_DVR:
        ang_parts_classification(source, scene);
        ANG_SHADER_ADD(source, opacity);
        ANG_SHADER_ADD(source, slice_dvr);
        break;
    case ANG_MODE_MIP:
    case ANG_MODE_MINIP:
        ANG_SHADER_ADD(source, slice_extreme);
        break;
    case ANG_MODE_MEAN:
        ang_parts_weight(source, scene, volume, manual);
        ANG_SHADER_ADD(source, slice_mean);
        break;
    case ANG_MODE_ISO:
        ang_parts_classification(source, scene);
        ANG_SHADER_ADD(source, slice_iso);
        break;
    }
}

static void compose_slices(sources *to, bool faces, const ang_scene *scene, const ang_volume *volume,
                           const ang_render_options *options, bool early, bool counting) {
    ang_slice_geometry_parts(options->proxy, &to->vertex);
    if (early) ANG_SHADER_ADD(&to->fragment, early);
    ANG_SHADER_ADD(&to->fragment, ray);
    ANG_SHADER_ADD(&to->fragment, slice_planes);
    ANG_SHADER_ADD(&to->fragment, slice_sample);
    if (faces)
        ANG_SHADER_ADD(&to->fragment, slice_faces);
    else
        ANG_SHADER_ADD(&to->fragment, slice_inner);
    ANG_SHADER_ADD(&to->fragment, slice_owned);
    compose_value(&to->fragment, scene, volume, options->manual_filter);
    if (counting)
        ANG_SHADER_ADD(&to->fragment, slice_picture_counted);
    else
        ANG_SHADER_ADD(&to->fragment, slice_picture);
}

static void compose_resolve(ang_shader_source *source, const ang_scene *scene) {
    ANG_SHADER_ADD(source, ray);
    ANG_SHADER_ADD(source, window);
    if (scene->mode == ANG_MODE_MEAN)
        ANG_SHADER_ADD(source, resolve_mean);
    else
        ANG_SHADER_ADD(source, resolve_extreme);
    ANG_SHADER_ADD(source, resolve);
}

static sources compose(ang_slice_pass pass, const ang_scene *scene, const ang_volume *volume,
                       const ang_render_options *options, bool early, bool counting) {
    sources to = {.vertex = {.count = 0}};
    ANG_SHADER_ADD(&to.vertex, version);
    ANG_SHADER_ADD(&to.fragment, version);
    switch (pass) {
    case ANG_SLICE_INNER:
    case ANG_SLICE_FACES:
        compose_slices(&to, pass == ANG_SLICE_FACES, scene, volume, options, early, counting);
        break;
    case ANG_SLICE_FINISH:
        ANG_SHADER_ADD(&to.vertex, triangle);
        ANG_SHADER_ADD(&to.fragment, slice_finished);
        break;
    case ANG_SLICE_RESOLVE:
        ANG_SHADER_ADD(&to.vertex, triangle);
        compose_resolve(&to.fragment, scene);
        break;
    case ANG_SLICE_EDGES:
        ANG_SHADER_ADD(&to.vertex, edge);
        ANG_SHADER_ADD(&to.fragment, edge_colour);
        break;
    }
    return to;
}

unsigned ang_slice_program(ang_programs *programs, ang_slice_pass pass, const ang_scene *scene,
                           const ang_volume *volume, const ang_render_options *options, bool early, bool counting,
                           ang_error *err) {
    sources made = compose(pass, scene, volume, options, early, counting);
    return ang_programs_get(programs, "slicing", &made.vertex, &made.fragment, err);
}

void ang_slice_explain_pass(ang_plan *plan, ang_slice_pass pass, const ang_scene *scene, const ang_volume *volume,
                            const ang_render_options *options, bool early) {
    static const char *const names[] = {"slices", "slices at the faces", "finished pixels", "values to grey",
                                        "edges of boxes"};
    sources made = compose(pass, scene, volume, options, early, false);
    bool slices = pass == ANG_SLICE_INNER || pass == ANG_SLICE_FACES;
    int lookups = slices ? ang_scene_lookups(scene, volume) : pass == ANG_SLICE_EDGES ? 0 : 1;
    ang_shader_explain(plan, names[pass], &made.vertex, &made.fragment, lookups);
}
