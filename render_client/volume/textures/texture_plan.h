// Plan of the 3D textures of a bone, within the limits of the driver and the user.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "render_client/volume/textures/atlas_layout.h"

namespace osteomill {

/// A laptop's graphics share its memory: more than this for the bone alone would be felt elsewhere.
inline constexpr std::size_t default_texture_budget_bytes = std::size_t{1} << 30;

struct TextureLimits {
    std::size_t budget_bytes = default_texture_budget_bytes;
    std::optional<int> longest_edge_texels{};  ///< absent: what the driver allows
    std::optional<BoneLayout> layout{};        ///< absent: dense where it fits, else an atlas
};

struct TexturePlan {
    BoneLayout layout = BoneLayout::dense;
    int coarsening = 1;     ///< voxels of the bone along an edge of a voxel that is drawn
    std::size_t bytes = 0;  ///< of all textures together, as requested of the driver
    bool smoothed = false;  ///< with a texture of smoothed fractions, for normals (smoothed_fraction.h)

    bool operator==(const TexturePlan&) const = default;
};

/// One of a bone's textures.
struct TextureSize {
    std::string name{};  ///< what it holds: "fractions" ...
    std::size_t bytes = 0;
};

/// Bytes of a voxel in all the textures that hold voxels.
struct VoxelBytes {
    std::size_t needed = 1;
    std::size_t smoothed = 0;   ///< more for smoothed fractions; 0: the look has no use for them
    bool seen_through = false;  ///< beside them a field of what thin bone shows (seen_through.h)
};

/// Every way that keeps within the limits, best first: the bone itself before coarser copies of it (by 2, 4,
/// 8), smoothed before not, dense before atlas. Smoother normals are a luxury: a plan has them only if all
/// stays within half of the budget. `longest_edge_texels` of the limits must be given.
std::vector<TexturePlan> texture_plans(const BoneContent& content, const VoxelBytes& bytes_per_voxel,
                                       const TextureLimits& limits);

/// "a dense texture, 21 MiB", "a brick atlas, 412 MiB, of a copy 2 times coarser".
std::string description(const TexturePlan& plan);

}  // namespace osteomill
