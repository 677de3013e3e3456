// Sampling of the bone in a fragment shader: the functions that every renderer shares. BoneProgram puts this file ahead
// of a renderer's own shader and binds its textures.
//
// Points are in voxels, in texture coordinates of the bone's box: the first voxel spans 0 to 1, axes are the
// patient's. Every function takes any point; far outside the box there is no bone.
//
//     vec3  bone_size                               uniform: the box, voxels
//     vec3  texture_place(vec3 point)               where a texture that is placed as the fractions are
//                                                   (AtlasLayout) holds the point, 0 to 1 along each edge
//     vec3  texture_place_beside(vec3 point, vec3 offset)
//                                                   the place of point + offset, at most half a voxel away, in the
//                                                   tile of the point: which knows what lies beside bone, too
//     ivec3 texel_shift(vec3 point)                 texel less voxel number, for the voxels of the box within
//                                                   one of the point
//     float fraction_at(vec3 point)                 0 to 1, trilinear between voxels
//     vec3  gradient_at(vec3 point)                 of the (smoothed) fraction, 1 / voxel; points into the bone
//     vec3  normal_at(vec3 point, vec3 otherwise)   unit, out of the bone; `otherwise` where nothing slopes
//     vec4  look_at(vec3 point)                     linear RGB and opacity of the bone that is or was there
//     vec4  smooth_look_at(vec3 point)              the same without a trace of the voxels' steps
//     vec3  place_under(vec3 point, vec3 normal)    where below a surface with that outward normal its look is read
//     float density_at(vec3 point)                  the fraction times the opacity of the nearest voxel
//     vec4  surface_colour_at(vec3 point)           of surface voxels nearby: display RGB times alpha, alpha
//     float ambient_occlusion(vec3 point, vec3 normal)    0 to 1, how much of the sky above a surface is free of
//                                                   bone
//     float way_in_blocks(vec3 point, vec3 direction, out bool is_empty)
//                                                   voxels along a unit direction (no component may be zero) to the faces of the
//                                                   blocks about the point that are empty: there the fraction stays below one
//                                                   half; or of its own block, in which it may not
//     const bool, by variant of the program:
//     bool  bone_has_colour_code                    else all bone looks alike
//     bool  bone_codes_are_mostly_alike             as within a tissue; else they are stiffness
//     bool  bone_is_translucent                     opacities are per mm, else bone is solid
//     bool  bone_has_smoothed                       normals are those of the smoothed fractions
//     bool  bone_has_surface_colours                else surface_colour_at means nothing
//     float bone_mm_per_voxel

uniform sampler3D bone_fraction;
uniform sampler3D bone_blocks;
uniform sampler3D bone_smoothed;
uniform usampler3D bone_colour_code;
uniform sampler2D bone_colours;
uniform sampler3D bone_surface_colours;
uniform float bone_mm_per_voxel;
uniform float bone_colour_depth;  // voxels

const float block_edge = 4.0;

float fraction_at(vec3 point) { return textureLod(bone_fraction, texture_place(point), 0.0).r; }

// The slope of a fraction, which rises from none to all within one voxel, turns with the lattice: normals would be
// off by 6 degrees at the 95th percentile, and light shows that as rings. If the fractions are smoothed over the voxels
// across which the slope is measured, normals are off by only 0.9 degrees (osteomill_study render, "normals").
const float corner_reach = 0.45;

vec3 side_of_corner(int corner) {
    return vec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1) * 2.0 - 1.0;
}

// Eight corners about the point: the mean slope between them.
vec3 gradient_of_smoothed(vec3 point) {
    vec3 gradient = vec3(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        vec3 side = side_of_corner(corner);
        gradient += side * textureLod(bone_smoothed, texture_place_beside(point, corner_reach * side), 0.0).r;
    }
    return gradient / (8.0 * corner_reach);
}

// Gradient without memory for smoothed fractions: 4^3 samples a voxel apart, which smooth about as much across the
// slope as along it.
vec3 gradient_by_samples(vec3 point) {
    vec3 gradient = vec3(0.0);
    for (int sample_number = 0; sample_number < 64; ++sample_number) {
        vec3 offset = vec3(sample_number & 3, (sample_number >> 2) & 3, sample_number >> 4) - 1.5;
        bvec3 is_outer = greaterThan(abs(offset), vec3(1.0));
        vec3 across = mix(vec3(3.5), vec3(1.0), is_outer), along = sign(offset) * mix(vec3(1.0), vec3(1.5), is_outer);
        gradient += along * across.yzx * across.zxy * fraction_at(point + offset);
    }
    return gradient / 445.5;
}

