/* The command line: the first byte is the verb, then arguments parted by line ends. What is drawn from them is read as
 * well: views, clip boxes and planes, names of parts. */
#include "app/verbs.h"
#include "core/plan/decide.h"
#include "core/scene/scene.h"
#include "tests/fuzz/fuzz.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_ARGUMENTS = 32 };

static void read_values(const ang_options *options) {
    static ang_volume *volume;
    ang_error err = {0};
    if (!volume) volume = ang_volume_create((int[3]){8, 7, 6}, &err);
    fuzz_expect(volume != NULL, "no volume");
    ang_view view = ang_view_default;
    if (options->view && ang_view_parse(options->view, &view, &err)) ang_camera_for(volume, &view);
    ang_scene scene = ang_scene_default(volume);
    ang_clip_plane plane;
    int size[3], count;
    double numbers[96];
    unsigned forced = 0;
    if (options->clip) ang_scene_clip_parse(options->clip, volume, &scene, &err);
    if (options->size) ang_app_parse_dims("size", options->size, 2, 16384, size, &err);
    if (options->bricks) ang_app_parse_dims("bricks", options->bricks, 3, 65536, size, &err);
    if (options->background) ang_app_parse_numbers("background", options->background, 3, 4, numbers, &count, &err);
    if (options->measure) ang_app_parse_numbers("measure", options->measure, 6, 96, numbers, &count, &err);
    if (options->force) ang_parts_parse(options->force, &forced, &err);
    if (options->clip_plane) ang_clip_plane_parse(options->clip_plane, &plane, &err);
}

static void ignore(void *context, const char *name, const char *value) { (void)context, (void)name, (void)value; }

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size < 1) return 0;
    char *text = fuzz_text(data + 1, size - 1), program[] = "angioscope";
    char *arguments[MOST_ARGUMENTS + 2] = {program};
    int count = 1;
    char *rest = text;
    for (char *word; count <= MOST_ARGUMENTS && (word = strsep(&rest, "\n"));) arguments[count++] = word;
    ang_verb verb = (ang_verb)(1 << data[0] % 8);
    ang_options options;
    ang_error err = {0};
    if (ang_options_parse(verb, count, arguments, &options, &err)) {
        read_values(&options);
        ang_options_each(verb, &options, ignore, NULL);
    } else {
        fuzz_expect(err.code == ANG_USAGE && err.message[0], "refused without a reason");
    }
    free(text);
    return 0;
}
