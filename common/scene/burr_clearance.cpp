#include "common/scene/burr_clearance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/scene/burr.h"
#include "common/scene/burr_profile.h"

namespace osteomill {

namespace {

constexpr double step_per_diameter = 0.1;
constexpr double longest_step_mm = 0.25;
/// Along an outline; no burr is a hundred times thinner than long.
constexpr double most_steps = 1000.0;

}  // namespace

// A layer's balls reach to twice its depth, where the next one's begin.
BurrClearance::BurrClearance(const Burr& burr) : largest_radius_mm_(burr.radius_mm()) {
    if (burr.is_ball()) {
        rings_.push_back(
            {.height_mm = 0.0, .radius_mm = 0.0, .ball_radius_mm = largest_radius_mm_, .balls = 1});
        return;
    }
    const BurrProfile profile(burr.head, burr.diameter_mm);
    const double step_mm = std::min(longest_step_mm, step_per_diameter * burr.diameter_mm);
    const int steps = static_cast<int>(std::min(most_steps, std::ceil(profile.outline_length() / step_mm)));
    const auto add = [&](double radius_mm, double height_mm) {
        const double ball_radius_mm = std::max(0.0, -profile.nearest(radius_mm, height_mm).distance);
        const double apart_mm = std::max(step_mm, ball_radius_mm);
        const double around_mm = 2.0 * std::numbers::pi * radius_mm;
        rings_.push_back({.height_mm = height_mm,
                          .radius_mm = radius_mm,
                          .ball_radius_mm = ball_radius_mm,
                          .balls = std::max(1, static_cast<int>(std::ceil(around_mm / apart_mm)))});
    };
    for (int i = 0; i <= steps; ++i)
        add(0.0, profile.tip_height() + (profile.top_height() - profile.tip_height()) * i / steps);
    for (double depth_mm = 0.0; depth_mm < largest_radius_mm_; depth_mm = 2.0 * depth_mm + step_mm)
        for (int i = 0; i <= steps; ++i) {
            const OutlinePoint point = profile.outline_at(profile.outline_length() * i / steps);
            const double radius_mm = point.radius - depth_mm * point.out;
            if (radius_mm >= 0.0) add(radius_mm, point.height - depth_mm * point.up);
        }
}

// A distance changes by no more than the way between two places: if the middle of a ring is far enough, its
// balls need no check.
std::optional<double> BurrClearance::clearance_mm(const DistanceField& field,
                                                  const ToolPose& pose) const noexcept {
    const glm::dmat3 frame = burr_frame(pose.spindle_axis);
    std::optional<double> least_mm;
    for (const Ring& ring : rings_) {
        const glm::dvec3 middle_mm = pose.position_mm + ring.height_mm * pose.spindle_axis;
        const auto take = [&](const glm::dvec3& centre_mm) {
            const std::optional<float> distance_mm = field.distance_mm(centre_mm);
            if (!distance_mm) return;
            const double clearance_mm = *distance_mm - ring.ball_radius_mm;
            if (!least_mm || clearance_mm < *least_mm) least_mm = clearance_mm;
        };
        if (ring.balls == 1) {
            take(middle_mm + ring.radius_mm * frame[0]);
            continue;
        }
        const double from_middle_mm = field.distance_mm(middle_mm).value_or(field.reach_mm());
        const double at_least_mm = from_middle_mm - ring.radius_mm - ring.ball_radius_mm - field.spacing_mm();
        if (least_mm && at_least_mm >= *least_mm) continue;
        for (int i = 0; i < ring.balls; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / ring.balls;
            take(middle_mm + ring.radius_mm * (std::cos(angle) * frame[0] + std::sin(angle) * frame[1]));
        }
    }
    return least_mm;
}

}  // namespace osteomill
