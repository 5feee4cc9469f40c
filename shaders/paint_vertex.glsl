// A triangle list in pixels of the window from its left top corner, with one colour a corner.
layout(location = 0) in vec2 place;
layout(location = 1) in vec2 texture_place;
layout(location = 2) in vec4 colour;
uniform vec4 to_clip; // scale and offset
out vec2 at;
out vec4 ink;

void main() {
    at = texture_place;
    ink = colour;
    gl_Position = vec4(place * to_clip.xy + to_clip.zw, 0.0, 1.0);
}
