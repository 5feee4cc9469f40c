/* The phantom's skin: cc example.c $(pkg-config --cflags --libs angioscope) -o example && ./example >skin.ppm */
#include "core/render/method.h"
#include "core/volume/phantom.h"
#include <stdio.h>
int main(void) {
    static const ang_transfer_point points[] = {{-500, {0.7, 0.5, 0.4}, 0},
                                                {-350, {0.85, 0.63, 0.5}, 0.25},
                                                {-200, {0.93, 0.74, 0.61}, 0.8},
                                                {-50, {0.95, 0.78, 0.66}, 1},
                                                {3071, {0.97, 0.83, 0.73}, 1}};
    ang_error err = {0};
    ang_phantom_params params = ang_phantom_params_default;
    params.dims[0] = params.dims[1] = params.dims[2] = 96;
    ang_volume *head = ang_phantom_make(&params, 0, NULL, NULL, &err);
    ang_transfer *skin = ang_transfer_create(points, 5, 1 /* mm */, false, NULL, &err);
    ang_renderer *cpu = head && skin ? ang_method_cpu.create(NULL, head, &ang_render_options_default, &err) : NULL;
    ang_image image = {0};
    if (cpu && ang_image_create(&image, 512, 512, &err)) {
        ang_scene scene = ang_scene_default(head);
        scene.transfer = skin, scene.shading = ANG_SHADING_PHONG, scene.phong = (ang_phong){0.2, 0.8, 0.12, 12, 10};
        if (ang_method_cpu.render(cpu, &scene, &ang_render_options_default, &image, NULL, NULL, &err))
            printf("P6\n%d %d\n255\n", image.width, image.height);
        for (int i = 0; err.code == ANG_OK && i < 4 * image.width * image.height; i++)
            if (i % 4 != 3) putchar(image.rgba[i] >= 1 ? 255 : (int)(255.0 * image.rgba[i] + 0.5));
    }
    if (err.code != ANG_OK) fprintf(stderr, "%s\n", err.message);
    if (cpu) ang_method_cpu.destroy(cpu);
    ang_image_clear(&image), ang_transfer_free(skin), ang_volume_free(head);
    return (int)err.code;
}
