// What a fragment shader can ask about the bone, GLSL 3.30: the part that every renderer shares. BoneProgram
// puts it in front of a renderer's own shader and binds the textures behind it.
//
// Points are in voxels, in texture coordinates of the bone's box: the first voxel spans 0 to 1, axes are the
// patient's. Every function takes any point; far outside the box there is no bone.
//
//     vec3  bone_size                               uniform: the box, voxels
//     float fraction_at(vec3 point)                 0 to 1, trilinear between voxels
//     vec3  gradient_at(vec3 point)                 of the fraction, 1 / voxel; points into the bone
//     vec3  normal_at(vec3 point, vec3 otherwise)   unit, out of the bone; `otherwise` where nothing slopes
//     vec4  look_at(vec3 point)                     linear RGB and opacity of the bone that is or was there
//     float density_at(vec3 point)                  the fraction times the opacity of the nearest voxel
//     vec4  surface_colour_at(vec3 point)           of surface voxels nearby: display RGB times alpha, alpha
//     float openness_at(vec3 point, vec3 normal)    0 to 1, how much of the sky above a surface is free of
//                                                   bone
//     float free_length(vec3 point, vec3 direction) voxels along a unit direction (no component may be zero)
//                                                   in which the fraction stays below one half; 0 if unknown
//     bool  bone_is_translucent                     opacities are per mm, else bone is solid
//     bool  bone_has_surface_colours                else surface_colour_at means nothing
//     float bone_mm_per_voxel
#pragma once

namespace osteomill {

/// How far from a voxel, along an axis, a surface can lie whose shading depends on it: openness_at looks 16
/// voxels away into a map of 4-voxel blocks whose interpolation reads 2 voxels beyond each; one in reserve.
inline constexpr int shading_reach_voxels = 19;

inline constexpr const char* bone_sampling_glsl = R"glsl(
uniform sampler3D bone_fraction;
uniform sampler3D bone_mean_fraction;
uniform usampler3D bone_skip_distance;
uniform usampler3D bone_colour_code;
uniform sampler2D bone_colours;
uniform sampler3D bone_surface_colours;
uniform vec3 bone_size;
uniform float bone_mm_per_voxel;
uniform bool bone_has_colour_code, bone_has_surface_colours, bone_is_translucent;

const float block_edge = 4.0;

float fraction_at(vec3 point) { return textureLod(bone_fraction, point / bone_size, 0.0).r; }

// Eight corners of a cube: central differences smoothed across their axis, which hides that a fraction rises
// from none to all within about one voxel.
vec3 gradient_at(vec3 point) {
    const float reach = 1.4;
    vec3 gradient = vec3(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        vec3 side = vec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1) * 2.0 - 1.0;
        gradient += side * fraction_at(point + reach * side);
    }
    return gradient / (8.0 * reach);
}

vec3 normal_at(vec3 point, vec3 otherwise) {
    vec3 gradient = gradient_at(point);
    float steepness = length(gradient);
    return steepness > 1e-5 ? -gradient / steepness : otherwise;
}

uint code_at(ivec3 voxel) {
    if (!bone_has_colour_code) return 0u;
    return texelFetch(bone_colour_code, clamp(voxel, ivec3(0), ivec3(bone_size) - 1), 0).r;
}

float density_at(vec3 point) {
    uint code = code_at(ivec3(floor(point)));
    return fraction_at(point) * texelFetch(bone_colours, ivec2(int(code), 0), 0).a;
}

vec4 surface_colour_at(vec3 point) { return textureLod(bone_surface_colours, point / bone_size, 0.0); }

// Looks of the eight nearest voxels blended trilinearly, so that tissues meet without steps. What is hidden
// does not tinge what stands beside it.
vec4 look_at(vec3 point) {
    if (!bone_has_colour_code) return texelFetch(bone_colours, ivec2(0), 0);
    vec3 place = point - 0.5;
    ivec3 low = ivec3(floor(place));
    vec3 part = place - vec3(low);
    vec4 sum = vec4(0.0);
    float known = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 side = ivec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
        uint code = code_at(low + side);
        vec4 look = texelFetch(bone_colours, ivec2(int(code), 0), 0);
        if (code == 0u || look.a == 0.0) continue;
        vec3 weights = mix(1.0 - part, part, vec3(side));
        float weight = weights.x * weights.y * weights.z + 1e-5;
        sum += weight * look;
        known += weight;
    }
    return known > 0.0 ? sum / known : texelFetch(bone_colours, ivec2(0), 0);
}

float mean_fraction_at(vec3 point) {
    vec3 map_size = bone_size / block_edge + 2.0;
    return textureLod(bone_mean_fraction, (point / block_edge + 1.0) / map_size, 0.0).r;
}

// By the mean fractions of blocks near and far in four directions round the normal.
float openness_at(vec3 point, vec3 normal) {
    vec3 aside = normalize(abs(normal.z) < 0.8 ? cross(normal, vec3(0, 0, 1)) : cross(normal, vec3(1, 0, 0)));
    vec3 across = cross(normal, aside);
    float taken = 0.0;
    for (int ring = 0; ring < 4; ++ring) {
        vec2 lean = ring == 0 ? vec2(1, 0) : ring == 1 ? vec2(-1, 0) : ring == 2 ? vec2(0, 1) : vec2(0, -1);
        vec3 slanted = normalize(normal + 0.9 * (lean.x * aside + lean.y * across));
        taken += mean_fraction_at(point + 7.0 * slanted) + mean_fraction_at(point + 16.0 * slanted);
    }
    return clamp(1.15 - 0.14 * taken, 0.0, 1.0);
}

// To the faces of the cube of blocks that the distance map says is empty.
float free_length(vec3 point, vec3 direction) {
    ivec3 block = ivec3(floor(point / block_edge)) + 1;
    ivec3 last = ivec3(bone_size / block_edge) + 1;
    int away = int(texelFetch(bone_skip_distance, clamp(block, ivec3(0), last), 0).r);
    if (away == 0) return 0.0;
    vec3 low = vec3(block - away) * block_edge;
    vec3 high = vec3(block + away - 1) * block_edge;
    vec3 leave = (mix(low, high, greaterThan(direction, vec3(0.0))) - point) / direction;
    return max(min(leave.x, min(leave.y, leave.z)), 0.0);
}
)glsl";

}  // namespace osteomill
