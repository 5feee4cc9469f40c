// Every vertex is a cell of the envelope's grid; there is no list of points (Haferburg, "Computing the bounding
// geometry").
flat out int hull_cell;

void main() {
    gl_Position = vec4(0.0);
    hull_cell = gl_VertexID;
}
