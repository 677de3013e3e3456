// Thin bone, which takes on the colour of the tissue behind it: the formula of thin_bone.h; follows bone_sampling.glsl.
//
//     float seen_distance(vec3 point)                  from the next tissue, voxels, negative within
//     vec3  clear_of_seen(vec3 place, float left)      where to read the own colour of a surface that is so far from a tissue,
//                                                      rather than at `place`
//     vec3  colour_through(vec3 colour, vec3 point, vec3 direction, float left)
//                                                      of bone's surface at a point, seen along a unit direction
//     const bool  bone_shows_through                                   given ahead of this file

uniform sampler3D bone_seen;        // by place of the lattice: nearness of the next tissue, its label
uniform sampler2D bone_seen_looks;  // by label: linear RGB and strength; depth in voxels
uniform float seen_step;            // voxels between places
uniform float seen_farthest, seen_span;

const float seen_absorption = 3.0, seen_aside = 2.0;
const int most_seen_steps = 8;
const float bare = 0.3, covered = 2.0;  // voxels of bone: from all of the tissue's colour to its share

// In places of the lattice, from the first, one before the box; they are centres of voxels.
vec3 seen_place(vec3 point) { return (point - 0.5) / seen_step + 1.0; }

float seen_distance(vec3 point) {
    vec3 place = (seen_place(point) + 0.5) / vec3(textureSize(bone_seen, 0));
    return seen_farthest - seen_span * textureLod(bone_seen, place, 0.0).r;
}

// A look is read below the surface, and blended from voxels up to two away. Where bone is thin it would be that of the tissue,
// with the steps of its voxels, so it is read further away from that, even before the surface: what is milled away keeps its look.
vec3 clear_of_seen(vec3 place, float left) {
    const float clear = 2.5;
    // A loop of one turn or none: a software rasteriser would compute both sides of a branch.
    int turns = left > bare && left < clear + bone_colour_depth ? 1 : 0;
    for (int turn = 0; turn < turns; ++turn) {
        float there = seen_distance(place);
        vec3 away = vec3(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            vec3 side = vec3(axis == 0, axis == 1, axis == 2);
            away += side * (seen_distance(place + seen_step * side) - there);
        }
        place += max(clear - there, 0.0) * away / max(length(away), 1e-3);
    }
    return place;
}

float way_by(float along, float distance_left) {
    return along + seen_aside * max(distance_left, 0.0) + min(distance_left, 0.0);
}

// Labels blended between places, so that no edge shows through.
vec4 seen_looks_at(vec3 point, out float depth) {
    vec3 place = seen_place(point);
    ivec3 low = ivec3(floor(place));
    ivec3 last = textureSize(bone_seen, 0) - 1;
    vec4 look = vec4(0.0);
    depth = 0.0;
    float known = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 side = ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
        int label = int(texelFetch(bone_seen, clamp(low + side, ivec3(0), last), 0).g * 255.0 + 0.5);
        if (label == 0) continue;
        vec3 weights = mix(1.0 - (place - vec3(low)), place - vec3(low), vec3(side));
        float weight = weights.x * weights.y * weights.z + 1e-5;
        look += weight * texelFetch(bone_seen_looks, ivec2(label, 0), 0);
        depth += weight * texelFetch(bone_seen_looks, ivec2(label, 1), 0).r;
        known += weight;
    }
    depth /= max(known, 1e-5);
    return look / max(known, 1e-5);
}

vec3 colour_through(vec3 colour, vec3 point, vec3 direction, float left) {
    float cover = smoothstep(bare, covered, left);
    bool is_bare = left <= bare;
    // Loops of no turn if nothing is near: a software rasteriser would compute both sides of a branch.
    int turns = left < seen_farthest ? most_seen_steps : 0;
    float along = 0.0, way = way_by(0.0, left);
    vec3 nearest = point;
    for (int turn = 0; turn < turns; ++turn) {
        // From here on the way is no shorter than this.
        if (along + left >= way || left <= 0.0) break;
        along += max(left, 0.5);
        vec3 there = point + along * direction;
        left = seen_distance(there);
        float by = way_by(along, left);
        if (by < way) nearest = there;
        way = min(way, by);
    }
    for (int turn = 0; turn < (turns > 0 ? 1 : 0); ++turn) {
        float depth;
        vec4 look = seen_looks_at(nearest, depth);
        float least = exp(-seen_absorption);
        float light = exp(-seen_absorption * max(way, 0.0) / max(depth, 1e-3));
        float share = look.a * max((light - least) / (1.0 - least), 0.0);
        colour = mix(colour, look.rgb, is_bare ? share : mix(1.0, share, cover));
    }
    return colour;
}
