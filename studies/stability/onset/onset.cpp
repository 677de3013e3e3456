#include "studies/stability/onset/onset.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <stdexcept>

#include "simulation/force_models/milling_model.h"
#include "studies/force/bone_block.h"

namespace osteomill::study {
namespace {

constexpr double voxel_mm = 0.1;
/// A burr on a soft spring is pushed aside by some tenths of a millimetre.
constexpr double margin_mm = 2.0;

}  // namespace

OnsetLine line_of(const Onset& onset) {
    const double radius_mm = onset.burr.radius_mm();
    if (onset.kind == OnsetKind::plunge)
        return {(radius_mm + onset.before_touch_mm) * onset.up, -onset.up, onset.up};
    const double height_mm = radius_mm - onset.depth_mm;
    const double touch_mm =
        height_mm > 0.0 ? -std::sqrt(radius_mm * radius_mm - height_mm * height_mm) : -radius_mm;
    return {{touch_mm - onset.before_touch_mm, 0.0, height_mm}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
}

Bone bone_of(const Onset& onset) {
    const double radius_mm = onset.burr.radius_mm();
    const double way_mm = onset.way_mm + ImpulseByWay::beyond_mm;
    if (onset.kind == OnsetKind::plunge) {
        const double half_mm = radius_mm + way_mm + margin_mm;
        return voxelised({.low_mm = glm::dvec3(-half_mm), .high_mm = glm::dvec3(half_mm), .up = onset.up},
                         voxel_mm);
    }
    const double half_mm = radius_mm + margin_mm;
    return voxelised({.low_mm = {0.0, -half_mm, -half_mm}, .high_mm = {way_mm + half_mm, half_mm, half_mm}},
                     voxel_mm);
}

ImpulseByWay::ImpulseByWay(const Onset& onset) : direction_(line_of(onset).direction) {
    if (!onset.burr.is_ball() || onset.burr.has_edge_force())
        throw std::invalid_argument("an onset is a ball's whose edges do not rub");
    const OnsetLine line = line_of(onset);
    MillingModel model(bone_of(onset), {onset.burr}, {});
    ForgottenChanges changes;
    const auto result = std::make_unique<MillingResult>();
    constexpr double step_s = 0.001;  // of no account: an impulse is asked for
    const auto mill_to = [&](double way_mm, bool spindle_on) {
        model.step({.pose = {line.at(way_mm), line.spindle_axis},
                    .spindle_on = spindle_on,
                    .elapsed_s = step_s,
                    .wants_engagement = false},
                   0.0, changes, *result);
    };
    mill_to(0.0, false);
    mill_to(0.0, true);
    const double end_mm = onset.before_touch_mm + onset.way_mm + beyond_mm;
    const auto steps = static_cast<std::size_t>(std::ceil(end_mm / step_mm));
    impulses_n_s_.assign(1, glm::dvec3(0.0));
    for (std::size_t i = 1; i <= steps; ++i) {
        mill_to(static_cast<double>(i) * step_mm, true);
        impulses_n_s_.push_back(impulses_n_s_.back() + step_s * result->force_n);
    }
}

glm::dvec3 ImpulseByWay::at(double way_mm) const {
    const double steps = std::max(way_mm, 0.0) / step_mm;
    const std::size_t below = std::min(static_cast<std::size_t>(steps), impulses_n_s_.size() - 2);
    const double share = steps - static_cast<double>(below);
    return impulses_n_s_[below] + share * (impulses_n_s_[below + 1] - impulses_n_s_[below]);
}

double ImpulseByWay::along(double way_mm) const {
    return glm::dot(at(way_mm), direction_);
}

}  // namespace osteomill::study
