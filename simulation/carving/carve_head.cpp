#include "simulation/carving/carve_head.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>
#include <utility>

namespace osteomill {

namespace {

constexpr double longest_step_voxels = 4.0;
constexpr int block_edge = 4;

/// A sweep seen from its own axes.
class SweptHead {
  public:
    explicit SweptHead(const HeadSweep& sweep) noexcept
        : profile_(sweep.profile),
          to_burr_(glm::transpose(sweep.frame)),
          to_(sweep.to),
          along_(to_burr_ * (sweep.to - sweep.from)),
          length_(glm::length(along_)) {}

    /// From all of the sweep, as far as `within` to either side of its surface: beyond, no more is known than
    /// the side. The distance from a convex body is convex along a line: the nearest approach is
    /// at an end or where the distance stops falling.
    double swept(const glm::dvec3& point, double within) const noexcept {
        const glm::dvec3 at_end = to_burr_ * (point - to_);
        const Seen end = seen(at_end);
        if (end.distance <= -within || end.distance > within + length_) return end.distance;
        if (length_ == 0.0 || end.slope <= 0.0) return end.distance;
        const Seen start = seen(at_end + along_);
        if (start.slope >= 0.0) return start.distance;
        double least = std::min(start.distance, end.distance);
        double low = 0.0, high = 1.0;  // shares of the sweep
        double slope_low = start.slope, slope_high = end.slope;
        for (int i = 0; i < 8; ++i) {
            // Halves in turn with secants: a corner of the outline makes the slope jump.
            const double share = i % 2 == 0 ? slope_low / (slope_low - slope_high) : 0.5;
            const double middle = low + share * (high - low);
            const Seen there = seen(at_end + (1.0 - middle) * along_);
            least = std::min(least, there.distance);
            if (there.slope < 0.0) {
                low = middle;
                slope_low = there.slope;
            } else {
                high = middle;
                slope_high = there.slope;
            }
            if (there.slope == 0.0 || (high - low) * length_ < 1e-2) break;
        }
        return least;
    }

  private:
    struct Seen {
        double distance;
        double slope;  ///< the distance's slope, as the head moves along the sweep
    };

    Seen seen(const glm::dvec3& in_burr) const noexcept {
        const double radius = std::sqrt(in_burr.x * in_burr.x + in_burr.y * in_burr.y);
        const NearestSurface nearest = profile_.nearest(radius, in_burr.z);
        const double outward = radius > 1e-9 ? (in_burr.x * along_.x + in_burr.y * along_.y) / radius : 0.0;
        return {nearest.distance, -(nearest.out * outward + nearest.up * along_.z)};
    }

    const BurrProfile& profile_;
    glm::dmat3 to_burr_;
    glm::dvec3 to_;
    glm::dvec3 along_;  // burr axes
    double length_;
};

/// Carves one short sweep.
class HeadCarver {
  public:
    /// `changes`: null if the bone stays as it is.
    HeadCarver(Bone& bone, const HeadSweep& sweep, const CarveSettings& settings, ChangeSink* changes,
               RemovalSink& removed) noexcept
        : bone_(bone),
          head_(sweep),
          coverage_(settings.coverage),
          uncut_(settings.uncut),
          touched_within_(rim_voxels(settings.coverage) + 1e-6),
          changes_(changes),
          sink_(removed) {
        const glm::dvec3 axis = sweep.frame[2];
        const glm::dvec3 tip = sweep.profile.tip_height() * axis;
        const glm::dvec3 top = sweep.profile.top_height() * axis;
        const double margin = sweep.profile.largest_radius() + 1.0;
        const glm::dvec3 low = glm::min(glm::min(sweep.from, sweep.to) + glm::min(tip, top) - margin,
                                        glm::dvec3(bone.grid().size_voxels));
        const glm::dvec3 high =
            glm::max(glm::max(sweep.from, sweep.to) + glm::max(tip, top) + margin, glm::dvec3(-1.0));
        first_brick_ = glm::ivec3(glm::max(low, glm::dvec3(0.0))) / brick_edge_voxels;
        end_brick_ = glm::min((glm::ivec3(glm::floor(high)) + brick_edge_voxels) / brick_edge_voxels,
                              size_in_bricks(bone.grid()));
        voxels_.base = first_brick_ * brick_edge_voxels;
    }

    void carve() noexcept {
        for (int z = first_brick_.z; z < end_brick_.z; ++z)
            for (int y = first_brick_.y; y < end_brick_.y; ++y)
                for (int x = first_brick_.x; x < end_brick_.x; ++x) carve_brick({x, y, z});
        hand_on();
    }

  private:
    /// Whether no voxel of the cube of `edge` voxels from `first` on is touched.
    bool misses_cube(const glm::ivec3& first, int edge) const noexcept {
        const double half = 0.5 * (edge - 1);
        const double reach = std::numbers::sqrt3 * half + touched_within_;
        return head_.swept(glm::dvec3(first) + half, reach) > reach;
    }

