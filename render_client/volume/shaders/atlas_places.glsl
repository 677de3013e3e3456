// Places of texels where a texture holds tiles, one for a brick with bone. One of two; bone_sampling.glsl follows.

uniform vec3 bone_size;
uniform usampler3D bone_tile_table;
uniform vec3 bone_texture_size;

const float brick_edge = 16.0;
const int tile_edge = 18, tile_border = 1;

ivec3 brick_at(vec3 point) {
    return clamp(ivec3(floor(point / brick_edge)), ivec3(0), ivec3(bone_size / brick_edge) - 1);
}

ivec3 first_texel_of(ivec3 brick) {
    return ivec3(texelFetch(bone_tile_table, brick, 0).xyz) * tile_edge + tile_border;
}

vec3 texture_place_beside(vec3 point, vec3 offset) {
    ivec3 brick = brick_at(point);
    // A point beyond the box gets the outermost border's value: zero.
    vec3 within = clamp(point + offset - vec3(brick) * brick_edge, -0.5, brick_edge + 0.5);
    return (vec3(first_texel_of(brick)) + within) / bone_texture_size;
}

vec3 texture_place(vec3 point) { return texture_place_beside(point, vec3(0.0)); }

ivec3 texel_shift(vec3 point) {
    ivec3 brick = brick_at(point);
    return first_texel_of(brick) - brick * int(brick_edge);
}
