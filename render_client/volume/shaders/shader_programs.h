// Table of the files that each shader program is made of. The renderers in render_client/volume/passes
// compile them: by BoneProgram (bone_program.h) where the bone is sampled, else by make_program
// (shader_files.h).
#pragma once

#include <array>
#include <string_view>

namespace osteomill {

struct ProgramFiles {
    std::string_view vertex;
    std::array<std::string_view, 6> fragment;  ///< one after another
};

inline constexpr ProgramFiles background_files{"whole_picture.vert.glsl",
                                               {"lighting.glsl", "background.glsl", "background.frag.glsl"}};
inline constexpr ProgramFiles gathered_light_files{
    "whole_picture.vert.glsl", {"lighting.glsl", "background.glsl", "gathered_light.frag.glsl"}};
inline constexpr ProgramFiles contact_shadow_files{"camera_rays.vert.glsl",
                                                   {"lighting.glsl", "contact_shadow.frag.glsl"}};
inline constexpr ProgramFiles upscale_files{"upscale.vert.glsl", {"upscale.frag.glsl"}};
inline constexpr ProgramFiles discontinuity_block_files{"whole_picture.vert.glsl",
                                                        {"discontinuity_blocks.frag.glsl"}};
inline constexpr ProgramFiles light_field_files{"upscale.vert.glsl",
                                                {"lighting.glsl", "light_field.frag.glsl"}};
inline constexpr ProgramFiles interleave_rows_files{"upscale.vert.glsl", {"interleave_rows.frag.glsl"}};
inline constexpr ProgramFiles structure_files{"structure.vert.glsl",
                                              {"cuts.glsl", "lighting.glsl", "structure.frag.glsl"}};
inline constexpr ProgramFiles tool_files{"tool.vert.glsl", {"lighting.glsl", "tool.frag.glsl"}};
inline constexpr ProgramFiles mesh_surface_files{"tool.vert.glsl", {"mesh_surface.frag.glsl"}};

/// Files for BoneProgram, which puts the sampling of the bone ahead of them.
inline constexpr ProgramFiles raycast_files{"camera_rays.vert.glsl",
                                            {"lighting.glsl", "background.glsl", "bone_shading.glsl",
                                             "cut_shading.glsl", "bone_rays.glsl", "raycast.frag.glsl"}};
inline constexpr ProgramFiles bone_surface_files{
    "camera_rays.vert.glsl",
    {"lighting.glsl", "bone_shading.glsl", "bone_rays.glsl", "bone_surface.frag.glsl"}};
inline constexpr ProgramFiles silhouette_files{
    "silhouettes.vert.glsl",
    {"lighting.glsl", "bone_shading.glsl", "bone_rays.glsl", "silhouettes.frag.glsl"}};
inline constexpr ProgramFiles slice_files{
    "slice.vert.glsl", {"lighting.glsl", "bone_shading.glsl", "cut_shading.glsl", "slice.frag.glsl"}};
inline constexpr std::array<std::string_view, 5> bone_sampling_files{
    "bone_sampling.glsl", "thin_bone.glsl", "grain.glsl", "sawn_faces.glsl", "cuts.glsl"};

}  // namespace osteomill
