#include "simulation/engagement/shank_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "common/scene/burr.h"

namespace osteomill {

namespace {

/// Rings for each cone of a profile: one, and one more wherever the heights of a cone's rings are farthest
/// apart as a ratio.
std::vector<int> rings_by_cone(const ShankProfile& shank, int rings) {
    std::vector<int> counts(shank.size() - 1, 1);
    const auto spread = [&](std::size_t cone) {
        return std::log(shank[cone + 1].height_mm / shank[cone].height_mm) / counts[cone];
    };
    for (int left = rings - static_cast<int>(counts.size()); left > 0; --left) {
        std::size_t widest = 0;
        for (std::size_t cone = 1; cone < counts.size(); ++cone)
            if (spread(cone) > spread(widest)) widest = cone;
        ++counts[widest];
    }
    return counts;
}

/// Distance from a sample at `position`, in voxels, outward along `normal` to the bone, searched from
/// `inmost` (negative) on; nothing if there is none within reach.
std::optional<float> gap_voxels(const BrickNeighbourhood& bricks, const glm::vec3& position,
                                const glm::vec3& normal, float inmost) {
    const std::array<float, 4> offsets{inmost, std::max(inmost, -0.5f), 0.5f,
                                       static_cast<float>(Engagement::reach_voxels)};
    float inner_offset = inmost;
    float inner = 0.0f;
    for (const float offset : offsets) {
        const float fraction = bricks.fraction(position + offset * normal);
        if (fraction >= surface_fraction) {
            if (offset == inmost) return inmost;
            return inner_offset + (offset - inner_offset) * (surface_fraction - inner) / (fraction - inner);
        }
        inner_offset = offset;
        inner = fraction;
    }
    return std::nullopt;
}

}  // namespace

ShankProbe::ShankProbe(const Burr& burr) : bricks_(Engagement::reach_voxels + 1.0) {
    if (burr.shank.empty()) return;
    const std::vector<int> counts = rings_by_cone(burr.shank, rings);
    for (std::size_t cone = 0; cone < counts.size(); ++cone)
        add_cone(burr.shank[cone], burr.shank[cone + 1], counts[cone], burr.radius_mm());
}

void ShankProbe::add_cone(const ShankPoint& low, const ShankPoint& high, int ring_count,
                          double burr_radius_mm) {
    const double rise_mm = high.height_mm - low.height_mm;
    const double widening_mm = high.radius_mm - low.radius_mm;
    const double slant_mm = std::hypot(rise_mm, widening_mm);
    const auto share_at = [&](double ring) {
        const double height_mm = low.height_mm * std::pow(high.height_mm / low.height_mm, ring / ring_count);
        return (height_mm - low.height_mm) / rise_mm;
    };
    for (int ring = 0; ring < ring_count; ++ring) {
        const double from = share_at(ring);
        const double to = share_at(ring + 1.0);
        const double middle = 0.5 * (from + to);
        const double height_mm = low.height_mm + middle * rise_mm;
        const double radius_mm = low.radius_mm + middle * widening_mm;
        const double area_mm2 = 2.0 * std::numbers::pi * radius_mm * (to - from) * slant_mm / samples_a_ring;
        const double turned = next_is_turned_ ? 0.5 : 0.0;
        next_is_turned_ = !next_is_turned_;
        if (std::hypot(height_mm, radius_mm) < burr_radius_mm) continue;
        for (int i = 0; i < samples_a_ring; ++i) {
            const double psi = 2.0 * std::numbers::pi * (i + turned) / samples_a_ring;
            const glm::dvec3 out(std::cos(psi), std::sin(psi), 0.0);
            samples_.push_back({.arm_mm = radius_mm * out + glm::dvec3(0.0, 0.0, height_mm),
                                .normal = (rise_mm * out - glm::dvec3(0.0, 0.0, widening_mm)) / slant_mm,
                                .area_mm2 = area_mm2,
                                .radius_mm = radius_mm});
        }
    }
}

void ShankProbe::sample(const Bone& bone, const glm::dvec3& position_mm, const glm::dvec3& spindle_axis,
                        Engagement& out) noexcept {
    out.shank_count = 0;
    if (samples_.empty()) return;
    const double h = bone.grid().spacing_mm;
    const glm::dmat3 frame = burr_frame(spindle_axis);
    for (const Sample& sample : samples_) {
        const glm::dvec3 arm_mm = frame * sample.arm_mm;
        const glm::dvec3 at = to_voxel_coordinates(bone.grid(), position_mm + arm_mm);
        if (!bricks_.gather(bone, at, Engagement::reach_voxels)) continue;
        const glm::dvec3 normal = frame * sample.normal;
        // No deeper than the spindle: beyond it lies the bone of the other side.
        const double inmost = std::max(-Engagement::reach_voxels, -sample.radius_mm / h);
        const std::optional<float> gap = gap_voxels(bricks_, glm::vec3(at - glm::dvec3(bricks_.base())),
                                                    glm::vec3(normal), static_cast<float>(inmost));
        if (!gap) continue;
        out.shank_patches[out.shank_count++] = {.normal = normal,
                                                .gap_mm = static_cast<double>(*gap) * h,
                                                .area_mm2 = sample.area_mm2,
                                                .arm_mm = arm_mm};
    }
}

}  // namespace osteomill
