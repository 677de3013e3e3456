// A microscope's round field of light: its edge is soft, beyond it is black.

uniform vec2 picture_size;
uniform float pixel_aspect;
out vec4 pixel;

const float softness = 0.06;  // of the radius, which is half the picture's lesser side

void main() {
    vec2 shown = picture_size * vec2(pixel_aspect, 1.0);
    vec2 away = (gl_FragCoord.xy - 0.5 * picture_size) * vec2(pixel_aspect, 1.0);
    float radius = length(away) / (0.5 * min(shown.x, shown.y));
    pixel = vec4(vec3(1.0 - smoothstep(1.0 - softness, 1.0, radius)), 1.0);
}
