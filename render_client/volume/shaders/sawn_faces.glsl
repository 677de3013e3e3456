// Sawn faces of the bone, where it ends because the piece does (sawn_faces.h): no anatomy, so they have no tissue's colour.
//
//     float sawn_share(vec3 point)       1 on a sawn face, 0 elsewhere
//     vec3  sawn_colour(vec3 colour)     of a tissue that is sawn through: matte grey-beige, darker where the tissue is
//     const bool bone_has_sawn_faces     given ahead of this file

uniform vec3 sawn_low, sawn_high;  // where the faces lie; far beyond the bone on a side that is not sawn

const vec3 sawn_neutral = vec3(0.47, 0.42, 0.36);

float sawn_share(vec3 point) {
    vec3 depth = min(point - sawn_low, sawn_high - point);
    return 1.0 - smoothstep(0.75, 1.75, min(depth.x, min(depth.y, depth.z)));
}

vec3 sawn_colour(vec3 colour) {
    float light = dot(colour, vec3(0.2126, 0.7152, 0.0722));
    return sawn_neutral * mix(0.55, 1.0, min(light / 0.6, 1.0));
}
