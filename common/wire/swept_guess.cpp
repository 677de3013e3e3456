#include "common/wire/swept_guess.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace osteomill {

namespace {

constexpr std::int64_t unit = GuessedSweep::units_per_voxel;
/// A grid has at most 65536 voxels along an axis, and a burr may be beside it.
constexpr std::int64_t farthest = 2 * 65536 * unit;

bool is_exact(const GuessedSweep& sweep) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (std::abs(sweep.from[axis]) > farthest || std::abs(sweep.to[axis]) > farthest ||
            std::abs(sweep.to[axis] - sweep.from[axis]) > GuessedSweep::longest_way_voxels * unit)
            return false;
    return sweep.radius > 0 && sweep.radius <= GuessedSweep::largest_radius_voxels * unit &&
           sweep.smoothing >= 0 && sweep.smoothing <= unit;
}

/// A sweep seen from a voxel nearby. All members are whole numbers below 2^26: their products, and sums of
/// three, are exact in double, whether or not the compiler fuses them.
struct SweepNearby {
    glm::dvec3 from;
    glm::dvec3 along;
    double length_squared;
    std::int64_t radius;
    std::int64_t smoothing;
};

/// How far from the ball's surface a voxel can be that is partly left: the ramp bends from half a voxel less
/// half the smoothing on, and ends here.
std::int64_t ramp_end(std::int64_t smoothing) {
    return (unit + smoothing) / 2;
}

/// Farther off than this, whatever roundings did: all or nothing is left.
std::int64_t rim(std::int64_t smoothing) {
    constexpr std::int64_t most_rounding = 4;
    return ramp_end(smoothing) + most_rounding;
}

/// 0 to 255, of a voxel at `position`.
std::int64_t fraction_left(const SweepNearby& sweep, const glm::dvec3& position) {
    const glm::dvec3 way = position - sweep.from;
    const double share = sweep.length_squared > 0.0
                             ? std::clamp(glm::dot(way, sweep.along) / sweep.length_squared, 0.0, 1.0)
                             : 0.0;
    const glm::dvec3 off = way - glm::dvec3(glm::i64vec3(share * sweep.along));
    const auto distance = static_cast<std::int64_t>(std::sqrt(glm::dot(off, off)));
    const std::int64_t beyond = distance - sweep.radius;
    const std::int64_t along_ramp = std::abs(beyond);
    if (along_ramp >= ramp_end(sweep.smoothing)) return beyond < 0 ? 0 : 255;  // the formula's ends
    const std::int64_t bent = along_ramp - (unit - sweep.smoothing) / 2;
    const std::int64_t rise = bent > 0 ? along_ramp - bent * bent / (2 * sweep.smoothing) : along_ramp;
    const std::int64_t left = beyond < 0 ? unit / 2 - rise : unit / 2 + rise;
    return (255 * left + unit / 2) / unit;
}

/// Whether a row of 16 voxels from `first` on lies so deep inside the ball round the sweep's beginning, or so
/// far off, that nothing of it changes.
bool stays(const SweepNearby& sweep, const glm::dvec3& first) {
    constexpr double length = (brick_edge_voxels - 1) * static_cast<double>(unit);
    const glm::dvec3 way = first - sweep.from;
    const double across = way.y * way.y + way.z * way.z;
    const double farthest_x = std::max(std::abs(way.x), std::abs(way.x + length));
    const double nearest_x = way.x > 0.0 ? way.x : way.x < -length ? way.x + length : 0.0;
    const auto radius = static_cast<double>(sweep.radius);
    const auto rim_here = static_cast<double>(rim(sweep.smoothing));
    const double inside = radius - rim_here;
    if (inside > 0.0 && farthest_x * farthest_x + across < inside * inside) return true;
    const double outside = radius + std::sqrt(sweep.length_squared) + rim_here;
    return nearest_x * nearest_x + across > outside * outside;
}

}  // namespace

