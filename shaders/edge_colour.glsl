uniform vec4 edge_colour; // premultiplied
layout(location = 0) out vec4 picture;

void main() {
    picture = edge_colour;
}