vec3 gradient_at(vec3 point) { return bone_has_smoothed ? gradient_of_smoothed(point) : gradient_by_samples(point); }

vec3 normal_at(vec3 point, vec3 otherwise) {
    vec3 gradient = gradient_at(point);
    float steepness = length(gradient);
    return steepness > 1e-5 ? -gradient / steepness : otherwise;
}

// `shift` is texel_shift of a point within one voxel.
uint code_at(ivec3 voxel, ivec3 shift) {
    if (!bone_has_colour_code) return 0u;
    return texelFetch(bone_colour_code, clamp(voxel, ivec3(0), ivec3(bone_size) - 1) + shift, 0).r;
}

// Code of any voxel.
uint code_of(ivec3 voxel) { return code_at(voxel, texel_shift(vec3(voxel) + 0.5)); }

float density_at(vec3 point) {
    uint code = code_at(ivec3(floor(point)), texel_shift(point));
    return fraction_at(point) * texelFetch(bone_colours, ivec2(int(code), 0), 0).a;
}

vec4 surface_colour_at(vec3 point) { return textureLod(bone_surface_colours, texture_place(point), 0.0); }

// Looks of eight voxels blended trilinearly; `part` is the place between them.
vec4 blended_eight(uint codes[8], vec3 part) {
    vec4 sum = vec4(0.0);
    float known = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        vec4 look = texelFetch(bone_colours, ivec2(int(codes[corner]), 0), 0);
        if (codes[corner] == 0u || look.a == 0.0) continue;
        vec3 weights = mix(1.0 - part, part, vec3(corner & 1, (corner >> 1) & 1, corner >> 2));
        float weight = weights.x * weights.y * weights.z + 1e-5;
        sum += weight * look;
        known += weight;
    }
    return known > 0.0 ? sum / known : texelFetch(bone_colours, ivec2(0), 0);
}

// Looks of the eight nearest voxels, so that tissues meet without steps. A hidden voxel does not tinge its neighbours.
vec4 look_at(vec3 point) {
    if (!bone_has_colour_code) return texelFetch(bone_colours, ivec2(0), 0);
    ivec3 low = ivec3(floor(point - 0.5));
    ivec3 shift = texel_shift(point);
    uint codes[8];
    uint others = 0u;
    for (int corner = 0; corner < 8; ++corner) {
        codes[corner] = code_at(low + ivec3(corner & 1, (corner >> 1) & 1, corner >> 2), shift);
        others |= codes[corner] ^ codes[0];
    }
    vec4 look = texelFetch(bone_colours, ivec2(int(codes[0]), 0), 0);
    // A loop of one turn or none, because a software rasteriser computes both sides of a branch but leaves a loop in
    // which there is no pixel of a group.
    int turns = others != 0u || codes[0] == 0u || look.a == 0.0 ? 1 : 0;
    for (int turn = 0; turn < turns; ++turn) look = blended_eight(codes, point - 0.5 - vec3(low));
    return look;
}

// Whether among the 4^3 nearest voxels, of which `low` is the first, one of the inner eight or of the corners has
// another code. A code missed between these is hardly seen. A loop of no turn where it is not asked: a software rasteriser computes
// both sides of a branch.
bool codes_differ_about(ivec3 low, uint code, bool is_asked) {
    uint others = 0u;
    int voxels = is_asked ? 16 : 0;
    for (int voxel = 0; voxel < voxels; ++voxel) {
        ivec3 side = ivec3(voxel & 1, (voxel >> 1) & 1, (voxel >> 2) & 1);
        others |= code_of(low + (voxel < 8 ? 1 + side : 3 * side)) ^ code;
    }
    return others != 0u;
}

// Looks of the 4^3 nearest voxels, blended so widely that borders between tissues, which run along the faces of voxels,
// are no stairs: a standard deviation of 0.9 voxels. Along each axis tents at this distance before and after the place are the weight.
const float tent_offset = 0.85;
vec4 wide_look(ivec3 low, vec3 part, bool is_asked) {
    vec4 sum = vec4(0.0);
    float known = 0.0;
    int voxels = is_asked ? 64 : 0;
    for (int voxel = 0; voxel < voxels; ++voxel) {
        ivec3 step = ivec3(voxel & 3, (voxel >> 2) & 3, voxel >> 4);
        uint code = code_of(low + step);
        vec4 look = texelFetch(bone_colours, ivec2(int(code), 0), 0);
        vec3 away = vec3(step) - 1.0 - part;
        vec3 tents = 0.5 * (max(1.0 - abs(away - tent_offset), 0.0) + max(1.0 - abs(away + tent_offset), 0.0));
        float weight = code == 0u || look.a == 0.0 ? 0.0 : tents.x * tents.y * tents.z + 1e-5;
        sum += weight * look;
        known += weight;
    }
    return known > 0.0 ? sum / known : texelFetch(bone_colours, ivec2(0), 0);
}

