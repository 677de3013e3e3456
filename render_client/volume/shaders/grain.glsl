// Grain of bone: its colour varies from place to place, finely in cortical bone and coarsely in trabecular bone (shading_settings.h);
// follows bone_sampling.glsl. The pattern is value noise of hashed lattice points in patient space: it stays with the bone, is the
// same in every run, and needs no file.
//
//     float grain_at(vec3 point)                  share by which the bone just there is lighter than its colour, negative: darker
//     vec3  grained(vec3 colour, float grain)     a colour with that grain: what is darker is also browner
//     const bool bone_has_grain                   given ahead of this file

uniform vec3 grain_corner_mm;  // of the box, patient space
uniform vec2 grain_seen;       // share of the fine and of the coarse grain that is left where a pixel covers much of it

const float fine_grain_mm = 0.25, coarse_grain_mm = 0.9;
const int grain_seed = 59;

// -1 to 1.
float grain_of_cell(ivec3 cell) {
    uvec3 at = uvec3(cell + grain_seed);
    uint bits = at.x * 73856093u ^ at.y * 19349663u ^ at.z * 83492791u;
    bits = (bits ^ (bits >> 15)) * 0x2c1b3c6du;
    bits = (bits ^ (bits >> 12)) * 0x297a2d39u;
    return float(bits >> 8) * (2.0 / 16777215.0) - 1.0;
}

float smooth_grain(vec3 place) {
    ivec3 low = ivec3(floor(place));
    vec3 part = place - vec3(low);
    part *= part * (3.0 - 2.0 * part);
    vec4 near_far_x;
    for (int side = 0; side < 4; ++side) {
        ivec3 cell = low + ivec3(0, side & 1, side >> 1);
        near_far_x[side] = mix(grain_of_cell(cell), grain_of_cell(cell + ivec3(1, 0, 0)), part.x);
    }
    return mix(mix(near_far_x[0], near_far_x[1], part.y), mix(near_far_x[2], near_far_x[3], part.y), part.z);
}

float grain_at(vec3 point) {
    vec2 strength = grain_seen * texelFetch(bone_colours, ivec2(int(code_of(ivec3(floor(point)))), 1), 0).rg;
    vec3 place_mm = grain_corner_mm + bone_mm_per_voxel * point;
    return strength.x * smooth_grain(place_mm / fine_grain_mm) + strength.y * smooth_grain(place_mm / coarse_grain_mm);
}

vec3 grained(vec3 colour, float grain) { return colour * max(1.0 + grain * vec3(0.85, 1.0, 1.3), 0.0); }
