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

namespace {

/// The code that all have, of those that are not 0; 0 if none has one.
class CommonCode {
  public:
    void add(std::uint8_t code) {
        if (code == 0) return;
        differs_ |= code_ != 0 && code_ != code;
        code_ = code;
    }
    void add(const CommonCode& other) {
        differs_ |= other.differs_;
        add(other.code_);
    }
    bool is_one() const { return !differs_; }

  private:
    std::uint8_t code_ = 0;
    bool differs_ = false;
};

}  // namespace

std::array<bool, blocks_per_brick> blocks_of_one_code(const Bone& bone, const VoxelCodes& codes,
                                                      const glm::ivec3& brick) {
    constexpr int margin = 2, edge = brick_edge_voxels + 2 * margin, cells = edge / margin;
    std::array<std::uint8_t, edge * edge * edge> nearby;
    copy_codes(bone, codes, {brick * brick_edge_voxels - margin, glm::ivec3(edge)}, nearby);
    // A block with its margin is 4^3 cells of 2^3 voxels, and shares most of them with its neighbours.
    std::array<CommonCode, cells * cells * cells> cell{};
    std::size_t voxel = 0;
    for (int z = 0; z < edge; ++z)
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x, ++voxel)
                cell[static_cast<std::size_t>((z / margin * cells + y / margin) * cells + x / margin)].add(
                    nearby[voxel]);
    std::array<bool, blocks_per_brick> are_one{};
    for (int block = 0; block < static_cast<int>(blocks_per_brick); ++block) {
        const glm::ivec3 first = 2 * glm::ivec3(block & 3, block >> 2 & 3, block >> 4);
        CommonCode about;
        for (int z = 0; z < 4; ++z)
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 4; ++x)
                    about.add(cell[static_cast<std::size_t>(((first.z + z) * cells + first.y + y) * cells +
                                                            first.x + x)]);
        are_one[static_cast<std::size_t>(block)] = about.is_one();
    }
    return are_one;
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
