// A set of a bone's voxels, and its boundary within the original bone.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick.h"

namespace osteomill {

/// Only voxels of stored bricks. `bone` outlives it, and keeps its bricks.
class VoxelSet {
  public:
    explicit VoxelSet(const Bone& bone) : bone_(&bone), by_slot_(bone.stored_bricks()) {}

    void set(std::int32_t slot, std::size_t voxel) { by_slot_[static_cast<std::size_t>(slot)].set(voxel); }
    bool contains(const glm::ivec3& voxel) const;
    bool contains(std::int32_t slot, std::size_t voxel) const {
        return by_slot_[static_cast<std::size_t>(slot)][voxel];
    }
    std::size_t count() const;

    /// Centres of its voxels that share a face with a voxel that is bone (half of it or more) and not of the
    /// set. The set has no boundary at air: nothing was cut there.
    std::vector<glm::dvec3> boundary_mm() const;
    /// Centres of its voxels that share a face with any voxel that is not of the set.
    std::vector<glm::dvec3> surface_mm() const;

    /// Calls `visit(slot, offset, voxel)` for each.
    template <typename Visit>
    void for_each(Visit&& visit) const {
        const BoneContent& content = bone_->content();
        for (std::size_t slot = 0; slot < by_slot_.size(); ++slot) {
            const glm::ivec3 first =
                brick_edge_voxels * brick_position(content.size_bricks, content.brick_of_slot[slot]);
            by_slot_[slot].for_each([&](std::size_t offset) {
                visit(static_cast<std::int32_t>(slot), offset, first + voxel_in_brick(offset));
            });
        }
    }

  private:
    template <typename IsOutside>
    std::vector<glm::dvec3> beside_mm(const IsOutside& is_outside) const;

    const Bone* bone_;
    std::vector<VoxelMask> by_slot_;
};

/// Half of a voxel or more.
inline constexpr std::uint8_t half_a_voxel = 128;

/// The cavity: the voxels that were half bone or more and lost more than half of themselves. `before`, which
/// outlives it, and `after` are of the same bricks.
VoxelSet cavity_of(const Bone& before, const Bone& after);

/// The nearest of many places (Boost.Geometry's R-tree).
class NearestPlace {
  public:
    explicit NearestPlace(std::span<const glm::dvec3> places_mm);
    ~NearestPlace();
    NearestPlace(NearestPlace&&) noexcept;
    NearestPlace& operator=(NearestPlace&&) noexcept;

    /// Nothing if there is no place.
    std::optional<glm::dvec3> nearest_mm(const glm::dvec3& from_mm) const;
    std::optional<double> distance_mm(const glm::dvec3& from_mm) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace osteomill
