#include "haptic_server/milling/tip_edge.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "haptic_server/milling/axis_means.h"

namespace osteomill {

namespace {

constexpr double disc = static_cast<double>(tip_disc_voxels);

/// Of the way, after which the sums have forgotten all but 1/e.
constexpr double memory_voxels = 2.0;

/// A chip's thickness is taken to be at least that share of the tip's.
constexpr double least_chip = 0.1;
/// Where the disc reaches so far up the burr that its chip is thinner than a fifth of the tip's, the edge is
/// trusted less; not at all where the burr does not cut on all of the disc.
constexpr double sure_chip = 0.2;
/// Farther from the axis the disc shows too little of the edge.
constexpr double sure_distance_voxels = 2.5;
constexpr double largest_distance_voxels = 2.9;
/// Of the moment that a straight edge would have: less has a chip that ends on more sides than one.
constexpr double sure_moment = 0.8;
constexpr double least_moment = 0.5;

double ramp(double from, double to, double at) {
    return std::clamp((at - from) / (to - from), 0.0, 1.0);
}

/// d / A of the edge that leaves `share` of the disc.
double relative_distance(double share) {
    const double larger = std::clamp(std::max(share, 1.0 - share), 0.5, 1.0);
    const double v = 1.0 - std::pow(2.0 - 2.0 * larger, 0.4);
    const double distance = v * (1.4527 - v * (0.8582 - v * (0.6053 - 0.2006 * v)));
    return share < 0.5 ? -distance : distance;
}

/// Of what the means miss, for a chip of 1.
double missing_of_half_plane(double distance_voxels) {
    constexpr double a = static_cast<double>(axis_disc_voxels);
    const double s = std::abs(distance_voxels) / a;
    if (s >= 1.0) return 0.0;
    const double squared = (1.0 - s) * (1.0 - s);
    return a * squared * squared * (-0.427 + s * (1.434 + s * 3.162));
}

/// How much of the tip's chip there is at least on the disc. `direction` of the way, burr axes.
double thinnest_chip(const glm::dvec3& direction, double radius_voxels) {
    return 1.0 - disc * std::hypot(direction.x, direction.y) / (radius_voxels * -direction.z);
}

}  // namespace

void TipEdge::begin_step(const glm::dmat3& frame, double radius_voxels,
                         const glm::dvec3& way_voxels) noexcept {
    search_ = {};
    step_area_ = 0.0;
    frame_ = frame;
    radius_voxels_ = radius_voxels;
    way_ = glm::transpose(frame) * way_voxels;
    const double length = glm::length(way_);
    const bool tip_advances = length > 0.0 && -way_.z > 1e-3 * length;
    if (!tip_advances || thinnest_chip(way_, radius_voxels) <= 0.0) {
        forget();
        return;
    }
    const double kept = std::exp(-length / memory_voxels);
    way_sum_ *= kept;
    area_sum_ *= kept;
    stiffness_sum_ *= kept;
    moment_sum_ *= kept;
    moved_sum_ *= kept;

    const Edge before = edge();
    search_.is_on = true;
    search_.direction = glm::vec3(way_ / length);
    search_.least_share = static_cast<float>(least_chip * -way_.z / length);
    search_.per_level = glm::vec2(before.trust * before.shift_per_level * before.outward);
    way_sum_ += length;
}

void TipEdge::add(const TipSums& sums) noexcept {
    step_area_ += sums.area;
    area_sum_ += sums.area;
    stiffness_sum_ += sums.stiffness;
    moment_sum_ += frame_ * glm::dvec3(sums.moment, 0.0);
    moved_sum_ += frame_ * sums.moved;
}

TipEdge::Edge TipEdge::edge() const noexcept {
    const double all = 0.5 * std::numbers::pi * disc * disc * way_sum_;
    const glm::dvec2 moment(glm::transpose(frame_) * moment_sum_);
    const double moment_length = glm::length(moment);
    if (!(all > 0.0) || !(moment_length > 0.0)) return {};

    Edge edge{.outward = -moment / moment_length};
    const double relative = relative_distance(area_sum_ / all);
    const double rest = 1.0 - relative * relative;
    const double straight_moment = 4.0 / 15.0 * disc * disc * disc * rest * rest * std::sqrt(rest) * way_sum_;

    const double advance = -way_.z;
    const double along = glm::dot(edge.outward, glm::dvec2(way_));
    const double cot_theta = along / advance;
    edge.shift_per_level = std::min((std::hypot(advance, along) - along) / advance, 1.0);
    edge.distance_voxels =
        disc * relative + disc * disc * rest * std::clamp(cot_theta, -2.0, 2.0) / (10.0 * radius_voxels_);
    edge.trust = ramp(0.0, sure_chip, thinnest_chip(way_, radius_voxels_)) *
                 ramp(-largest_distance_voxels, -sure_distance_voxels, -std::abs(edge.distance_voxels)) *
                 ramp(least_moment * straight_moment, sure_moment * straight_moment, moment_length);
    return edge;
}

glm::dvec2 TipEdge::missing() const noexcept {
    if (!(step_area_ > 0.0)) return glm::dvec2(0.0);
    const Edge found = edge();
    const double share = step_area_ / area_sum_;
    const double chip = -way_.z / glm::length(way_) * way_sum_ * stiffness_sum_ / area_sum_;
    return found.trust * share * chip * missing_of_half_plane(found.distance_voxels) * found.outward;
}

glm::dvec3 TipEdge::moved() const noexcept {
    if (!(step_area_ > 0.0)) return glm::dvec3(0.0);
    return step_area_ / area_sum_ * (glm::transpose(frame_) * moved_sum_);
}

void TipEdge::forget() noexcept {
    way_sum_ = area_sum_ = stiffness_sum_ = 0.0;
    moment_sum_ = moved_sum_ = glm::dvec3(0.0);
}

}  // namespace osteomill
