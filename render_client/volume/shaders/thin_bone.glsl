// Thin bone, which takes on the colour of the tissue behind it: the formula of thin_bone.h; follows bone_sampling.glsl.
//
//     vec4  look_through(vec3 point, vec3 direction, inout vec3 place)
//                                 of bone's surface at a point, seen along a unit direction: linear RGB of the tissue behind it, and
//                                 its share. `place`, where the surface's own colour is read, is moved away from the tissue.
//     const bool  bone_shows_through                                   given ahead of this file

uniform sampler3D bone_seen;        // by place of the lattice: nearness of the next tissue, its number
uniform sampler2D bone_seen_looks;  // by number, in bytes, which cost a software rasteriser less: square roots of linear RGB, and
                                    // strength; depth, as a part of the farthest
uniform float seen_step, seen_per_voxel;  // voxels between places, and the inverse
uniform vec3 seen_scale, seen_shift;      // texture coordinates: scale * point + shift
uniform float seen_farthest, seen_span;

const float seen_aside = 2.0;
const float seen_saturation = 2.0;
const int most_seen_steps = 8;
const float bare = 0.3, covered = 2.0;  // voxels of bone: from all of the tissue's colour to its share
// A look is read below the surface, and blended from voxels up to two away. Where bone is thin it would be that of the tissue,
// with the steps of its voxels, so it is read further away from that, even before the surface: what is milled away keeps its look.
const float clear = 2.5;

// In places of the lattice, from the first, one before the box; they are centres of voxels.
vec3 seen_place(vec3 point) { return (point - 0.5) * seen_per_voxel + 1.0; }

float way_by(float along, float distance_left) {
    return along + seen_aside * max(distance_left, 0.0) + min(distance_left, 0.0);
}

// The nearest tissue behind a surface, seen along a ray.
struct SeenBehind {
    float left;     // voxels of bone before it, to the surface
    float way;      // of light, voxels
    vec3 nearest;   // the point of the ray from which light turns aside
    float number;   // of the tissues about that point, blended
};

// One loop with one sample a round, of the ray and then beside the place: a software rasteriser computes all branches for all
// pixels, and a loop's body at least once.
SeenBehind find_behind(vec3 point, vec3 direction, inout vec3 place) {
    SeenBehind found = SeenBehind(0.0, 0.0, point, 0.0);
    vec3 at = point, away = vec3(0.0);
    float along = 0.0, there = 0.0;
    int beside = -1;  // samples beside the place so far; none while the ray goes on
    for (int turn = 0; beside < 4; ++turn) {
        vec2 seen = textureLod(bone_seen, seen_scale * at + seen_shift, 0.0).rg;
        float distance_there = seen_farthest - seen_span * seen.r;
        if (beside < 0) {
            if (turn == 0) found.left = distance_there;
            float by = way_by(along, distance_there);
            if (turn == 0 || by < found.way) {
                found.way = by;
                found.nearest = at;
                found.number = seen.g;
            }
            // From here on the way is no shorter than this.
            float least = along + distance_there;
            along += max(distance_there, 0.5);
            at = point + along * direction;
            if (turn == most_seen_steps || least >= min(found.way, seen_farthest) || distance_there <= 0.0) {
                bool is_thin = found.left > bare && found.left < min(seen_farthest, clear + bone_colour_depth);
                beside = is_thin ? 0 : 4;
                at = place;
            }
        } else {
            if (beside == 0) there = distance_there;
            away += (distance_there - there) * vec3(beside == 1, beside == 2, beside == 3);
            ++beside;
            at = place + seen_step * vec3(beside == 1, beside == 2, beside == 3);
            if (beside == 4) place += max(clear - there, 0.0) * away / max(length(away), 1e-3);
        }
    }
    return found;
}

// The looks of the tissues about that point are blended, so that no edge shows through. If the nearest place has the number that
// is blended, there is one tissue, since numbers are far apart.
vec4 look_through(vec3 point, vec3 direction, inout vec3 place) {
    SeenBehind found = find_behind(point, direction, place);
    bool is_near = found.left < seen_farthest && (found.way < seen_farthest || found.left < covered);
    vec3 from = seen_place(found.nearest), low = floor(from);
    ivec3 last = textureSize(bone_seen, 0) - 1;
    vec4 look = vec4(0.0);
    float depth = 0.0, known = 0.0;
    int corners = is_near ? 8 : 0;
    for (int corner = -1; corner < corners; ++corner) {
        vec3 side = corner < 0 ? step(0.5, from - low) : vec3(corner & 1, (corner >> 1) & 1, corner >> 2);
        float number = texelFetch(bone_seen, clamp(ivec3(low + side), ivec3(0), last), 0).g;
        int row = int(number * 255.0 + 0.5);
        bool is_alone = corner < 0 && row != 0 && abs(number - found.number) < 0.4 / 255.0;
        vec3 weights = mix(1.0 - (from - low), from - low, side);
        float weight = row == 0 || (corner < 0 && !is_alone) ? 0.0 : weights.x * weights.y * weights.z + 1e-5;
        vec4 one = texelFetch(bone_seen_looks, ivec2(row, 0), 0);
        look += weight * vec4(one.rgb * one.rgb, one.a);
        depth += weight * texelFetch(bone_seen_looks, ivec2(row, 1), 0).r;
        known += weight;
        if (is_alone) break;
    }
    float part = 1.0 / max(known, 1e-5);
    float ways = max(found.way, 0.0) * known / max(depth * seen_farthest, 1e-3);
    const float least_light = exp(-1.0);
    float share = part * look.a * max((exp(-ways) - least_light) / (1.0 - least_light), 0.0);
    float under = smoothstep(bare, covered, found.left);
    float cover = found.left <= bare ? 1.0 : under;
    vec3 own = part * look.rgb;
    vec3 seen = mix(vec3(dot(own, vec3(0.2126, 0.7152, 0.0722))), own, mix(1.0, seen_saturation, under));
    return vec4(max(seen, 0.0), is_near ? mix(1.0, share, cover) : 0.0);
}
