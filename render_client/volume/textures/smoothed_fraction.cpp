#include "render_client/volume/textures/smoothed_fraction.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace osteomill {

namespace {

/// (1, 2, 1) three times over.
constexpr std::array<std::uint32_t, 2 * smoothing_reach_voxels + 1> weights{1, 6, 15, 20, 15, 6, 1};
constexpr unsigned weights_bits = 6;  ///< they add up to 2^6

/// Least share of a hardly visible tissue. With less, the slope at its surface would be too small for bytes
/// to give its direction.
constexpr float least_share = 0.3f;

/// Sums of neighbours `stride` apart, of `count` places from the first on; `shift` takes bits away, rounding.
/// Whole runs of places at once, which compilers make fast.
template <typename From, typename To>
void sum_neighbours(const From* from, To* to, std::size_t count, std::size_t stride, unsigned shift) {
    const std::uint32_t half = shift == 0 ? 0 : 1U << (shift - 1);
    for (std::size_t place = 0; place < count; ++place) {
        std::uint32_t sum = half;
        for (std::size_t tap = 0; tap < weights.size(); ++tap)
            sum += weights[tap] * from[place + tap * stride];
        to[place] = static_cast<To>(sum >> shift);
    }
}

}  // namespace

FractionSmoother::FractionSmoother(const TransferTable& table) : voxel_codes_(table.codes) {
    if (table.mode != TransferMode::translucent) return;
    for (const glm::vec4& look : table.by_code)
        share_by_code_.push_back(
            static_cast<std::uint8_t>(std::lround(255.0f * glm::mix(least_share, 1.0f, look.a))));
}

void FractionSmoother::count_by_opacity(const Bone& bone, const VoxelBox& box) {
    code_.resize(box.count());
    copy_codes(bone, voxel_codes_, box, code_);
    for (std::size_t voxel = 0; voxel < code_.size(); ++voxel)
        fraction_[voxel] =
            static_cast<std::uint8_t>((fraction_[voxel] * share_by_code_[code_[voxel]] + 127) / 255);
}

std::span<const std::uint8_t> FractionSmoother::smooth(const Bone& bone, const VoxelBox& box) {
    const VoxelBox bordered{box.first - smoothing_reach_voxels, box.size + 2 * smoothing_reach_voxels};
    const auto row = static_cast<std::size_t>(bordered.size.x);
    const std::size_t layer = row * static_cast<std::size_t>(bordered.size.y);
    const std::size_t all = bordered.count();
    fraction_.resize(all);
    copy_channel(bone, BoneChannel::fraction, bordered, fraction_);
    if (!share_by_code_.empty()) count_by_opacity(bone, bordered);
    // A pass leaves its sum where its first neighbour was, so that the box ends up in the first places of
    // each row. A sum keeps 14 bits, six more than the result.
    sums_along_x_.resize(all);
    sums_along_xy_.resize(all);
    constexpr std::size_t behind = 2 * smoothing_reach_voxels;
    sum_neighbours(fraction_.data(), sums_along_x_.data(), all - behind, 1, 0);
    sum_neighbours(sums_along_x_.data(), sums_along_xy_.data(), all - behind - behind * row, row,
                   weights_bits);
    smoothed_.resize(box.count());
    std::uint8_t* to = smoothed_.data();
    for (int z = 0; z < box.size.z; ++z)
        for (int y = 0; y < box.size.y; ++y, to += box.size.x)
            sum_neighbours(sums_along_xy_.data() + static_cast<std::size_t>(z) * layer +
                               static_cast<std::size_t>(y) * row,
                           to, static_cast<std::size_t>(box.size.x), layer, 2 * weights_bits);
    return smoothed_;
}

SmoothedTexture::SmoothedTexture(const Bone& bone, const TransferTable& table, const AtlasLayout& places)
    : SmoothedTexture(table, gl::Texture3D(gl::VoxelFormat::interpolated_byte, places.texture_size())) {
    finish(fill(bone, places));
}

Steps SmoothedTexture::fill(const Bone& bone, const AtlasLayout& places) {
    const std::vector<PlacedVoxels> all = places.all(bone.content());
    for (std::size_t region = 0; region < all.size(); ++region) {
        smooth(bone, all[region]);
        co_yield static_cast<double>(region) / static_cast<double>(all.size());
    }
}

void SmoothedTexture::update(const Bone& bone, AtlasLayout& places, std::span<const VoxelBox> changed) {
    for (const PlacedVoxels& placed : places.that_show(bone, changed, smoothing_reach_voxels))
        smooth(bone, placed);
}

void SmoothedTexture::smooth(const Bone& bone, const PlacedVoxels& placed) {
    texture_.upload(placed.first_texel, placed.voxels.size, smoother_.smooth(bone, placed.voxels));
}

}  // namespace osteomill
