// Sampling of the bone around one burr and its shank into an engagement map (engagement.h).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/burr.h"
#include "common/scene/scene.h"
#include "simulation/engagement/brick_neighbourhood.h"
#include "simulation/engagement/burr_patches.h"
#include "simulation/engagement/engagement.h"
#include "simulation/engagement/patch_crossings.h"

namespace osteomill {

// Sampling of the bone around a burr's shank into the walls of an engagement map (engagement.h).

/// Eight rings of eight samples about the spindle, each ring turned against the next by half a sample. Every
/// cone of the profile has at least one ring; the others go where rings are far apart for their height, so
/// that they are dense near the burr, where holes are deep. A rim between two rings is met late by at most
/// the tilt times their distance. The part within the burr's ball has no sample. Allocates when constructed,
/// nothing for a burr without a shank.
class ShankProbe {
  public:
    explicit ShankProbe(const Burr& burr);

    /// Fills the shank's part of `out` for a burr at `position_mm` with its spindle along `spindle_axis`
    /// (unit). A sample with no brick of bone near is skipped. Real-time safe.
    void sample(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                Engagement& out) noexcept;

    static constexpr int rings = 8;
    static constexpr int samples_a_ring = 8;
    static_assert(rings * samples_a_ring <= static_cast<int>(Engagement::max_shank_patches));

  private:
    struct Sample {
        glm::dvec3 arm_mm;  ///< from the burr's centre, burr axes
        glm::dvec3 normal;  ///< burr axes
        double area_mm2;
        double radius_mm;  ///< of the shank there
    };

    void add_cone(const ShankPoint& low, const ShankPoint& high, int ring_count, double burr_radius_mm);

    std::vector<Sample> samples_;
    BrickNeighbourhood bricks_;
    bool next_is_turned_ = false;  // while constructing
};

/// Samples the bone around one burr and its shank, at the burr's patches (burr_patches.h). Allocates when
/// constructed.
class EngagementProbe {
  public:
    explicit EngagementProbe(const Burr& burr, double spacing_mm, const EdgeShares& edge_shares = {},
                             const UncutTissues& uncut = {});

    /// Fills `out` for a burr at `position_mm` with its spindle along `spindle_axis` (unit), which turns at
    /// `speed_share` (positive) of the burr's own speed. Bone begins as in patch_crossings.h. Real-time safe.
    void sample(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                double speed_share, InsideBurr inside, Engagement& out) noexcept;
    /// Samples at the burr's own speed, with any bone inside.
    void sample(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                Engagement& out) noexcept {
        sample(bone, position_mm, spindle_axis, 1.0, InsideBurr::any, out);
    }

  private:
    void sample_burr(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                     double speed_share, InsideBurr inside, Engagement& out) noexcept;

    /// Whether no burr cuts the bone that begins at a crossing.
    bool is_uncut(const glm::vec3& surface, const glm::vec3& outward,
                  const PatchCrossing& crossing) const noexcept;

    /// Thickness of what is still to be cut before the uncut bone of such a crossing, to a tenth of a voxel.
    double voxels_over_uncut(const glm::vec3& surface, const glm::vec3& outward,
                             const PatchCrossing& crossing) const noexcept;

    double radius_mm_;
    bool has_edge_force_;
    EdgeShares edge_shares_;
    UncutTissues uncut_;
    std::vector<BurrPatch> patches_;
    double bounding_radius_mm_;  // of a ball about the head's middle
    double middle_height_mm_ = 0.0;
    bool has_beside_ = false;  // of a head that is no ball
    PatchCrossings crossings_;
    BrickNeighbourhood bricks_;
    ShankProbe shank_;
};

}  // namespace osteomill
