// The least and the greatest stored value of every leaf's voxels, those on its upper faces included, which its neighbours
// have as well (Haferburg, "Computing the grid volume texture"; core/volume/octree.h).
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

uniform sampler3D field_values;
uniform ivec3 leaf_cells;
uniform ivec3 leaf_count;

layout(std430, binding = 0) writeonly buffer Ranges {
    uint ranges[]; // least in the lower half
};

void main() {
    ivec3 leaf = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(leaf, leaf_count))) return;
    ivec3 first = leaf * leaf_cells;
    ivec3 last = min(first + leaf_cells, textureSize(field_values, 0) - 1);
    float least = 1.0;
    float greatest = 0.0;
    for (int z = first.z; z <= last.z; z++)
        for (int y = first.y; y <= last.y; y++)
            for (int x = first.x; x <= last.x; x++) {
                float value = texelFetch(field_values, ivec3(x, y, z), 0).r;
                least = min(least, value);
                greatest = max(greatest, value);
            }
    int index = leaf.x + leaf_count.x * (leaf.y + leaf_count.y * leaf.z);
    ranges[index] = uint(round(65535.0 * least)) | uint(round(65535.0 * greatest)) << 16;
}
