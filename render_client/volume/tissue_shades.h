// Shades of tissues: within a tissue whose stiffness varies, soft bone is darker and redder than the tissue's
// colour and hard bone whiter, so that a segmented tooth still shows enamel on dentine, a jaw its cortical
// bone.
//
// A tissue's own colour stands for its median stiffness. Softer or harder bone has that colour times the
// ratio of the two stiffnesses' colours in bone_colours.h.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "render_client/volume/bone_colours.h"
#include "render_client/volume/textures/voxel_codes.h"

namespace osteomill {

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
