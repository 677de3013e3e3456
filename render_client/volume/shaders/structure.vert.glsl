// A corner of a triangle of a soft structure.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
uniform mat4 to_clip;
out vec3 place, surface_normal, surface_colour;

void main() {
    place = position;
    surface_normal = normal;
    surface_colour = colour;
    gl_Position = to_clip * vec4(position, 1.0);
}
