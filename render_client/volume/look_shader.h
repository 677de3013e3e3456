// A SceneLook in GLSL 3.30, for every renderer's fragment shader; set_look_uniforms sets its uniforms.
//
//     int   cut_count, vec4 cut_planes[]        in the coordinates of bone_sampling_glsl: xyz unit, towards
//     what
//                                               is taken away; w offset, voxels
//     int   clip_by_cuts(vec3 eye, vec3 direction, inout float enter, inout float leave)
//                                               shortens a ray to what is not taken away; the plane in whose
//                                               face it then enters, or -1
//     vec3  background_at(vec2 place)           linear RGB; place 0 to 1 from the picture's lower left corner
#pragma once

#include "render_client/volume/bone_textures.h"
#include "render_client/volume/gl/program.h"
#include "render_client/volume/scene_look.h"

namespace osteomill {

inline constexpr const char* look_glsl = R"glsl(
uniform int cut_count;
uniform vec4 cut_planes[4];
uniform vec3 background_low, background_high;

int clip_by_cuts(vec3 eye, vec3 direction, inout float enter, inout float leave) {
    int face = -1;
    for (int plane = 0; plane < cut_count; ++plane) {
        float slope = dot(cut_planes[plane].xyz, direction);
        if (abs(slope) < 1e-6) slope = -1e-6;
        float meets = (cut_planes[plane].w - dot(cut_planes[plane].xyz, eye)) / slope;
        if (slope > 0.0) {
            leave = min(leave, meets);
        } else if (meets > enter) {
            enter = meets;
            face = plane;
        }
    }
    return face;
}

vec3 background_at(vec2 place) {
    vec3 shade = mix(background_low, background_high, smoothstep(0.0, 1.0, place.y));
    return shade * (1.0 - 0.35 * dot(place - 0.5, place - 0.5));
}
)glsl";

/// The program must be in use.
void set_look_uniforms(const gl::Program& program, const SceneLook& look, const BoneTextures& bone);

}  // namespace osteomill
