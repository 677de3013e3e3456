#include "render_client/volume/textures/voxel_codes.h"

#include <algorithm>

namespace osteomill {

void copy_codes(const Bone& bone, const VoxelCodes& codes, const VoxelBox& box,
                std::span<std::uint8_t> voxels) {
    if (codes.are_of_both()) {
        std::vector<std::uint8_t> stiffness(voxels.size());
        copy_channel(bone, BoneChannel::stiffness, box, stiffness);
        copy_channel(bone, BoneChannel::tissue, box, voxels);
        for (std::size_t voxel = 0; voxel < voxels.size(); ++voxel)
            voxels[voxel] =
                codes.by_tissue_and_stiffness[std::size_t{256} * voxels[voxel] + stiffness[voxel]];
    } else if (codes.channel) {
        copy_channel(bone, *codes.channel, box, voxels);
    } else {
        std::ranges::fill(voxels, std::uint8_t{0});
    }
}

void copy_stiffest_codes(const Bone& bone, const VoxelCodes& codes, const VoxelBox& box,
                         std::span<std::uint8_t> voxels) {
    if (codes.channel != BoneChannel::stiffness) {
        copy_codes(bone, codes, box, voxels);
        return;
    }
    const VoxelBox bordered{box.first - 1, box.size + 2};
    std::vector<std::uint8_t> nearby(bordered.count());
    copy_channel(bone, BoneChannel::stiffness, bordered, nearby);
    // The largest of 27 is the largest of three, along each axis in turn; in place, since overwritten values
    // are not read again.
    const auto row = static_cast<std::size_t>(bordered.size.x);
    const std::size_t layer = row * static_cast<std::size_t>(bordered.size.y);
    for (const std::size_t stride : {std::size_t{1}, row, layer})
        for (std::size_t place = 0; place + 2 * stride < nearby.size(); ++place)
            nearby[place] = std::max({nearby[place], nearby[place + stride], nearby[place + 2 * stride]});
    auto to = voxels.begin();
    for (int z = 0; z < box.size.z; ++z)
        for (int y = 0; y < box.size.y; ++y)
            to =
                std::copy_n(nearby.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(z) * layer +
                                                                         static_cast<std::size_t>(y) * row),
                            box.size.x, to);
}

}  // namespace osteomill
