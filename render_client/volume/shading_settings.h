// Settings of a bone's picture: the light on its surface, and colour and opacity by tissue or stiffness.
#pragma once

#include <glm/vec4.hpp>
#include <optional>

#include "render_client/volume/bone_colours.h"
#include "render_client/volume/bone_grain.h"
#include "render_client/volume/textures/voxel_codes.h"
#include "render_client/volume/thin_bone.h"
#include "render_client/volume/transfer_function.h"

namespace osteomill {

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

}  // namespace osteomill
