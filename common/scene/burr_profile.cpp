#include "common/scene/burr_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace osteomill {

namespace {

constexpr double rounding_per_diameter = 0.1;
constexpr int barrel_chords = 8;
constexpr int pear_chords = 12;

}  // namespace

BurrProfile::BurrProfile(const BurrHead& head, double diameter_mm, double scale)
    : rounding_(rounding_per_diameter * diameter_mm * scale), largest_radius_(0.5 * diameter_mm * scale) {
    require_valid(head, diameter_mm);
    const double radius = largest_radius_;
    const double inner_radius = radius - rounding_;
    const double bottom = -inner_radius;
    const double top = head.length_mm * scale - radius - rounding_;
    const double tip_radius = 0.5 * head.tip_diameter_mm * scale - rounding_;
    const double neck_radius = 0.5 * head.neck_diameter_mm * scale - rounding_;
    switch (head.shape) {
        case HeadShape::ball:
            rounding_ = radius;
            chain_ = {{0.0, 0.0}};
            break;
        case HeadShape::cylinder:
        case HeadShape::cone:
            chain_ = {{tip_radius, bottom}, {neck_radius, top}};
            break;
        case HeadShape::barrel:
            // A parabola from the middle to each end.
            for (int i = 0; i <= barrel_chords; ++i) {
                const double from_middle = 2.0 * i / barrel_chords - 1.0;
                const double end_radius = from_middle < 0.0 ? tip_radius : neck_radius;
                chain_.push_back({inner_radius - (inner_radius - end_radius) * from_middle * from_middle,
                                  bottom + (top - bottom) * i / barrel_chords});
            }
            break;
        case HeadShape::pear:
            for (int i = 0; i <= pear_chords; ++i) {
                const double kappa = 0.5 * std::numbers::pi * i / pear_chords;
                chain_.push_back({i == 0 ? 0.0 : inner_radius * std::sin(kappa),
                                  i == pear_chords ? 0.0 : -inner_radius * std::cos(kappa)});
            }
            chain_.push_back({neck_radius, top});
            break;
    }
    build_outline();
}

void BurrProfile::build_outline() {
    std::vector<Corner> corners;
    if (chain_.front().radius > 0.0) corners.push_back({0.0, chain_.front().height});
    corners.insert(corners.end(), chain_.begin(), chain_.end());
    if (chain_.back().radius > 0.0) corners.push_back({0.0, chain_.back().height});

    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
        const double out = corners[i + 1].radius - corners[i].radius;
        const double up = corners[i + 1].height - corners[i].height;
        const double length = std::hypot(out, up);
        sides_.push_back({corners[i], length, out / length, up / length, up / length, -out / length});
    }
    // Angles of normals from straight down: 0 at the tip, pi at the other end.
    const auto angle_of = [](const Side& side) { return std::atan2(side.out, -side.up); };
    double angle = 0.0;
    const auto add = [&](double length, std::size_t index, bool is_arc) {
        if (length > 0.0) outline_.push_back({outline_length_, length, index, is_arc, angle});
        outline_length_ += length;
    };
    for (std::size_t i = 0; i <= sides_.size(); ++i) {
        const double next_angle = i < sides_.size() ? angle_of(sides_[i]) : std::numbers::pi;
        add(rounding_ * (next_angle - angle), i, true);
        angle = next_angle;
        if (i < sides_.size()) add(sides_[i].length, i, false);
    }
    chain_ = std::move(corners);
}

NearestSurface BurrProfile::nearest(double radius, double height) const noexcept {
    // Inside the chain the nearest side counts, outside it the nearest point of the sides that face the
    // place.
    double deepest = -std::numeric_limits<double>::infinity();
    const Side* deepest_side = nullptr;
    double least_squared = std::numeric_limits<double>::infinity();
    double least_out = 0.0;
    double least_up = 0.0;
    for (const Side& side : sides_) {
        const double out = radius - side.from.radius;
        const double up = height - side.from.height;
        const double beyond = out * side.out + up * side.up;
        if (beyond > deepest) {
            deepest = beyond;
            deepest_side = &side;
        }
        if (beyond <= 0.0) continue;
        const double along = out * side.along_out + up * side.along_up;
        const double clamped = std::clamp(along, 0.0, side.length);
        const double to_out = out - clamped * side.along_out;
        const double to_up = up - clamped * side.along_up;
        const double squared = to_out * to_out + to_up * to_up;
        if (squared < least_squared) {
            least_squared = squared;
            least_out = to_out;
            least_up = to_up;
        }
    }
    if (sides_.empty()) {
        least_out = radius - chain_.front().radius;
        least_up = height - chain_.front().height;
        least_squared = least_out * least_out + least_up * least_up;
    } else if (deepest <= 0.0) {
        return {deepest - rounding_, deepest_side->out, deepest_side->up};
    }
    const double distance = std::sqrt(least_squared);
    if (distance < 1e-12) return {-rounding_, 0.0, -1.0};
    return {distance - rounding_, least_out / distance, least_up / distance};
}

double BurrProfile::bounding_radius() const {
    const double middle = 0.5 * (tip_height() + top_height());
    double farthest = 0.0;
    for (const Corner& corner : chain_)
        farthest = std::max(farthest, std::hypot(corner.radius, corner.height - middle));
    return farthest + rounding_;
}

double BurrProfile::reach_along(const glm::dvec3& direction) const noexcept {
    const double across = std::hypot(direction.x, direction.y);
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Corner& corner : chain_)
        farthest = std::max(farthest, corner.radius * across + corner.height * direction.z);
    return farthest + rounding_;
}

OutlinePoint BurrProfile::outline_at(double along) const noexcept {
    std::size_t i = 0;
    while (i + 1 < outline_.size() && along > outline_[i].from + outline_[i].length) ++i;
    const Stretch& stretch = outline_[i];
    const double into = std::clamp(along - stretch.from, 0.0, stretch.length);
    if (stretch.is_arc) {
        const double angle = stretch.first_angle + into / rounding_;
        const Corner& corner = chain_[stretch.index];
        const double out = std::sin(angle);
        const double up = -std::cos(angle);
        return {corner.radius + rounding_ * out, corner.height + rounding_ * up, out, up};
    }
    const Side& side = sides_[stretch.index];
    return {side.from.radius + into * side.along_out + rounding_ * side.out,
            side.from.height + into * side.along_up + rounding_ * side.up, side.out, side.up};
}

}  // namespace osteomill
