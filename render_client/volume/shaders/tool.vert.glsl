// A corner of a triangle of the tool.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
uniform mat4 to_clip;
uniform mat4 to_patient;
uniform mat3 normal_to_patient;
out vec3 patient_position, patient_normal, surface_colour;

void main() {
    patient_position = vec3(to_patient * vec4(position, 1.0));
    patient_normal = normal_to_patient * normal;
    surface_colour = colour;
    gl_Position = to_clip * vec4(position, 1.0);
}
