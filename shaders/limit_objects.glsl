// Opaque geometry ends rays: mm along each, ang_object_layer.
uniform sampler2D ray_limits;

float ray_limit(vec2 pixel) {
    return texelFetch(ray_limits, ivec2(pixel), 0).r;
}