    void carve_brick(const glm::ivec3& brick) noexcept {
        const std::int32_t slot = bone_.slot(brick);
        if (slot == BoneContent::no_slot) return;
        const glm::ivec3 corner = brick * brick_edge_voxels;
        if (misses_cube(corner, brick_edge_voxels)) return;
        BrickChange change{.brick = bone_.content().brick_of_slot[static_cast<std::size_t>(slot)]};
        bool has_changed = false;
        for (int z = 0; z < brick_edge_voxels; z += block_edge)
            for (int y = 0; y < brick_edge_voxels; y += block_edge)
                for (int x = 0; x < brick_edge_voxels; x += block_edge)
                    has_changed |= carve_block(slot, corner, {x, y, z}, change);
        if (has_changed && changes_ != nullptr) changes_->push(change, std::as_const(bone_).fractions(slot));
    }

    bool carve_block(std::int32_t slot, const glm::ivec3& corner, const glm::ivec3& block,
                     BrickChange& change) noexcept {
        const auto fractions = std::as_const(bone_).fractions(slot);
        std::uint32_t any = 0;
        for (int z = 0; z < block_edge; ++z)
            for (int y = 0; y < block_edge; ++y) {
                std::uint32_t row = 0;
                std::memcpy(&row, &fractions[offset_in_brick(block + glm::ivec3(0, y, z))], sizeof row);
                any |= row;
            }
        if (any == 0 || misses_cube(corner + block, block_edge)) return false;
        bool has_changed = false;
        for (int z = 0; z < block_edge; z += 2)
            for (int y = 0; y < block_edge; y += 2)
                for (int x = 0; x < block_edge; x += 2) {
                    const glm::ivec3 eight = block + glm::ivec3(x, y, z);
                    if (misses_cube(corner + eight, 2)) continue;
                    for (int i = 0; i < 8; ++i)
                        has_changed |=
                            carve_voxel(slot, corner, eight + glm::ivec3(i & 1, i >> 1 & 1, i >> 2), change);
                }
        return has_changed;
    }

    bool carve_voxel(std::int32_t slot, const glm::ivec3& corner, const glm::ivec3& voxel,
                     BrickChange& change) noexcept {
        const std::size_t offset = offset_in_brick(voxel);
        const std::int32_t old = std::as_const(bone_).fractions(slot)[offset];
        if (old == 0) return false;
        if (uncut_ != nullptr && uncut_->of_label[bone_.content().tissue_in(slot, offset)]) return false;
        const glm::ivec3 position = corner + voxel;
        const std::int32_t left =
            std::min(old, level_left_at(coverage_, head_.swept(glm::dvec3(position), touched_within_)));
        if (left == old) return false;
        if (changes_ != nullptr) bone_.fractions(slot)[offset] = static_cast<std::uint8_t>(left);
        change.voxels.set(offset);
        enter(slot, offset, position, old - left);
        return true;
    }

    void enter(std::int32_t slot, std::size_t offset, const glm::ivec3& position,
               std::int32_t levels) noexcept {
        if (voxels_.count == RemovedVoxels::capacity) hand_on();
        const std::size_t i = voxels_.count++;
        const glm::vec3 from_base(position - voxels_.base);
        voxels_.x[i] = from_base.x;
        voxels_.y[i] = from_base.y;
        voxels_.z[i] = from_base.z;
        voxels_.levels[i] = static_cast<float>(levels);
        voxels_.slot[i] = slot;
        voxels_.offset[i] = static_cast<std::int32_t>(offset);
    }

    void hand_on() noexcept {
        if (voxels_.count == 0) return;
        voxels_.pad();
        sink_.take(voxels_);
        voxels_.count = 0;
    }

    Bone& bone_;
    SweptHead head_;
    VoxelCoverage coverage_;
    const UncutTissues* uncut_;
    double touched_within_;
    ChangeSink* changes_;
    RemovalSink& sink_;
    glm::ivec3 first_brick_{0};
    glm::ivec3 end_brick_{0};
    RemovedVoxels voxels_;  // scratch, not cleared
};

}  // namespace

double distance_from(const HeadSweep& sweep, const glm::dvec3& point) noexcept {
    return SweptHead(sweep).swept(point, std::numeric_limits<double>::infinity());
}

void carve_head(Bone& bone, const HeadSweep& sweep, const CarveSettings& settings, ChangeSink& changes,
                RemovalSink& removed) noexcept {
    const double reach =
        std::max(-sweep.profile.tip_height(), sweep.profile.top_height()) + sweep.profile.largest_radius();
    Sweep near{sweep.from, sweep.to, reach};
    if (!cut_to_grid(near, bone.grid().size_voxels)) return;
    const glm::dvec3 along = near.to - near.from;
    const double parts = std::max(1.0, std::ceil(glm::length(along) / longest_step_voxels));
    glm::dvec3 from = near.from;
    for (double part = 1.0; part <= parts; part += 1.0) {
        const glm::dvec3 to = part == parts ? near.to : near.from + along * (part / parts);
        HeadCarver(bone, {sweep.profile, sweep.frame, from, to}, settings, &changes, removed).carve();
        from = to;
    }
}

void preview_carve(Bone& bone, const HeadSweep& sweep, const CarveSettings& settings,
                   RemovalSink& would_go) noexcept {
    HeadCarver(bone, sweep, settings, nullptr, would_go).carve();
}

}  // namespace osteomill
