#include "render_client/volume/textures/block_summary.h"

#include <cstring>

namespace osteomill {

namespace {

constexpr int neighbour_count = 27;
constexpr BlockReach all_around = (1U << neighbour_count) - 1;

/// For each neighbour, the voxels of a block that touch it, as bits, x fastest.
constexpr std::array<std::uint64_t, neighbour_count> voxels_towards() {
    const auto touches = [](int place, int side) {
        return side == 0 || place == (side < 0 ? 0 : block_edge_voxels - 1);
    };
    std::array<std::uint64_t, neighbour_count> towards{};
    for (int bit = 0; bit < neighbour_count; ++bit)
        for (int voxel = 0; voxel < 64; ++voxel) {
            const int dx = bit % 3 - 1, dy = bit / 3 % 3 - 1, dz = bit / 9 - 1;
            if (touches(voxel & 3, dx) && touches(voxel >> 2 & 3, dy) && touches(voxel >> 4, dz))
                towards[static_cast<std::size_t>(bit)] |= std::uint64_t{1} << voxel;
        }
    return towards;
}

BlockReach reach_of(std::uint64_t half_full) {
    static constexpr std::array<std::uint64_t, neighbour_count> towards = voxels_towards();
    if (half_full == 0) return 0;
    if (half_full == ~std::uint64_t{0}) return all_around;
    BlockReach reach = 0;
    for (std::size_t bit = 0; bit < towards.size(); ++bit)
        reach |= static_cast<BlockReach>((half_full & towards[bit]) != 0) << bit;
    return reach;
}

std::uint32_t four_bytes(const std::uint8_t* bytes) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    return word;
}

/// Top bits of four bytes, as the low four bits in the same order (on a little-endian machine, byte 0 first).
std::uint64_t top_bits(std::uint32_t four) {
    return ((four >> 7 & 0x01010101U) * 0x01020408U >> 24 & 0xFU);
}

}  // namespace

BrickSummary summary_of_brick(BrickFractions fractions) {
    BrickSummary summary;
    std::size_t block = 0;
    for (int z = 0; z < brick_edge_voxels; z += block_edge_voxels)
        for (int y = 0; y < brick_edge_voxels; y += block_edge_voxels)
            for (int x = 0; x < brick_edge_voxels; x += block_edge_voxels, ++block) {
                std::uint64_t half_full = 0;
                std::uint32_t two_sums = 0;  // of even and of odd bytes: at most 16 rows * 2 * 255 each
                for (int row = 0; row < 16; ++row) {
                    const std::uint32_t four =
                        four_bytes(fractions.data() + offset_in_brick({x, y + (row & 3), z + (row >> 2)}));
                    half_full |= top_bits(four) << (4 * row);
                    two_sums += (four & 0x00FF00FFU) + (four >> 8 & 0x00FF00FFU);
                }
                summary.reach[block] = reach_of(half_full);
                summary.mean_fraction[block] =
                    static_cast<std::uint8_t>(((two_sums & 0xFFFFU) + (two_sums >> 16)) / 64);
            }
    return summary;
}

}  // namespace osteomill
