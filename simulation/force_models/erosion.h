// Erosion: bone that wears off under a turning burr. The contact models from before the milling law know no
// chip: their bone loses density as long as a burr covers it, the harder bone the more slowly,
//
//     d fraction / dt = - (e / s) cover,
//
// with s the relative stiffness of the voxel (1: the bone of the burr's K_t) and cover the part of it that
// the burr covers (voxel_coverage.h). The published systems each have their own variant of this; here all
// share one, so that their forces can be compared on the same bone. At the default e = 20 /s bone that is
// fully covered lasts 50 ms: a burr fed at 6 mm/s, as published, carries a layer of 6 / 20 = 0.3 mm of bone
// within it, and so feels about the newton that milling at that feed asks for.
//
// A fraction has only 255 levels, and at 10 kHz a voxel loses half a level a step. The part of a level that
// remains is kept and added at the next step, so that the loss in a second does not depend on the number of
// steps.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "common/scene/scene.h"
#include "simulation/force_models/ball_rows.h"

namespace osteomill {

inline constexpr double default_erosion_per_s = 20.0;

/// Takes voxels that erosion lowered: real-time safe.
class ErosionSink {
  public:
    virtual ~ErosionSink() = default;
    /// A voxel, by its brick's slot and its offset there, lost `levels` of its 255.
    virtual void take(std::int32_t slot, std::size_t offset, int levels) noexcept = 0;
};

class Erosion {
  public:
    /// Softer bone wears no faster than this: bone of stiffness 0 would vanish at once.
    static constexpr double least_stiffness = 0.02;

    /// For balls of up to `largest_radius_voxels`. Allocates two bytes for each voxel of a cube around it.
    explicit Erosion(double largest_radius_voxels);

    /// Erodes the voxels that `ball` (voxel coordinates) covers by `dose` = e dt, the share of a voxel of
    /// stiffness 1 that is fully covered. Pushes the change of each brick. Real-time safe. Tissue of `uncut`
    /// stays.
    void erode(Bone& bone, const Ball& ball, double dose, ChangeSink& changes, ErosionSink& removed,
               const UncutTissues& uncut = {}) noexcept;

  private:
    std::uint16_t& remainder(const glm::ivec3& voxel) {
        const glm::ivec3 wrapped = voxel & (edge_ - 1);
        return remainders_[static_cast<std::size_t>(wrapped.x + edge_ * (wrapped.y + edge_ * wrapped.z))];
    }

    int edge_;  // a power of two, at least the ball's width
    // 1/65536 of a level, by the voxel's coordinates modulo the edge. A burr that moves on leaves its
    // remainders to voxels an edge farther: less than a level each, and none is lost.
    std::vector<std::uint16_t> remainders_;
};

}  // namespace osteomill
