// Values between the centres of two texels as the texture unit gives them: probe i lies at (i + 0.5) / probe_count.
layout(local_size_x = 64) in;

uniform sampler3D field_values;
uniform int probe_count;

layout(std430, binding = 0) writeonly buffer Probes {
    float probes[];
};

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= probe_count) return;
    float between = (float(i) + 0.5) / float(probe_count);
    probes[i] = textureLod(field_values, vec3(0.25 + 0.5 * between, 0.5, 0.5), 0.0).r;
}
