#include "haptic_server/milling/tip_edge.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace osteomill {

namespace {

constexpr auto disc = static_cast<double>(tip_disc_voxels);

/// Of the way, after which the sums have forgotten all but 1/e.
constexpr double memory_voxels = 3.0;

/// Of A. A burr that is hardly thicker than the disc has no tip.
constexpr double least_radius = 1.2;
/// Of the way, along the axis.
constexpr double least_advance = 1e-3;

/// Of the volume of a whole chip: where less or more is cut no face shows.
constexpr double least_share = 0.01;
constexpr double most_share = 0.99;
/// Farther from the axis the disc shows too little of a face.
constexpr double sure_distance_voxels = 2.5;
constexpr double largest_distance_voxels = 2.9;
/// Of the moment that a face through the axis would have: sums that are farther than that from those of the
/// face that fits best have a chip that ends otherwise.
constexpr double sure_rest = 0.25;
constexpr double largest_rest = 0.5;
constexpr double moment_of_half_disc = 0.17;  // 4/15 / (pi/2), in A times the volume of a whole chip
/// By how much the share of the tip in what is cut swings with the lattice; more is meant.
constexpr double largest_swing = 0.2;
/// Steeper ones are taken for that steep.
constexpr double largest_cot = 3.0;
constexpr double largest_per_sine = 3.0;

constexpr int newton_steps = 3;
constexpr double longest_step_voxels = 1.0;
constexpr double longest_turn_rad = 0.6;

double ramp(double from, double to, double at) {
    return std::clamp((at - from) / (to - from), 0.0, 1.0);
}

glm::dvec2 turned(const glm::dvec2& v, double angle_rad) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// Volume and moment as what the fit sees: of like size.
glm::dvec3 seen_by_fit(double volume, const glm::dvec2& moment) {
    return {0.5 * disc * volume, moment};
}
glm::dvec3 seen_by_fit(const glm::dvec3& sums) {
    return seen_by_fit(sums.x, {sums.y, sums.z});
}

}  // namespace

void TipEdge::begin_step(const glm::dmat3& frame, double radius_voxels,
                         const glm::dvec3& way_voxels) noexcept {
    search_ = {};
    step_all_ = 0.0;
    step_stiffness_ = 0.0;
    step_force_ = glm::dvec3(0.0);
    frame_ = frame;
    const double length = glm::length(way_voxels);
    const glm::dvec3 way = glm::transpose(frame) * way_voxels;
    if (radius_voxels < least_radius * disc || !(length > 0.0) || -way.z <= least_advance * length) {
        forget();
        return;
    }
    direction_ = way / length;
    disc_.begin(radius_voxels, direction_);
    const double kept = std::exp(-length / memory_voxels);
    way_sum_ = kept * way_sum_ + length;
    all_sum_ *= kept;
    volume_sum_ *= kept;
    stiffness_sum_ *= kept;
    moment_sum_ *= kept;
    force_sum_ *= kept;
    moved_sum_ *= kept;
    places_sum_ *= kept;

    search_.is_on = true;
    search_.per_level = glm::vec2(glm::transpose(frame) * per_level_);
    search_.per_depth = glm::vec2(glm::transpose(frame) * per_depth_);
}

void TipEdge::add(const TipSums& sums) noexcept {
    step_all_ += sums.all;
    step_stiffness_ += sums.stiffness;
    step_force_ += sums.force;
    all_sum_ += sums.all;
    volume_sum_ += sums.volume;
    stiffness_sum_ += sums.stiffness;
    moment_sum_ += frame_ * glm::dvec3(sums.moment, 0.0);
    force_sum_ += frame_ * sums.force;
    moved_sum_ += frame_ * sums.moved;
    places_sum_ += frame_ * sums.places;
}

/// By the sum of all places: N points away from it, and across the way.
double TipEdge::cot_theta() const noexcept {
    const glm::dvec3 places = glm::transpose(frame_) * places_sum_;
    const glm::dvec3 normal = glm::dot(places, direction_) * direction_ - places;
    const double across = std::hypot(normal.x, normal.y);
    return across > 0.0 ? std::clamp(normal.z / across, -largest_cot, largest_cot) : 0.0;
}

