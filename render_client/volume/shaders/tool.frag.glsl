// A pixel of the tool: lit as bone is, with a highlight; follows lighting.glsl.

uniform float opacity;
uniform float polish;  // 0 matt, 1 steel
uniform vec3 eye;
in vec3 patient_position, patient_normal, surface_colour;
out vec4 pixel;

// Blinn's highlight of the two lamps.
float highlight(vec3 normal, vec3 to_eye, vec3 lamp) {
    return pow(max(dot(normal, normalize(to_eye + lamp)), 0.0), 48.0);
}

void main() {
    vec3 normal = normalize(patient_normal);
    vec3 to_eye = normalize(eye - patient_position);
    float shine = highlight(normal, to_eye, key_direction) + 0.4 * highlight(normal, to_eye, fill_direction);
    vec3 light = 1.25 * lit(surface_colour, normal, 1.0) + 0.55 * polish * shine;
    pixel = vec4(display(light), opacity);
}
