// A microscope's round field of light: its edge is soft, beyond it is black. The lamp shines along the view, as a spot: what lies
// aside gets less of it, and what lies deeper than the focus by the square of the distance; light_field.h has the same.

uniform sampler2D bone_depth;
uniform vec2 picture_size;
uniform float pixel_aspect;
uniform vec2 depth_terms;  // window depth = x + y / distance along forward
uniform float focus;       // distance
out vec4 pixel;

const float softness = 0.06;  // of the radius, which is half the picture's lesser side
const float light_at_edge = 0.55;

void main() {
    vec2 shown = picture_size * vec2(pixel_aspect, 1.0);
    vec2 away = (gl_FragCoord.xy - 0.5 * picture_size) * vec2(pixel_aspect, 1.0);
    float radius = length(away) / (0.5 * min(shown.x, shown.y));
    float depth = texelFetch(bone_depth, ivec2(gl_FragCoord.xy), 0).r;
    float nearness = depth < 1.0 ? min(focus * (depth - depth_terms.x) / depth_terms.y, 1.0) : 1.0;
    float light = mix(1.0, light_at_edge, min(radius * radius, 1.0)) * nearness * nearness;
    pixel = vec4(display(vec3(light)) * (1.0 - smoothstep(1.0 - softness, 1.0, radius)), 1.0);
}
