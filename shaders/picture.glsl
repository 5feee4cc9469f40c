layout(location = 0) out vec4 picture;

void main() {
    Ray ray = ray_through(gl_FragCoord.xy);
    float samples;
    picture = vec4(0.0);
    if (ray.enter < ray.leave) picture = march(ray, samples);
}
