// The background's colour; set_background_uniforms sets its uniforms.
//
//     vec3  background_at(vec2 place)      linear RGB; place 0 to 1 from the picture's lower left corner

uniform vec3 background_low, background_high;

vec3 background_at(vec2 place) {
    vec3 shade = mix(background_low, background_high, smoothstep(0.0, 1.0, place.y));
    return shade * (1.0 - 0.35 * dot(place - 0.5, place - 0.5));
}