FaceAtTip TipEdge::face_that_shows(const Seen& seen, double share, const TipDiscSums& whole) const noexcept {
    const glm::dvec2 toward_face = share * whole.moment - seen.moment;
    const double length = glm::length(toward_face);
    FaceAtTip face{.outward = length > 0.0 ? toward_face / length : glm::dvec2(1.0, 0.0),
                   .distance_voxels = 1.2 * disc * (share - 0.5),
                   .cot_theta = cot_theta()};
    const glm::dvec3 target = seen_by_fit(seen.volume, seen.moment);
    const double damping = 1e-3 * whole.volume * whole.volume;
    for (int i = 0; i < newton_steps; ++i) {
        const TipDiscSums sums = disc_.cut_by(face);
        const glm::dvec3 rest = target - seen_by_fit(sums.volume, sums.moment);
        const glm::dvec3 by_distance = seen_by_fit(sums.per_distance);
        const glm::dvec3 by_turn = seen_by_fit(sums.per_turn);
        const double a = glm::dot(by_distance, by_distance) + damping;
        const double b = glm::dot(by_distance, by_turn);
        const double c = glm::dot(by_turn, by_turn) + damping;
        const double to_distance = glm::dot(by_distance, rest);
        const double to_turn = glm::dot(by_turn, rest);
        const double determinant = a * c - b * b;
        const double step = (c * to_distance - b * to_turn) / determinant;
        const double turn = (a * to_turn - b * to_distance) / determinant;
        face.distance_voxels = std::clamp(
            face.distance_voxels + std::clamp(step, -longest_step_voxels, longest_step_voxels), -disc, disc);
        face.outward = turned(face.outward, std::clamp(turn, -longest_turn_rad, longest_turn_rad));
    }
    return face;
}

TipEdge::Found TipEdge::find() const noexcept {
    const TipDiscSums whole = disc_.whole();
    const Seen seen{volume_sum_ / way_sum_, glm::dvec2(glm::transpose(frame_) * moment_sum_) / way_sum_};
    const double share = seen.volume / whole.volume;
    if (!(share > least_share && share < most_share)) return {};

    Found found{.face = face_that_shows(seen, share, whole)};
    const TipDiscSums sums = disc_.cut_by(found.face);
    found.missing = sums.missing - share * whole.missing;
    const double rest =
        glm::length(seen_by_fit(seen.volume, seen.moment) - seen_by_fit(sums.volume, sums.moment)) /
        (moment_of_half_disc * disc * whole.volume);
    found.trust =
        ramp(-largest_rest, -sure_rest, -rest) *
        ramp(-largest_distance_voxels, -sure_distance_voxels, -std::abs(found.face.distance_voxels));
    return found;
}

glm::dvec3 TipEdge::end_step() noexcept {
    per_level_ = per_depth_ = glm::dvec3(0.0);
    if (!(step_stiffness_ > 0.0)) return glm::dvec3(0.0);
    const Found found = find();
    const glm::dvec3 outward = found.trust * (frame_ * glm::dvec3(found.face.outward, 0.0));
    const double cot = found.face.cot_theta;
    const double exact_per_sine = std::hypot(1.0, cot);
    const double per_sine = std::min(exact_per_sine, largest_per_sine);
    per_level_ = per_sine * outward;
    per_depth_ = per_sine * cot / exact_per_sine * outward;
    return found.trust * way_sum_ * step_stiffness_ / volume_sum_ * found.missing;
}

glm::dvec3 TipEdge::evened() const noexcept {
    if (!(step_stiffness_ > 0.0)) return glm::dvec3(0.0);
    const glm::dvec3 lately = glm::transpose(frame_) * (force_sum_ + moved_sum_);
    const double of_tip = step_stiffness_ / stiffness_sum_;
    const double of_all =
        std::clamp(step_all_ / all_sum_, (1.0 - largest_swing) * of_tip, (1.0 + largest_swing) * of_tip);
    return of_all * lately - step_force_;
}

void TipEdge::forget() noexcept {
    way_sum_ = all_sum_ = volume_sum_ = stiffness_sum_ = 0.0;
    moment_sum_ = force_sum_ = moved_sum_ = places_sum_ = per_level_ = per_depth_ = glm::dvec3(0.0);
}

}  // namespace osteomill
