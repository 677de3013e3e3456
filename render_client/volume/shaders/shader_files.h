// The .glsl files of this folder, which the build embeds, and the text of a shader made from some of them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "render_client/volume/gl/program.h"

namespace osteomill {

/// Table of the files that each shader program is made of. The renderers in render_client/volume/passes
/// compile them: by BoneProgram (bone_program.h) where the bone is sampled, else by make_program.
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

struct ShaderFile {
    std::string_view name;  ///< such as "lighting.glsl"
    std::string_view text;
};

/// All shader files.
std::span<const ShaderFile> shader_files();

/// GLSL 3.30: `constants`, then the files in this order. Empty names are skipped; std::logic_error for one
/// that no file has.
std::string shader_text(std::span<const std::string_view> names, const std::string& constants = {});

/// Compiles and links two such texts. Throws std::runtime_error with the compiler's log, in which errors name
/// file and line: "cuts.glsl:12".
gl::Program make_program(const std::string& vertex_text, const std::string& fragment_text);
gl::Program make_program(const ProgramFiles& files);

}  // namespace osteomill
