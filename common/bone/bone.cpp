#include "common/bone/bone.h"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace osteomill {

namespace {

std::vector<ByteBrick*> places_in(std::vector<ByteBrick>& block) {
    std::vector<ByteBrick*> places;
    places.reserve(block.size());
    for (ByteBrick& brick : block) places.push_back(&brick);
    return places;
}

}  // namespace

FractionBricks::FractionBricks(std::vector<ByteBrick> bricks)
    : block_(std::make_shared<std::vector<ByteBrick>>(std::move(bricks))), places_(places_in(*block_)) {}

FractionBricks::FractionBricks(const FractionBricks& other)
    : block_(other.block_), is_shared_(other.is_shared_), places_(other.places_) {
    if (block_ == nullptr) return;  // of one that was moved from
    if (!is_shared_) {
        block_ = std::make_shared<std::vector<ByteBrick>>(*block_);
        places_ = places_in(*block_);
        return;
    }
    own_.reserve(other.own_.size());
    for (const auto& [slot, brick] : other.own_) {
        own_.emplace_back(slot, std::make_unique<ByteBrick>(*brick));
        places_[slot] = own_.back().second.get();
    }
}

FractionBricks& FractionBricks::operator=(FractionBricks other) noexcept {
    std::swap(block_, other.block_);
    std::swap(is_shared_, other.is_shared_);
    std::swap(own_, other.own_);
    std::swap(places_, other.places_);
    return *this;
}

void FractionBricks::share() {
    if (is_shared_ && own_.empty()) return;
    if (is_shared_) {
        std::vector<ByteBrick> bricks;
        bricks.reserve(places_.size());
        for (const ByteBrick* brick : places_) bricks.push_back(*brick);
        *this = FractionBricks(std::move(bricks));
    }
    is_shared_ = true;
}

void FractionBricks::make_own(std::size_t slot) {
    own_.emplace_back(slot, std::make_unique<ByteBrick>(*places_[slot]));
    places_[slot] = own_.back().second.get();
}

namespace {

void require_consistent(const BoneContent& content, std::size_t fraction_bricks) {
    require_valid(content.grid);
    const std::size_t slots = content.brick_of_slot.size();
    if (content.size_bricks != size_in_bricks(content.grid))
        throw std::invalid_argument("the bone's brick table does not fit its grid");
    if (slots != fraction_bricks || (!content.stiffness.empty() && content.stiffness.size() != slots) ||
        (!content.tissue.empty() && content.tissue.size() != slots))
        throw std::invalid_argument("the bone's channels do not hold the same number of bricks");
    for (std::size_t slot = 0; slot < slots; ++slot) {
        const BrickIndex brick = content.brick_of_slot[slot];
        if (brick_position(content.size_bricks, brick).z >= content.size_bricks.z ||
            content.slot_of_brick.find(brick) != static_cast<std::int32_t>(slot) ||
            (slot > 0 && brick <= content.brick_of_slot[slot - 1]))
            throw std::invalid_argument("the bone's brick table contradicts itself at slot " +
                                        std::to_string(slot));
    }
}

/// Slot that holds a voxel, or no_slot outside the grid and in bricks without bone.
std::int32_t slot_of_voxel(const Bone& bone, const glm::ivec3& voxel) {
    if (!contains(bone.grid(), voxel)) return BoneContent::no_slot;
    return bone.slot(voxel / brick_edge_voxels);
}

}  // namespace

Bone::Bone(std::shared_ptr<const BoneContent> content, std::vector<ByteBrick> fraction_by_slot)
    : content_(std::move(content)), fraction_(std::move(fraction_by_slot)) {
    if (!content_) throw std::invalid_argument("a bone needs content");
    require_consistent(*content_, fraction_.size());
}

std::uint8_t Bone::fraction_at(const glm::ivec3& voxel) const {
    const std::int32_t slot = slot_of_voxel(*this, voxel);
    return slot == BoneContent::no_slot ? std::uint8_t{0} : fractions(slot)[offset_in_brick(voxel)];
}

