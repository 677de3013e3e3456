#include "analysis/report/plunge_watch.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace osteomill {

namespace {

constexpr double look_ahead_mm = 3.0;
constexpr double free_behind_mm = 1.0;
constexpr double finest_step_mm = 0.005;
constexpr double longest_unseen_s = 0.25;
constexpr std::uint8_t least_bone = 128;  // half a voxel

glm::dvec3 tip_mm(const ToolMoment& moment) {
    return moment.burr_mm - moment.radius_mm * moment.spindle_axis;
}

/// Anywhere, also far off.
bool is_bone_at(const Bone& bone, const glm::dvec3& place_mm) {
    const glm::dvec3 place = to_voxel_coordinates(bone.grid(), place_mm);
    const glm::dvec3 size(bone.grid().size_voxels);
    if (!glm::all(glm::greaterThanEqual(place, glm::dvec3(-0.5))) ||
        !glm::all(glm::lessThan(place, size - 0.5)))
        return false;
    return bone.fraction_at(glm::ivec3(glm::floor(place + 0.5))) >= least_bone;
}

}  // namespace

std::optional<PlungeWatch::FarWall> PlungeWatch::far_wall(const Bone& bone, const ToolMoment& from) {
    const glm::dvec3 inwards = -from.spindle_axis;
    const double step_mm = std::max(0.25 * bone.grid().spacing_mm, finest_step_mm);
    std::optional<double> bone_ends_mm;
    for (double ahead_mm = 0.0; ahead_mm <= look_ahead_mm + free_behind_mm; ahead_mm += step_mm) {
        const bool is_bone = is_bone_at(bone, tip_mm(from) + ahead_mm * inwards);
        if (is_bone) bone_ends_mm = ahead_mm + 0.5 * step_mm;
        if (bone_ends_mm && ahead_mm >= *bone_ends_mm + free_behind_mm)
            return FarWall{tip_mm(from) + *bone_ends_mm * inwards, inwards, from.time_s};
    }
    return std::nullopt;
}

void PlungeWatch::follow(const ToolMoment& from, const ToolMoment& to, bool cuts) {
    const auto beyond_mm = [](const FarWall& wall, const ToolMoment& at) {
        return glm::dot(tip_mm(at) - wall.place_mm, wall.inwards);
    };
    if (behind_) {
        // The window may end between two moments.
        const double ends_s = breakthroughs_.back().time_s + plunge_window_s;
        const double part = to.time_s <= ends_s || !(to.time_s > from.time_s)
                                ? 1.0
                                : (ends_s - from.time_s) / (to.time_s - from.time_s);
        double& plunge_mm = breakthroughs_.back().plunge_mm;
        plunge_mm = std::max(plunge_mm, glm::mix(beyond_mm(*behind_, from), beyond_mm(*behind_, to),
                                                 std::clamp(part, 0.0, 1.0)));
        if (to.time_s >= ends_s) behind_.reset();
    }
    if (!ahead_ || !cuts || !to.spindle_on || to.time_s > ahead_->seen_s + longest_unseen_s) return;
    const double from_mm = beyond_mm(*ahead_, from);
    const double to_mm = beyond_mm(*ahead_, to);
    if (from_mm >= 0.0 || to_mm < 0.0) return;
    const double part = -from_mm / (to_mm - from_mm);
    const glm::dvec3 through_mm = glm::mix(tip_mm(from), tip_mm(to), part);
    if (glm::distance(through_mm, ahead_->place_mm) > to.radius_mm) return;
    const double time_s = glm::mix(from.time_s, to.time_s, part);
    behind_ = ahead_;
    ahead_.reset();
    breakthroughs_.push_back({.time_s = time_s});
    ToolMoment through = to;
    through.time_s = time_s;
    through.burr_mm = through_mm + to.radius_mm * to.spindle_axis;
    follow(through, to, false);
}

bool PlungeWatch::is_about_to_pass(const FarWall& next, double voxel_mm) const {
    if (!ahead_ || last_->time_s > ahead_->seen_s + longest_unseen_s) return false;
    const double left_mm = glm::dot(ahead_->place_mm - tip_mm(*last_), ahead_->inwards);
    return left_mm > 0.0 && left_mm < voxel_mm &&
           glm::dot(next.place_mm - ahead_->place_mm, ahead_->inwards) > voxel_mm;
}

void PlungeWatch::update(const Bone& bone, std::span<const ToolMoment> moments, bool cuts) {
    for (const ToolMoment& moment : moments) {
        if (last_) follow(*last_, moment, cuts);
        last_ = moment;
    }
    if (!last_ || !last_->spindle_on) return;
    const auto wall = far_wall(bone, *last_);
    if (wall && !is_about_to_pass(*wall, bone.grid().spacing_mm)) ahead_ = wall;
}

void PlungeWatch::forget() {
    last_.reset();
    ahead_.reset();
    behind_.reset();
}

PlungeMetrics plunge_metrics(std::span<const Breakthrough> breakthroughs) {
    PlungeMetrics metrics{.breakthroughs = breakthroughs.size()};
    if (breakthroughs.empty()) return metrics;
    double sum_mm = 0.0;
    for (const Breakthrough& one : breakthroughs) sum_mm += one.plunge_mm;
    metrics.mean_mm = sum_mm / static_cast<double>(breakthroughs.size());
    metrics.most_mm = std::ranges::max(breakthroughs, {}, &Breakthrough::plunge_mm).plunge_mm;
    return metrics;
}

}  // namespace osteomill
