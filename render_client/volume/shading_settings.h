// Settings of a bone's picture: the light on its surface, and colour and opacity by tissue or stiffness.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

#include "render_client/volume/bone_colours.h"
#include "render_client/volume/textures/voxel_codes.h"
#include "render_client/volume/thin_bone.h"
#include "render_client/volume/transfer_function.h"

namespace osteomill {

// Grain of bone: how much its colour varies from place to place, by its stiffness. Cortical bone has fine
// pores, trabecular bone a coarse weave of rods and marrow, enamel nearly none. The pattern is grain.glsl's;
// cell sizes and strengths are the project's judgement.

/// Edges of the pattern's cells, as in grain.glsl.
inline constexpr double fine_grain_mm = 0.25, coarse_grain_mm = 0.9;

/// Greatest share by which the fine grain (x) and the coarse grain (y) of a voxel code make its colour
/// lighter or darker.
using GrainTable = std::array<glm::vec2, 256>;

/// The grain of bone of a relative stiffness (at least 0).
glm::vec2 grain_of_stiffness(double relative_stiffness);

/// Source of a surface's shading.
enum class Shading {
    gradient,       ///< the gradient of the fraction in every pixel, and ambient occlusion
    surface_voxels  ///< as published: once for each surface voxel, into a texture (see surface_voxels.h)
};

struct ShadingSettings {
    Shading shading = Shading::gradient;
    /// Colour and opacity by stiffness. Absent: if the bone is labelled, the colours and opacities of the
    /// tissues, in shades by stiffness; else the colours of its stiffness.
    std::optional<TransferFunction> transfer{};

    bool operator==(const ShadingSettings&) const = default;
};

/// Colours and opacities, worked out for one bone's codes.
struct TransferTable {
    VoxelCodes codes{};                    ///< without any all bone looks like code 0
    std::array<glm::vec4, 256> by_code{};  ///< linear RGB and opacity
    GrainTable grain_by_code{};            ///< by the stiffness of the code's bone
    TransferMode mode = TransferMode::surface;
    std::optional<SeenTissues> seen{};  ///< what thin bone shows; none: it shows nothing
};

/// Throws std::invalid_argument, like require_valid, for an invalid transfer function.
TransferTable transfer_table(const BoneContent& content, std::span<const TissueColour> tissues,
                             const ShadingSettings& look);

/// Depth below bone's surface at which its colour is read, voxels: one for tissues, to be below the steps of
/// labels. Colours by stiffness are read deeper, because CT blurs a surface over several voxels, and the
/// mixture with air in the outermost ones would show as rings wherever the surface passes from one layer to
/// the next.
double colour_depth_voxels(const TransferTable& table);

/// Share of a voxel of each code that counts, 0 to 255: its opacity if bone is a solid surface, all or
/// nothing if it is seen through.
std::array<std::uint8_t, 256> shown_part_by_code(const TransferTable& table);

/// Shades of tissues: within a tissue whose stiffness varies, soft bone is darker and redder than the
/// tissue's colour and hard bone whiter, so that a segmented tooth still shows enamel on dentine, a jaw its
/// cortical bone.
///
/// A tissue's own colour stands for its median stiffness. Softer or harder bone has that colour times the
/// ratio of the two stiffnesses' colours in bone_colours.h.
struct TissueShades {
    VoxelCodes codes{};                            ///< of tissue and stiffness
    std::array<glm::vec3, 256> by_code{};          ///< linear RGB
    std::array<std::uint8_t, 256> label{};         ///< of each code
    std::array<double, 256> relative_stiffness{};  ///< likewise; 1 of a code that no bone has
};

/// Shades for the tissues of a bone. None if the bone lacks labels or stiffness, or if no tissue's stiffness
/// varies by a tenth or more between its softer and its harder voxels: then labels alone are enough. Bone
/// without a label is shaded like a tissue that has no colour of its own. The frequencies of stiffness are
/// counted in a thousand bricks at most, evenly spread.
std::optional<TissueShades> tissue_shades(const BoneContent& content, std::span<const TissueColour> tissues);

/// The median relative stiffness of each label's bone, counted as for shades; 1 for a label that no bone has.
/// Without stiffness codes it is the same for the whole bone.
std::array<double, 256> median_stiffness_by_label(const BoneContent& content);

}  // namespace osteomill
