// The bone: which bricks hold bone, stiffness and tissue from the CT (shared, immutable), and the fraction of
// each voxel that milling has left (owned). Nothing is stored for a brick without bone, no stiffness for a
// homogeneous scene, no tissue for an unlabelled one. No I/O, no threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/bone/brick.h"
#include "common/bone/grid.h"

namespace osteomill {

/// Fractions left of a bone's voxels, brick by brick: plain, or shared.
///
/// Plain bricks are in one block of their own, and a copy copies all of it. Shared bricks stay those of the
/// bone that was shared; a brick is copied when it is first written to. So a copy of shared bricks copies
/// only those written to since. The first write to a shared brick allocates, so real-time loops have plain
/// ones.
class FractionBricks {
  public:
    /// Plain.
    explicit FractionBricks(std::vector<ByteBrick> bricks);
    FractionBricks(const FractionBricks& other);
    FractionBricks(FractionBricks&&) noexcept = default;
    FractionBricks& operator=(FractionBricks other) noexcept;
    ~FractionBricks() = default;

    /// Shares the bricks from now on; copies share them, too. Copies no longer copy the bricks that it has by
    /// then.
    void share();

    std::size_t size() const { return places_.size(); }
    BrickFractions operator[](std::size_t slot) const { return *places_[slot]; }
    std::span<std::uint8_t, brick_voxel_count> to_write(std::size_t slot) {
        if (is_shared_ && lies_in_block(places_[slot])) make_own(slot);
        return *places_[slot];
    }

    /// Bricks that this object has for itself.
    std::size_t own_bricks() const { return is_shared_ ? own_.size() : places_.size(); }

  private:
    bool lies_in_block(const ByteBrick* brick) const {
        return std::less_equal<>()(block_->data(), brick) &&
               std::less<>()(brick, block_->data() + block_->size());
    }
    void make_own(std::size_t slot);

    std::shared_ptr<std::vector<ByteBrick>> block_;  // shared: written to by nobody
    bool is_shared_ = false;
    std::vector<std::pair<std::size_t, std::unique_ptr<ByteBrick>>> own_;  // by slot; of shared bricks
    std::vector<ByteBrick*> places_;                                       // by slot
};

/// The part of a bone that never changes once it is built. Copies of the bone (milling loop, streaming
/// mirror) share it, so it is stored once.
struct BoneContent {
    static constexpr std::int32_t no_slot = BrickTable::no_slot;

    Grid grid;
    glm::ivec3 size_bricks{0};
    BrickTable slot_of_brick;
    std::vector<BrickIndex> brick_of_slot;  ///< ascending
    double homogeneous_stiffness = 1.0;     ///< relative stiffness of all bone where `stiffness` is empty
    double stiffness_per_code = 0.02;       ///< relative stiffness = code * this
    std::vector<ByteBrick> stiffness;       ///< codes by slot; empty in a homogeneous scene
    std::vector<ByteBrick> tissue;          ///< labels by slot; empty in an unlabelled scene

    /// Relative stiffness of the bone of a voxel in a stored brick (1: the bone of the burr's K_t).
    double stiffness_in(std::int32_t slot, std::size_t offset) const {
        if (stiffness.empty()) return homogeneous_stiffness;
        return stiffness_per_code * stiffness[static_cast<std::size_t>(slot)][offset];
    }
    /// Labels of a stored brick; nullptr in an unlabelled scene.
    const ByteBrick* tissues_of(std::int32_t slot) const {
        return tissue.empty() ? nullptr : &tissue[static_cast<std::size_t>(slot)];
    }
    /// Tissue label of a voxel in a stored brick; 0 (unlabelled) in an unlabelled scene.
    std::uint8_t tissue_in(std::int32_t slot, std::size_t offset) const {
        return tissue.empty() ? std::uint8_t{0} : tissue[static_cast<std::size_t>(slot)][offset];
    }
};

/// A bone that can be milled. Copies share content and own their fractions; copies of a shared bone own only
/// the bricks that change in them.
class Bone {
  public:
    /// Takes over content and initial fractions (one brick a slot). Throws std::invalid_argument if their
    /// sizes do not agree.
    Bone(std::shared_ptr<const BoneContent> content, std::vector<ByteBrick> fraction_by_slot);

    const Grid& grid() const { return content_->grid; }
    const BoneContent& content() const { return *content_; }
    std::shared_ptr<const BoneContent> shared_content() const { return content_; }
    std::size_t stored_bricks() const { return fraction_.size(); }

    /// For a bone with which many sessions begin, none of them in real time (FractionBricks): a copy
    /// copies only the bricks that were milled since, and the first milling in a brick allocates.
    void share() { fraction_.share(); }
    /// Number of bricks whose fractions it holds for itself: all, unless the bone is shared.
    std::size_t own_bricks() const { return fraction_.own_bricks(); }

    /// Slot of a brick, or BoneContent::no_slot. `brick` must lie within size_bricks.
    std::int32_t slot(const glm::ivec3& brick) const {
        return slot(brick_index(content_->size_bricks, brick));
    }
    /// Slot of a brick by its number; no_slot for any number that is no stored brick's.
    std::int32_t slot(BrickIndex brick) const { return content_->slot_of_brick.find(brick); }

    /// Fraction left of each voxel of a stored brick, 0 (none) to 255 (all).
    BrickFractions fractions(std::int32_t slot) const { return fraction_[static_cast<std::size_t>(slot)]; }
    std::span<std::uint8_t, brick_voxel_count> fractions(std::int32_t slot) {
        return fraction_.to_write(static_cast<std::size_t>(slot));
    }

    /// Fraction of any voxel; 0 outside the grid and in bricks without bone.
    std::uint8_t fraction_at(const glm::ivec3& voxel) const;
    /// Relative stiffness of the bone of a voxel; 0 if no brick is stored.
    double stiffness_at(const glm::ivec3& voxel) const;
    /// Tissue label of a voxel; 0 (unlabelled) if no label is stored.
    std::uint8_t tissue_at(const glm::ivec3& voxel) const;

  private:
    std::shared_ptr<const BoneContent> content_;
    FractionBricks fraction_;
};

/// Volume of the bone that is left, mm^3: voxel volume times the sum of fractions / 255.
double bone_volume_mm3(const Bone& bone);

/// Volume left per tissue label, mm^3, index = label. One entry (label 0) for an unlabelled bone.
std::vector<double> bone_volume_by_tissue_mm3(const Bone& bone);

/// Checksum of the fractions left: the sum (mod 2^64) over bricks of XXH3-64 of the 4096 fractions, seeded
/// with the brick's index; a brick that is all zero adds nothing. So it does not depend on which empty bricks
/// are stored, and it can be kept up to date brick by brick: subtract a brick's old term, add its new one.
std::uint64_t checksum(const Bone& bone);
std::uint64_t checksum_of_brick(BrickIndex brick, BrickFractions fractions);

/// Digest of the whole bone, including stiffness and tissues: two bones of one digest are milled alike.
std::uint64_t digest(const Bone& bone);

/// Bytes that this bone holds: brick table, stiffness, tissue and the fractions of its own. They grow with
/// the bricks that hold bone; the grid round them costs nothing. Addresses that a builder reserved and did
/// not need are not counted: at a page a brick, the system never backs them.
std::size_t memory_bytes(const Bone& bone);

}  // namespace osteomill
