// Places of texels where a texture holds the whole of the bone's box. One of two; bone_sampling.glsl follows.

uniform vec3 bone_size;

// The compiler finds the reciprocal once; it would divide for each sample.
vec3 texture_place(vec3 point) { return point * (1.0 / bone_size); }
vec3 texture_place_beside(vec3 point, vec3 offset) { return texture_place(point + offset); }
ivec3 texel_shift(vec3 point) { return ivec3(0); }
