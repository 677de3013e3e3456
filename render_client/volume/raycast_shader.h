// The ray caster's shaders, GLSL 3.30. Lengths are in voxels, in texture coordinates of the bone's box (the
// first voxel spans 0 to 1), axes are the patient's.
#pragma once

namespace osteomill {

inline constexpr const char* raycast_vertex_glsl = R"glsl(#version 330 core
uniform vec3 forward, right, up;  // right and up reach from the picture's middle to its edge at distance 1
out vec3 ray;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    ray = forward + corner.x * right + corner.y * up;
    gl_Position = vec4(corner, 0.0, 1.0);
}
)glsl";

inline constexpr const char* raycast_fragment_head_glsl = R"glsl(#version 330 core
uniform sampler3D fraction;
uniform sampler3D mean_fraction;
uniform usampler3D skip_distance;
uniform usampler3D colour_code;
uniform sampler2D colours;
uniform vec3 size;             // of the box
uniform vec3 eye;
uniform vec3 forward;
uniform vec2 depth_terms;      // window depth = x + y / distance along forward
uniform float step_length;
uniform bool skips, has_colour_code, code_zero_is_unknown;
uniform vec2 picture_size;
in vec3 ray;
out vec4 pixel;
)glsl";

inline constexpr const char* raycast_fragment_glsl = R"glsl(
const float block_edge = 4.0;
const float surface = 0.5;

float fraction_at(vec3 p) { return textureLod(fraction, p / size, 0.0).r; }

// Points out of the bone. Eight corners of a cube: central differences smoothed across their axis, which hides
// that a fraction rises from none to all within about one voxel.
vec3 normal_at(vec3 p) {
    const float reach = 1.4;
    vec3 gradient = vec3(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        vec3 side = vec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1) * 2.0 - 1.0;
        gradient += side * fraction_at(p + reach * side);
    }
    float steepness = length(gradient);
    return steepness > 1e-4 ? -gradient / steepness : -normalize(ray);
}

// Colours of the eight nearest voxels blended trilinearly, so that tissues meet without steps.
vec3 colour_at(vec3 p) {
    if (!has_colour_code) return texelFetch(colours, ivec2(0), 0).rgb;
    vec3 place = p - 0.5;
    ivec3 low = ivec3(floor(place));
    vec3 part = place - vec3(low);
    ivec3 last = ivec3(size) - 1;
    vec3 sum = vec3(0.0);
    float known = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 side = ivec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
        uint code = texelFetch(colour_code, clamp(low + side, ivec3(0), last), 0).r;
        if (code == 0u && code_zero_is_unknown) continue;
        vec3 weights = mix(1.0 - part, part, vec3(side));
        float weight = weights.x * weights.y * weights.z + 1e-5;
        sum += weight * texelFetch(colours, ivec2(int(code), 0), 0).rgb;
        known += weight;
    }
    return known > 0.0 ? sum / known : texelFetch(colours, ivec2(0), 0).rgb;
}

// How much of the sky above a surface is free of bone, by the mean fractions of blocks near and far.
float openness_at(vec3 p, vec3 normal) {
    vec3 map_size = size / block_edge + 2.0;
    vec3 aside = normalize(abs(normal.z) < 0.8 ? cross(normal, vec3(0, 0, 1)) : cross(normal, vec3(1, 0, 0)));
    vec3 across = cross(normal, aside);
    float taken = 0.0;
    for (int ring = 0; ring < 4; ++ring) {
        vec2 lean = ring == 0 ? vec2(1, 0) : ring == 1 ? vec2(-1, 0) : ring == 2 ? vec2(0, 1) : vec2(0, -1);
        vec3 slanted = normalize(normal + 0.9 * (lean.x * aside + lean.y * across));
        taken += textureLod(mean_fraction, ((p + 7.0 * slanted) / block_edge + 1.0) / map_size, 0.0).r;
        taken += textureLod(mean_fraction, ((p + 16.0 * slanted) / block_edge + 1.0) / map_size, 0.0).r;
    }
    return clamp(1.15 - 0.14 * taken, 0.0, 1.0);
}

// Samples to go on from a point so that none that could meet the surface is left out; at least one.
float samples_to_leap(vec3 p, vec3 direction) {
    ivec3 block = ivec3(floor(p / block_edge)) + 1;
    int away = int(texelFetch(skip_distance, clamp(block, ivec3(0), ivec3(size / block_edge) + 1), 0).r);
    if (away == 0) return 0.0;
    vec3 low = vec3(block - away) * block_edge;
    vec3 high = vec3(block + away - 1) * block_edge;
    vec3 leave = (mix(low, high, greaterThan(direction, vec3(0.0))) - p) / direction;
    return max(ceil(min(leave.x, min(leave.y, leave.z)) / step_length), 1.0);
}

void draw_background() {
    float height = gl_FragCoord.y / picture_size.y;
    vec2 off_centre = gl_FragCoord.xy / picture_size - 0.5;
    vec3 shade = mix(vec3(0.035, 0.040, 0.048), vec3(0.115, 0.130, 0.150), smoothstep(0.0, 1.0, height));
    pixel = vec4(display(shade * (1.0 - 0.35 * dot(off_centre, off_centre))), 1.0);
    gl_FragDepth = 1.0;
}

void main() {
    vec3 direction = normalize(ray);
    direction = mix(direction, vec3(1e-6), lessThan(abs(direction), vec3(1e-6)));
    // One voxel beyond the box on every side the fraction has fallen to zero.
    vec3 to_low = (vec3(-1.0) - eye) / direction;
    vec3 to_high = (size + 1.0 - eye) / direction;
    vec3 enter3 = min(to_low, to_high);
    vec3 leave3 = max(to_low, to_high);
    float enter = max(max(enter3.x, enter3.y), max(enter3.z, 0.0));
    float leave = min(leave3.x, min(leave3.y, leave3.z));

    // Samples stand on one lattice along the ray, skipped or not, so skipping cannot change the picture.
    float index = 0.0;
    bool hit = false;
    for (int visit = 0; visit < 16384; ++visit) {
        float distance_along = enter + index * step_length;
        if (distance_along > leave) break;
        vec3 p = eye + distance_along * direction;
        float leap = skips ? samples_to_leap(p, direction) : 0.0;
        if (leap > 0.0) {
            index += leap;
            continue;
        }
        if (fraction_at(p) >= surface) {
            hit = true;
            break;
        }
        index += 1.0;
    }
    if (!hit) {
        draw_background();
        return;
    }

    float outside = enter + max(index - 1.0, 0.0) * step_length;
    float inside = enter + index * step_length;
    for (int halving = 0; halving < 6; ++halving) {
        float middle = 0.5 * (outside + inside);
        if (fraction_at(eye + middle * direction) >= surface) inside = middle;
        else outside = middle;
    }
    vec3 p = eye + inside * direction;
    vec3 normal = normal_at(p);
    vec3 colour = colour_at(p - 0.6 * normal);
    pixel = vec4(display(lit(colour, normal, openness_at(p, normal))), 1.0);
    gl_FragDepth = depth_terms.x + depth_terms.y / (inside * dot(direction, forward));
}
)glsl";

}  // namespace osteomill
