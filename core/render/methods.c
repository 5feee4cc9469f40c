#include "core/render/method.h"

#include "core/render/context.h"
#include "core/render/volume_texture.h"

#include <string.h>

static const ang_method *const methods[] = {
    &ang_method_singlepass, &ang_method_slicing,  &ang_method_envelope,  &ang_method_raycast,
    &ang_method_cpu,        &ang_method_adaptive, &ang_method_reference, NULL};

const ang_method *const *ang_methods(void) { return methods; }

const ang_method *ang_method_find(const char *name) {
    for (size_t i = 0; methods[i]; i++)
        if (strcmp(methods[i]->name, name) == 0) return methods[i];
    return NULL;
}

unsigned ang_method_ignores(const ang_method *method, const ang_render_options *options) {
    const ang_render_options *usual = &ang_render_options_default;
    const int *bricks = options->bricks;
    unsigned given = 0;
    if (options->termination < usual->termination || options->termination > usual->termination)
        given |= ANG_TAKES_TERMINATION;
    if (options->manual_filter) given |= ANG_TAKES_MANUAL_FILTER;
    if (options->no_skip) given |= ANG_TAKES_NO_SKIP;
    if (options->proxy != usual->proxy) given |= ANG_TAKES_PROXY;
    if (bricks[0] || bricks[1] || bricks[2]) given |= ANG_TAKES_BRICKS;
    if (options->pass_steps) given |= ANG_TAKES_PASS_STEPS;
    if (options->show_bricks) given |= ANG_TAKES_SHOW_BRICKS;
    if (options->separate_passes) given |= ANG_TAKES_SEPARATE_PASSES;
    if (options->gpu_memory) given |= ANG_TAKES_GPU_MEMORY;
    if (options->gradients) given |= ANG_TAKES_GRADIENTS;
    if (options->skipping || options->quads) given |= ANG_TAKES_ENVELOPE;
    if (options->count_shown) given |= ANG_TAKES_COUNT_SHOWN;
    if (options->classification) given |= ANG_TAKES_CLASSIFICATION;
    return given & ~method->takes;
}

/* Whether the ray caster on the processor can hold the volume and takes what is asked of it. */
static bool lanes_do(const ang_volume *volume, const ang_render_options *options) {
    return ang_volume_count(volume) <= INT32_MAX && !ang_method_ignores(&ang_method_cpu, options);
}

const ang_method *ang_method_choose_without_gl(const ang_volume *volume, const ang_render_options *options,
                                               const char **why) {
    ang_drawing_facts facts = {.gl = true, .software = true, .lanes = ang_volume_count(volume) <= INT32_MAX};
    facts.lanes_do = lanes_do(volume, options);
    return ang_plan_drawing(&facts, why) == ANG_DRAW_LANES ? &ang_method_cpu : NULL;
}

const ang_method *ang_method_choose(ang_gl *gl, const ang_volume *volume, const ang_scene *scene,
                                    const ang_render_options *options, const char **why) {
    static const ang_method *const by_drawing[] = {
        [ANG_DRAW_REFERENCE] = &ang_method_reference,   [ANG_DRAW_LANES] = &ang_method_cpu,
        [ANG_DRAW_WHOLE_RAYS] = &ang_method_singlepass, [ANG_DRAW_ENVELOPE] = &ang_method_envelope,
        [ANG_DRAW_PASSES] = &ang_method_raycast,        [ANG_DRAW_SLICES] = &ang_method_slicing};
    bool weighted = scene->mode == ANG_MODE_MEAN && volume->padding;
    size_t bytes = ang_volume_count(volume) * sizeof *volume->data * (weighted ? 2 : 1);
    bool within = !options->gpu_memory || bytes <= options->gpu_memory;
    int steps = options->pass_steps;
    bool planes = steps == 1 || steps == 2 || steps == 4; /* what slicing composites in a fragment */
    ang_drawing_facts facts = {.gl = gl,
                               .fits = gl && within && ang_volume_texture_fits(gl, volume->dims, NULL),
                               .asks_slices = options->bricks[0] || options->show_bricks || planes ||
                                              options->proxy != ANG_PROXY_VERTEX_PROGRAM,
                               .asks_passes = options->separate_passes || steps,
                               .software = gl && ang_gl_is_software(gl),
                               .lanes = ang_volume_count(volume) <= INT32_MAX};
    facts.lanes_do = facts.software && lanes_do(volume, options);
    return by_drawing[ang_plan_drawing(&facts, why)];
}
