// The surface of a mesh that a pixel shows, as numbers; behind tool.vert.glsl. Patient axes, mm.

uniform vec3 eye, forward;
uniform mat3 to_camera;        // axes right, down, forward
uniform int thing_number;
in vec3 patient_position, patient_normal;
layout(location = 0) out vec4 surface;  // xyz the normal, w mm along forward
layout(location = 1) out uint thing;

void main() {
    vec3 from_eye = patient_position - eye;
    vec3 normal = normalize(patient_normal);
    if (dot(normal, from_eye) > 0.0) normal = -normal;
    surface = vec4(to_camera * normal, dot(from_eye, forward));
    thing = uint(thing_number);
}
