// From voxel index space about the box's centre to clip coordinates: ang_clip_space in float.
uniform vec4 clip_x; // gradient and constant
uniform vec4 clip_y;
uniform vec4 clip_w;

vec4 slice_project(vec3 place, int group) {
    float w = dot(clip_w.xyz, place) + clip_w.w;
    // A group has one depth, rising from group to group and never 0, which marks finished pixels.
    float depth = 2.0 * float(group + 1) / (float(slice_count) / float(slice_group) + 2.0) - 1.0;
    return vec4(dot(clip_x.xyz, place) + clip_x.w, dot(clip_y.xyz, place) + clip_y.w, depth * w, w);
}
