// The shadow of the burr and its shank on the bone; follows lighting.glsl.
// Points are relative to the burr's centre, in burr radii; patient axes.

uniform sampler2D bone_depth;
uniform vec2 picture_size;
uniform vec2 depth_terms;  // window depth = x + y / distance along forward
uniform vec3 eye;
uniform vec3 spindle_axis;
in vec3 ray;
out vec4 pixel;

const float reach = 6.0;             // radii beyond which nothing is darkened
const float shank_radius = 0.5;
const float shank_length = 6.0;
const float lamp_half_angle = 0.12;  // rad: how fast the shadow's edge widens

// Share of the lamp that a ball covers: soft between the edges of core and half-shadow.
float shadow_of_ball(vec3 to_ball, float radius) {
    float along = dot(to_ball, key_direction);
    if (along <= 0.0) return 0.0;
    float aside = length(to_ball - along * key_direction);
    float half_shadow = lamp_half_angle * along;
    return 1.0 - smoothstep(radius - half_shadow, radius + half_shadow, aside);
}

void main() {
    float depth = texture(bone_depth, gl_FragCoord.xy / picture_size).r;
    if (depth >= 1.0) discard;
    vec3 point = eye + depth_terms.y / (depth - depth_terms.x) * ray;
    float away = length(point);
    if (away > reach) discard;
    // The shank counts as a ball at the point of the spindle that the lamp's ray comes closest to.
    float lean = dot(spindle_axis, key_direction);
    float station = (dot(-point, key_direction) * lean + dot(point, spindle_axis)) / max(1.0 - lean * lean, 0.02);
    vec3 shank = clamp(station, 1.0, shank_length) * spindle_axis;
    float shadow = max(shadow_of_ball(-point, 1.0), shadow_of_ball(shank - point, shank_radius));
    float contact = 1.0 / max(away * away, 1.0);
    float fade = 1.0 - smoothstep(0.5 * reach, reach, away);
    float light = (1.0 - 0.5 * fade * shadow) * (1.0 - 0.55 * fade * contact);
    pixel = vec4(vec3(light), 1.0);
}
