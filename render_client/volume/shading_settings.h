// Settings of how a bone is shown: how its surface is lit, and what colour and opacity its tissues or its
// stiffness give it.
#pragma once

#include <glm/vec4.hpp>
#include <optional>

#include "render_client/volume/bone_colours.h"
#include "render_client/volume/textures/voxel_codes.h"
#include "render_client/volume/thin_bone.h"
#include "render_client/volume/transfer_function.h"

namespace osteomill {

/// Where the light on a surface comes from.
enum class Shading {
    gradient,       ///< the gradient of the fraction in every pixel, and ambient occlusion
    surface_voxels  ///< as published: once for each surface voxel, into a texture (see surface_voxels.h)
};

struct ShadingSettings {
    Shading shading = Shading::gradient;
    /// Colour and opacity by stiffness. Absent: the colours and opacities of the tissues where the bone is
    /// labelled, in shades by stiffness, else the colours of its stiffness.
    std::optional<TransferFunction> transfer{};

    bool operator==(const ShadingSettings&) const = default;
};

/// A look, worked out for one bone's codes.
struct TransferTable {
    VoxelCodes codes{};                    ///< without any all bone looks like code 0
    std::array<glm::vec4, 256> by_code{};  ///< linear RGB and opacity
    TransferMode mode = TransferMode::surface;
    std::optional<SeenTissues> seen{};  ///< what thin bone shows; none: it shows nothing
};

/// Throws std::invalid_argument like require_valid where the look's transfer function is none.
TransferTable transfer_table(const BoneContent& content, std::span<const TissueColour> tissues,
                             const ShadingSettings& look);

/// Depth below bone's surface at which its colour is read, voxels: one for tissues, to be below the steps of
/// labels. Colours by stiffness are read deeper, because CT blurs a surface over several voxels, and the
/// mixture with air in the outermost ones would show as rings wherever the surface passes from one layer to
/// the next.
double colour_depth_voxels(const TransferTable& table);

/// How much of a voxel of each code counts, 0 to 255: its opacity where bone is a solid surface, all or
/// nothing where one sees through it.
std::array<std::uint8_t, 256> shown_part_by_code(const TransferTable& table);

}  // namespace osteomill
