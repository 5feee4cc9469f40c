// The faces between an active cell and its inactive neighbours, one packed number each: 9 bits of a cell's coordinate
// along x, y, z at bits 0, 10, 20; at bit 9 whether the face is the upper one; at bits 30 and 31 its axis.
layout(points) in;
layout(points, max_vertices = 6) out;

uniform usampler3D hull_active;

flat in int hull_cell[];
flat out uint hull_face;

bool is_active(ivec3 cell) {
    bool inside = all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, textureSize(hull_active, 0)));
    return inside && texelFetch(hull_active, clamp(cell, ivec3(0), textureSize(hull_active, 0) - 1), 0).r != 0u;
}

void main() {
    ivec3 n = textureSize(hull_active, 0);
    int row = hull_cell[0] / n.x;
    ivec3 cell = ivec3(hull_cell[0] % n.x, row % n.y, row / n.y);
    if (!is_active(cell)) return;
    for (int side = 0; side < 6; side++) {
        int axis = side >> 1;
        ivec3 step = ivec3(axis == 0, axis == 1, axis == 2) * (2 * (side & 1) - 1);
        if (is_active(cell + step)) continue;
        hull_face = uint(cell.x) | uint(cell.y) << 10 | uint(cell.z) << 20 | uint(side & 1) << 9 | uint(axis) << 30;
        EmitVertex();
        EndPrimitive();
    }
}