// Looks of the 27 nearest voxels blended by the quadratic B-spline, twice as wide as trilinear: colours by
// stiffness change from voxel to voxel where the CT blurred a surface.
vec4 blended_look(vec3 point, ivec3 nearest, ivec3 shift) {
    vec3 off = point - vec3(nearest) - 0.5;
    vec3 before = 0.5 * (0.5 - off) * (0.5 - off), after = 0.5 * (0.5 + off) * (0.5 + off);
    vec4 sum = vec4(0.0);
    float known = 0.0;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                uint code = code_at(nearest + ivec3(x, y, z), shift);
                vec4 look = texelFetch(bone_colours, ivec2(int(code), 0), 0);
                if (code == 0u || look.a == 0.0) continue;
                vec3 weights = vec3(x < 0 ? before.x : x > 0 ? after.x : 1.0 - before.x - after.x,
                                    y < 0 ? before.y : y > 0 ? after.y : 1.0 - before.y - after.y,
                                    z < 0 ? before.z : z > 0 ? after.z : 1.0 - before.z - after.z);
                float weight = weights.x * weights.y * weights.z + 1e-5;
                sum += weight * look;
                known += weight;
            }
    return known > 0.0 ? sum / known : texelFetch(bone_colours, ivec2(0), 0);
}

ivec3 block_of(vec3 point) { return ivec3(floor(point / block_edge)) + 1; }

// The distance of bone's surface in blocks, and 128 if bone about the block has one code.
uint block_texel(ivec3 block) {
    ivec3 last = ivec3(bone_size / block_edge) + 1;
    return uint(texelFetch(bone_blocks, clamp(block, ivec3(0), last), 0).g * 255.0 + 0.5);
}

bool has_one_code_about(vec3 point) { return block_texel(block_of(point)) >= 128u; }

vec4 smooth_look_at(vec3 point) {
    if (!bone_has_colour_code) return texelFetch(bone_colours, ivec2(0), 0);
    ivec3 nearest = ivec3(floor(point));
    ivec3 shift = texel_shift(point);
    uint code = code_at(nearest, shift);
    vec4 look = texelFetch(bone_colours, ivec2(int(code), 0), 0);
    bool is_hidden = code == 0u || look.a == 0.0;
    if (is_hidden) look = texelFetch(bone_colours, ivec2(0), 0);
    // Within a tissue that is enough.
    if (bone_codes_are_mostly_alike) {
        ivec3 low = ivec3(floor(point - 0.5)) - 1;
        bool is_border = codes_differ_about(low, code, is_hidden || !has_one_code_about(point));
        vec4 wide = wide_look(low, fract(point - 0.5), is_border);
        if (is_border) look = wide;
    } else
        look = blended_look(point, nearest, shift);
    return look;
}

// At most as deep as there is bone: a shell may be thinner.
vec3 place_under(vec3 point, vec3 normal) {
    float bone_there = fraction_at(point - bone_colour_depth * normal);
    return point - mix(1.0, bone_colour_depth, bone_there) * normal;
}

float mean_fraction_at(vec3 point) {
    vec3 map_size = bone_size / block_edge + 2.0;
    return textureLod(bone_blocks, (point / block_edge + 1.0) * (1.0 / map_size), 0.0).r;
}

// By the mean fractions of blocks near and far in four directions round the normal.
float ambient_occlusion(vec3 point, vec3 normal) {
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

// The faces of the cube of blocks that the distance map says is empty, or of the one block.
float way_in_blocks(vec3 point, vec3 direction, out bool is_empty) {
    ivec3 block = block_of(point);
    int away = int(block_texel(block) & 127u);
    is_empty = away != 0;
    int beside = max(away, 1);
    vec3 low = vec3(block - beside) * block_edge;
    vec3 high = vec3(block + beside - 1) * block_edge;
    vec3 leave = (mix(low, high, greaterThan(direction, vec3(0.0))) - point) * (1.0 / direction);
    return min(leave.x, min(leave.y, leave.z));
}
