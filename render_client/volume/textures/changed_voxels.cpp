#include "render_client/volume/textures/changed_voxels.h"

#include <cstring>

namespace osteomill {

namespace {

/// First layer that differs, and one behind the last; nothing where none does.
struct Layers {
    int first = 0;
    int end = 0;
};

template <std::size_t count>
Layers differing(const std::array<std::uint64_t, count>& before,
                 const std::array<std::uint64_t, count>& after) {
    Layers layers;
    for (std::size_t i = 0; i < count; ++i) {
        if (before[i] == after[i]) continue;
        if (layers.end == 0) layers.first = static_cast<int>(i);
        layers.end = static_cast<int>(i) + 1;
    }
    return layers;
}

constexpr std::size_t row_voxels = brick_edge_voxels;
constexpr std::size_t word_bytes = sizeof(std::uint32_t);
constexpr std::size_t words_of_brick = brick_voxel_count / word_bytes;

/// By Steele's splitmix64, made odd: a product is then zero for no word but zero.
constexpr std::array<std::uint64_t, words_of_brick> make_factors() {
    std::array<std::uint64_t, words_of_brick> factors{};
    std::uint64_t state = 0;
    for (std::uint64_t& factor : factors) {
        state += 0x9E3779B97F4A7C15U;
        std::uint64_t mixed = (state ^ state >> 30U) * 0xBF58476D1CE4E5B9U;
        mixed = (mixed ^ mixed >> 27U) * 0x94D049BB133111EBU;
        factor = (mixed ^ mixed >> 31U) | 1U;
    }
    return factors;
}

}  // namespace

ChangedVoxels::LayerHashes ChangedVoxels::hashes_of(
    std::span<const std::uint8_t, brick_voxel_count> fractions) {
    static constexpr std::array<std::uint64_t, words_of_brick> factors = make_factors();
    static_assert(word_bytes == word_voxels);
    LayerHashes hashes;
    std::size_t word = 0;
    for (std::size_t z = 0; z < row_voxels; ++z)
        for (std::size_t y = 0; y < row_voxels; ++y) {
            std::uint64_t row_sum = 0;
            for (std::uint64_t& along_x : hashes.x) {
                std::uint32_t voxels = 0;
                std::memcpy(&voxels, fractions.data() + word_bytes * word, word_bytes);
                const std::uint64_t product = factors[word++] * voxels;
                along_x += product;
                row_sum += product;
            }
            hashes.y[y] += row_sum;
            hashes.z[z] += row_sum;
        }
    return hashes;
}

ChangedVoxels::ChangedVoxels(const Bone& bone) : known_(bone.stored_bricks()) {
    for (std::size_t slot = 0; slot < known_.size(); ++slot)
        known_[slot] = hashes_of(bone.fractions(static_cast<std::int32_t>(slot)));
}

std::span<const VoxelBox> ChangedVoxels::since_last(const Bone& bone, std::span<const BrickIndex> dirty) {
    boxes_.clear();
    for (const BrickIndex index : dirty) {
        const std::int32_t slot = bone.slot(index);
        if (slot == BoneContent::no_slot) continue;
        LayerHashes& known = known_[static_cast<std::size_t>(slot)];
        const LayerHashes hashes = hashes_of(bone.fractions(slot));
        const Layers x = differing(known.x, hashes.x);
        const Layers y = differing(known.y, hashes.y);
        const Layers z = differing(known.z, hashes.z);
        if (x.end == 0) continue;
        known = hashes;
        const glm::ivec3 low(word_voxels * x.first, y.first, z.first);
        const glm::ivec3 high(word_voxels * x.end, y.end, z.end);
        const glm::ivec3 first = brick_position(bone.content().size_bricks, index) * brick_edge_voxels;
        boxes_.push_back({first + low, high - low});
    }
    return boxes_;
}

}  // namespace osteomill
