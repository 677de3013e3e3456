// A SceneLook in GLSL 3.30, for every renderer's fragment shader. Points are in the coordinates of
// bone_sampling_glsl.
//
// background_glsl, which follows nothing; set_background_uniforms sets its uniforms:
//
//     vec3  background_at(vec2 place)              linear RGB; place 0 to 1 from the picture's lower left
//                                                  corner
//
// cuts_glsl, which follows cut_count_glsl; set_cut_uniforms sets its uniforms:
//
//     const int cut_count
//     void  clip_by_cuts(vec3 eye, vec3 direction, inout float enter, inout float leave)
//                                                  shortens a ray to what no cut takes away
//     bool  is_cut_away(vec3 point)
//
// cut_shading_glsl, which follows bone_shading_glsl:
//
//     vec3  shown_pixel(vec3 point, vec3 direction)  as surface_pixel, but for the faces of cuts, which are
//                                                    flat and open to the sky
#pragma once

#include <string>

#include "render_client/volume/gl/program.h"
#include "render_client/volume/scene_look.h"
#include "render_client/volume/textures/bone_textures.h"

namespace osteomill {

inline constexpr const char* background_glsl = R"glsl(
uniform vec3 background_low, background_high;

vec3 background_at(vec2 place) {
    vec3 shade = mix(background_low, background_high, smoothstep(0.0, 1.0, place.y));
    return shade * (1.0 - 0.35 * dot(place - 0.5, place - 0.5));
}
)glsl";

inline constexpr const char* cuts_glsl = R"glsl(
uniform vec4 cut_planes[4];  // xyz unit, towards what is taken away; w offset, voxels

void clip_by_cuts(vec3 eye, vec3 direction, inout float enter, inout float leave) {
    for (int cut = 0; cut < cut_count; ++cut) {
        float slope = dot(cut_planes[cut].xyz, direction);
        if (abs(slope) < 1e-6) slope = -1e-6;
        float meets = (cut_planes[cut].w - dot(cut_planes[cut].xyz, eye)) / slope;
        if (slope > 0.0) leave = min(leave, meets);
        else enter = max(enter, meets);
    }
}

bool is_cut_away(vec3 point) {
    for (int cut = 0; cut < cut_count; ++cut)
        if (dot(cut_planes[cut].xyz, point) > cut_planes[cut].w) return true;
    return false;
}
)glsl";

inline constexpr const char* cut_shading_glsl = R"glsl(
const float cut_face_depth = 0.1;  // voxels within which a renderer finds a face

vec3 shown_pixel(vec3 point, vec3 direction) {
    for (int cut = 0; cut < cut_count; ++cut) {
        vec3 normal = cut_planes[cut].xyz;
        // Where bone does not go on behind the cut it is the bone's own surface that is seen.
        if (cut_planes[cut].w - dot(normal, point) < cut_face_depth &&
            fraction_at(point + 0.5 * normal) >= bone_surface)
            return display(lit(look_at(point - 0.6 * normal).rgb, normal, 1.0));
    }
    return surface_pixel(point, direction);
}
)glsl";

/// How many cuts a look has, of those that a renderer heeds. Fixed when a program is compiled: in most
/// pictures there is none, and what no picture needs is to cost no pixel anything.
int cut_count(const SceneLook& look);
std::string cut_count_glsl(int cut_count);

/// The program must be in use.
void set_background_uniforms(const gl::Program& program, const SceneLook& look);
void set_cut_uniforms(const gl::Program& program, const SceneLook& look, const BoneTextures& bone);

}  // namespace osteomill
