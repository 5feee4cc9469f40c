// Where the ray meets the plane of this face, mm from where it enters the clip box; blending keeps the least of each
// channel. Parameters of the ray instead of depths: nothing is lost to the depth buffer's scale (numerics.md).
flat in int hull_axis;
flat in float hull_plane;
flat in float hull_outward;
layout(location = 0) out vec4 hull_range; // the nearest face, the farthest negated, the nearest that is left through

void main() {
    Ray ray = ray_through(gl_FragCoord.xy);
    float reach = ray.leave - ray.enter;
    float direction = ray.direction[hull_axis];
    bool along = abs(direction) < 1e-12; // in the plane of the face: it says nothing
    float t = (hull_plane - ray.origin[hull_axis]) / (along ? 1.0 : direction) - ray.enter;
    t = clamp(t, 0.0, max(reach, 0.0));
    bool leaves = direction * hull_outward > 0.0;
    hull_range = along ? vec4(0.0, -reach, 0.0, 0.0) : vec4(t, -t, leaves ? t : 1e30, 0.0);
}