double Bone::stiffness_at(const glm::ivec3& voxel) const {
    const std::int32_t slot = slot_of_voxel(*this, voxel);
    return slot == BoneContent::no_slot ? 0.0 : content_->stiffness_in(slot, offset_in_brick(voxel));
}

std::uint8_t Bone::tissue_at(const glm::ivec3& voxel) const {
    const std::int32_t slot = slot_of_voxel(*this, voxel);
    return slot == BoneContent::no_slot ? std::uint8_t{0} : content_->tissue_in(slot, offset_in_brick(voxel));
}

double bone_volume_mm3(const Bone& bone) {
    std::uint64_t codes = 0;
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const auto fractions = bone.fractions(static_cast<std::int32_t>(slot));
        codes = std::accumulate(fractions.begin(), fractions.end(), codes);
    }
    return static_cast<double>(codes) / 255.0 * voxel_volume_mm3(bone.grid());
}

std::vector<double> bone_volume_by_tissue_mm3(const Bone& bone) {
    if (bone.content().tissue.empty()) return {bone_volume_mm3(bone)};
    std::array<std::uint64_t, 256> codes{};
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const auto fractions = bone.fractions(static_cast<std::int32_t>(slot));
        const ByteBrick& labels = bone.content().tissue[slot];
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel)
            codes[labels[voxel]] += fractions[voxel];
    }
    std::vector<double> volumes(codes.size());
    std::transform(codes.begin(), codes.end(), volumes.begin(), [&](std::uint64_t code) {
        return static_cast<double>(code) / 255.0 * voxel_volume_mm3(bone.grid());
    });
    return volumes;
}

std::uint64_t checksum_of_brick(BrickIndex brick, BrickFractions fractions) {
    if (std::all_of(fractions.begin(), fractions.end(), [](std::uint8_t f) { return f == 0; })) return 0;
    return XXH3_64bits_withSeed(fractions.data(), fractions.size(), brick);
}

std::uint64_t checksum(const Bone& bone) {
    std::uint64_t sum = 0;
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot)
        sum += checksum_of_brick(bone.content().brick_of_slot[slot],
                                 bone.fractions(static_cast<std::int32_t>(slot)));
    return sum;
}

std::uint64_t digest(const Bone& bone) {
    const BoneContent& content = bone.content();
    const Grid& grid = content.grid;
    std::vector<std::uint64_t> parts{checksum(bone)};
    const auto add = [&parts](const void* bytes, std::size_t size, std::uint64_t seed) {
        parts.push_back(XXH3_64bits_withSeed(bytes, size, seed));
    };
    const std::array<double, 9> numbers{static_cast<double>(grid.size_voxels.x),
                                        static_cast<double>(grid.size_voxels.y),
                                        static_cast<double>(grid.size_voxels.z),
                                        grid.spacing_mm,
                                        grid.origin_mm.x,
                                        grid.origin_mm.y,
                                        grid.origin_mm.z,
                                        content.homogeneous_stiffness,
                                        content.stiffness_per_code};
    add(numbers.data(), sizeof(numbers), 0);
    // It does not depend on which empty bricks are stored, nor does checksum().
    for (const auto* channel : {&content.stiffness, &content.tissue}) {
        std::uint64_t sum = 0;
        for (std::size_t slot = 0; slot < channel->size(); ++slot) {
            const ByteBrick& brick = (*channel)[slot];
            if (std::ranges::all_of(brick, [](std::uint8_t byte) { return byte == 0; })) continue;
            sum += XXH3_64bits_withSeed(brick.data(), brick.size(), content.brick_of_slot[slot]);
        }
        parts.push_back(sum);
    }
    return XXH3_64bits(parts.data(), parts.size() * sizeof(parts.front()));
}

std::size_t memory_bytes(const Bone& bone) {
    const BoneContent& content = bone.content();
    return content.slot_of_brick.memory_bytes() +
           content.brick_of_slot.size() * (sizeof(BrickIndex) + sizeof(ByteBrick*)) +
           (content.stiffness.size() + content.tissue.size() + bone.own_bricks()) * sizeof(ByteBrick);
}

}  // namespace osteomill
