// The shaders of view-aligned slices, GLSL 3.30; the fragment shader follows cut_shading_glsl. Lengths are
// in voxels, in texture coordinates of the bone's box, axes are the patient's.
#pragma once

namespace osteomill {

/// A slice is drawn half a step before where it samples: it stands for the half steps on either side of it.
inline constexpr const char* slice_vertex_glsl = R"glsl(#version 330 core
layout(location = 0) in vec3 place;
uniform mat4 to_clip;
uniform vec3 eye, forward;
uniform float spacing;
out vec3 sampled;

void main() {
    sampled = place;
    float depth = dot(place - eye, forward);
    gl_Position = to_clip * vec4(eye + (1.0 - 0.5 * spacing / depth) * (place - eye), 1.0);
}
)glsl";

inline constexpr const char* slice_fragment_glsl = R"glsl(
const int solid_pass = 0, light_pass = 1, depth_pass = 2;
uniform vec3 eye, forward;
uniform float spacing;
uniform int drawn_pass;
in vec3 sampled;
out vec4 pixel;

void main() {
    vec3 from_eye = sampled - eye;
    vec3 direction = normalize(from_eye);
    vec3 along = from_eye * (spacing / dot(from_eye, forward));  // from the slice before, on this ray
    pixel = vec4(0.0);
    if (fraction_at(sampled) < bone_surface || is_cut_away(sampled)) discard;
    if (drawn_pass == light_pass) {
        pixel = translucent_piece(sampled, length(along));
        return;
    }
    if (drawn_pass == depth_pass) {
        if (look_at(sampled).a < solid_opacity) discard;
        return;
    }
    float outside = 1.0, inside = 0.0;  // in steps before the slice
    for (int halving = 0; halving < 6; ++halving) {
        float middle = 0.5 * (outside + inside);
        vec3 before = sampled - middle * along;
        if (fraction_at(before) >= bone_surface && !is_cut_away(before)) inside = middle;
        else outside = middle;
    }
    pixel = vec4(shown_pixel(sampled - inside * along, direction), 1.0);
}
)glsl";

/// Follows lighting_glsl and look_glsl: the background behind gathered light.
inline constexpr const char* blend_fragment_glsl = R"glsl(
uniform sampler2D light;
uniform vec2 picture_size;
out vec4 pixel;

void main() {
    vec4 gathered = texelFetch(light, ivec2(gl_FragCoord.xy), 0);
    vec3 behind = background_at(gl_FragCoord.xy / picture_size);
    pixel = vec4(display(gathered.rgb + (1.0 - gathered.a) * behind), 1.0);
}
)glsl";

}  // namespace osteomill