std::optional<GuessedSweep> guessed_sweep(const glm::dvec3& from, const glm::dvec3& to, double radius,
                                          double smoothing) {
    const auto is_small = [](double value) {
        return std::abs(value) * static_cast<double>(unit) <= static_cast<double>(farthest);  // not for NaN
    };
    const auto in_units = [](double value) { return std::llround(value * static_cast<double>(unit)); };
    if (!is_small(radius) || !is_small(smoothing)) return std::nullopt;
    GuessedSweep sweep;
    for (int axis = 0; axis < 3; ++axis) {
        if (!is_small(from[axis]) || !is_small(to[axis])) return std::nullopt;
        sweep.from[static_cast<std::size_t>(axis)] = in_units(from[axis]);
        sweep.to[static_cast<std::size_t>(axis)] = in_units(to[axis]);
    }
    sweep.radius = in_units(radius);
    sweep.smoothing = in_units(smoothing);
    if (!is_exact(sweep)) return std::nullopt;
    return sweep;
}

v1::GuessedSweep to_message(const GuessedSweep& sweep) {
    v1::GuessedSweep message;
    for (const std::int64_t value : sweep.from) message.add_from(value);
    for (const std::int64_t value : sweep.to) message.add_to(value);
    message.set_radius(static_cast<std::uint64_t>(sweep.radius));
    message.set_smoothing(static_cast<std::uint32_t>(sweep.smoothing));
    return message;
}

std::variant<GuessedSweep, WireError> guessed_sweep_from(const v1::GuessedSweep& message) {
    constexpr auto most = static_cast<std::uint64_t>(GuessedSweep::largest_radius_voxels * unit);
    if (message.from_size() != 3 || message.to_size() != 3 || message.radius() > most)
        return WireError{"a guessed sweep lacks coordinates or is too thick"};
    if (message.smoothing() > unit) return WireError{"a guessed sweep is smoothed over more than a voxel"};
    GuessedSweep sweep;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::max(message.from(axis), message.to(axis)) > farthest ||
            std::min(message.from(axis), message.to(axis)) < -farthest)
            return WireError{"a guessed sweep lies beyond any grid"};
        sweep.from[static_cast<std::size_t>(axis)] = message.from(axis);
        sweep.to[static_cast<std::size_t>(axis)] = message.to(axis);
    }
    sweep.radius = static_cast<std::int64_t>(message.radius());
    sweep.smoothing = message.smoothing();
    if (!is_exact(sweep)) return WireError{"a guessed sweep is too long or has no radius"};
    return sweep;
}

BrickGuess guess_brick(const GuessedSweep& sweep, const glm::ivec3& brick) {
    BrickGuess guess;
    // Everything is counted from the brick's first voxel, so that numbers stay small.
    SweepNearby nearby{};
    const std::int64_t reach = sweep.radius + rim(sweep.smoothing);
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const std::int64_t first = std::int64_t{brick[axis]} * brick_edge_voxels * unit;
        const std::int64_t last = first + (brick_edge_voxels - 1) * unit;
        if (std::min(sweep.from[i], sweep.to[i]) - reach > last ||
            std::max(sweep.from[i], sweep.to[i]) + reach < first)
            return guess;
        nearby.from[axis] = static_cast<double>(sweep.from[i] - first);
        nearby.along[axis] = static_cast<double>(sweep.to[i] - sweep.from[i]);
    }
    nearby.length_squared = glm::dot(nearby.along, nearby.along);
    nearby.radius = sweep.radius;
    nearby.smoothing = sweep.smoothing;
    SweepNearby at_rest = nearby;
    at_rest.along = glm::dvec3(0.0);
    at_rest.length_squared = 0.0;

    for (std::size_t row = 0; row < brick_voxel_count; row += brick_edge_voxels) {
        const glm::dvec3 first = static_cast<double>(unit) * glm::dvec3(voxel_in_brick(row));
        if (stays(nearby, first)) continue;
        for (std::size_t x = 0; x < brick_edge_voxels; ++x) {
            const glm::dvec3 position =
                first + glm::dvec3(static_cast<double>(x) * static_cast<double>(unit), 0.0, 0.0);
            const std::int64_t left = fraction_left(nearby, position);
            if (left == 255 || left >= fraction_left(at_rest, position)) continue;
            guess.changed.set(row + x);
            guess.left[row + x] = static_cast<std::uint8_t>(left);
        }
    }
    return guess;
}

}  // namespace osteomill
