layout(location = 0) out vec4 picture;
layout(location = 1) out float counted; // field evaluations, 0 where the ray misses the box

void main() {
    Ray ray = ray_through(gl_FragCoord.xy);
    float samples = 0.0;
    picture = vec4(0.0);
    if (ray.enter < ray.leave) picture = march(ray, samples);
    counted = samples;
}
