// The lights of the scene; lighting.cpp has the same for the CPU.
//
//     vec3  lit(vec3 colour, vec3 normal, float openness)   linear RGB that a surface sends back
//     float highlight(vec3 normal, vec3 to_eye)             of the lamps, 0 to 1.4, on what is polished or
//     wet vec3  display(vec3 linear)                            as the display takes it

const vec3 key_direction = vec3(-0.4364, -0.5455, 0.7155);
const vec3 fill_direction = vec3(0.8944, -0.2236, 0.3873);

vec3 lit(vec3 colour, vec3 normal, float openness) {
    float key = max(dot(normal, key_direction), 0.0);
    float fill = max(dot(normal, fill_direction), 0.0);
    vec3 ambient = mix(vec3(0.14, 0.125, 0.115), vec3(0.285, 0.28, 0.29), 0.5 + 0.5 * normal.z);
    vec3 light = ambient * openness + vec3(0.66, 0.63, 0.58) * key * mix(0.45, 1.0, openness) +
                 vec3(0.17, 0.165, 0.175) * fill * openness;
    return colour * light;
}

// Blinn's.
float highlight_of(vec3 lamp, vec3 normal, vec3 to_eye) {
    return pow(max(dot(normal, normalize(to_eye + lamp)), 0.0), 48.0);
}

float highlight(vec3 normal, vec3 to_eye) {
    return highlight_of(key_direction, normal, to_eye) + 0.4 * highlight_of(fill_direction, normal, to_eye);
}

vec3 display(vec3 linear) {
    return pow(clamp(linear, 0.0, 1.0), vec3(1.0 / 2.2));
}
