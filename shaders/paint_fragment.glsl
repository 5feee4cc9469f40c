uniform sampler2D picture;
in vec2 at;
in vec4 ink;
layout(location = 0) out vec4 shown;

void main() { shown = ink * texture(picture, at); }
