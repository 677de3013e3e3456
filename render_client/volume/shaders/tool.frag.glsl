// A pixel of the tool: lit as bone is, with a highlight; follows lighting.glsl.

uniform float opacity;
uniform float polish;  // 0 matt, 1 steel
uniform vec3 eye;
// Part of a shank that may lie before the burr: 0 all of it, 1 all but the part that is seen through, 2 only
// that part.
uniform float sees_through;
uniform vec2 field_middle_px;   // what it must not hide, on the screen: the burr, enlarged where that is tiny
uniform float field_radius_px;
uniform float field_radius_mm;  // the same at the burr
uniform vec3 burr_centre;
uniform vec3 forward;
in vec3 patient_position, patient_normal, surface_colour;
out vec4 pixel;

const float clear_radii = 1.5, edge_radii = 2.5;      // off the burr's centre: seen through within, solid beyond
const float solid_depth = 1.0, clear_depth = 2.0;     // before the burr, in radii
const float clear_opacity = 0.22;

// 0 solid, 1 in the way.
float hides() {
    float aside = distance(gl_FragCoord.xy, field_middle_px) / field_radius_px;
    float before = dot(burr_centre - patient_position, forward) / field_radius_mm;
    return smoothstep(solid_depth, clear_depth, before) * (1.0 - smoothstep(clear_radii, edge_radii, aside));
}

void main() {
    float in_the_way = sees_through > 0.0 ? hides() : 0.0;
    if (sees_through > 0.0 && (in_the_way > 0.0) != (sees_through > 1.5)) discard;
    vec3 normal = normalize(patient_normal);
    vec3 to_eye = normalize(eye - patient_position);
    vec3 light = 1.25 * lit(surface_colour, normal, 1.0) + 0.55 * polish * highlight(normal, to_eye);
    pixel = vec4(display(light), opacity * mix(1.0, clear_opacity, in_the_way));
}
