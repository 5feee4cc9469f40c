// From what slices have accumulated to the picture, for every ray that meets the box: where nothing was drawn, all that
// it meets is what the clear value stands for.
uniform sampler2D slice_accumulated;
layout(location = 0) out vec4 picture;

void main() {
    Ray ray = ray_through(gl_FragCoord.xy);
    picture = vec4(0.0);
    if (ray.enter < ray.leave)
        picture = window_grey(resolve_value(texelFetch(slice_accumulated, ivec2(gl_FragCoord.xy), 0)));
}
