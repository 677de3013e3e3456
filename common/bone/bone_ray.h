// Rays through a bone on the CPU, in voxel coordinates. They meet the bone's surface where half a voxel is
// left, trilinear between the centres of voxels, as in a picture.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "common/bone/bone.h"

namespace osteomill {

/// One unit of `t` is a voxel: the direction has a length of 1.
struct BoneRay {
    glm::dvec3 origin;
    glm::dvec3 direction;

    glm::dvec3 at(double t) const { return origin + t * direction; }
};

struct RaySpan {
    double from;
    double to;

    bool is_empty() const { return !(from < to); }
};

/// Span of a ray, forward and backward, within a box; empty if it misses the box.
RaySpan span_within(const BoneRay& ray, const glm::dvec3& low, const glm::dvec3& high);
/// Span of a ray within all voxels of a grid.
RaySpan span_within(const BoneRay& ray, const Grid& grid);

/// Fractions, 0 to 255, along rays; the bone outlives it. For one thread: it remembers the brick that it read
/// last.
class BoneSampler {
  public:
    explicit BoneSampler(const Bone& bone) : bone_(bone) {}

    /// Fraction of any voxel.
    double at(const glm::ivec3& voxel);
    /// Fraction at any place, trilinear.
    double between(const glm::dvec3& place);

    /// The first `t` of a span at which the ray is in bone, to a sixtieth of a voxel; places where
    /// `is_shown(t)` is false are skipped. It samples every half voxel, and skips bricks without bone.
    template <typename IsShown>
    std::optional<double> first_surface(const BoneRay& ray, const RaySpan& span, IsShown&& is_shown) {
        constexpr double step = 0.5;
        for (double t = span.from + nudge; t <= span.to;) {
            const glm::ivec3 voxel(glm::floor(ray.at(t) + 0.5));
            if (!contains(bone_.grid(), voxel)) {
                t += step;
            } else if (!has_bone(voxel / brick_edge_voxels)) {
                const glm::dvec3 low = glm::dvec3(voxel / brick_edge_voxels * brick_edge_voxels) - 0.5;
                t = std::max(t, span_within(ray, low, low + double{brick_edge_voxels}).to) + nudge;
            } else if (const auto is_in =
                           [&](double s) { return between(ray.at(s)) > surface_fraction && is_shown(s); };
                       at(voxel) > 0.0 && is_in(t)) {
                double before = t - step;
                for (int halving = 0; halving < 5; ++halving) {
                    const double middle = 0.5 * (before + t);
                    (is_in(middle) ? t : before) = middle;
                }
                return t;
            } else {
                t += step;
            }
        }
        return std::nullopt;
    }

  private:
    /// Off the face of a voxel or a brick.
    static constexpr double nudge = 1e-6;

    bool has_bone(const glm::ivec3& brick);

    const Bone& bone_;
    glm::ivec3 brick_{-1};
    std::int32_t slot_ = BoneContent::no_slot;
};

}  // namespace osteomill
