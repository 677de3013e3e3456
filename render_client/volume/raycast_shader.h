// The ray caster's shaders, GLSL 3.30; the fragment shader follows bone_sampling_glsl and
// look_glsl. Lengths are in voxels,
// in texture coordinates of the bone's box (the first voxel spans 0 to 1), axes are the patient's.
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

inline constexpr const char* raycast_fragment_glsl = R"glsl(
uniform vec3 eye;
uniform vec3 forward;
uniform vec2 depth_terms;      // window depth = x + y / distance along forward
uniform float step_length;
uniform bool skips;
uniform vec2 picture_size;
in vec3 ray;
out vec4 pixel;

const float surface = 0.5;

void draw_background() {
    pixel = vec4(display(background_at(gl_FragCoord.xy / picture_size)), 1.0);
    gl_FragDepth = 1.0;
}

void main() {
    vec3 direction = normalize(ray);
    direction = mix(direction, vec3(1e-6), lessThan(abs(direction), vec3(1e-6)));
    // One voxel beyond the box on every side the fraction has fallen to zero.
    vec3 to_low = (vec3(-1.0) - eye) / direction;
    vec3 to_high = (bone_size + 1.0 - eye) / direction;
    vec3 enter3 = min(to_low, to_high);
    vec3 leave3 = max(to_low, to_high);
    float enter = max(max(enter3.x, enter3.y), max(enter3.z, 0.0));
    float leave = min(leave3.x, min(leave3.y, leave3.z));
    int cut = clip_by_cuts(eye, direction, enter, leave);

    // Samples stand on one lattice along the ray, skipped or not, so skipping cannot change the picture.
    float index = 0.0;
    bool hit = false;
    for (int visit = 0; visit < 16384; ++visit) {
        float distance_along = enter + index * step_length;
        if (distance_along > leave) break;
        vec3 p = eye + distance_along * direction;
        float leap = skips ? free_length(p, direction) : 0.0;
        if (leap > 0.0) {
            index += max(ceil(leap / step_length), 1.0);
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
    // A ray that begins in bone sees the face of a cut: flat, and open to the sky.
    bool in_cut = cut >= 0 && index == 0.0;
    vec3 normal = in_cut ? cut_planes[cut].xyz : normal_at(p, -direction);
    vec3 colour = colour_at(p - 0.6 * normal);
    pixel = vec4(display(lit(colour, normal, in_cut ? 1.0 : openness_at(p, normal))), 1.0);
    gl_FragDepth = depth_terms.x + depth_terms.y / (inside * dot(direction, forward));
}
)glsl";

}  // namespace osteomill
