#include "studies/stability/sites/site.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <utility>

#include "common/bone/bone_builder.h"

namespace osteomill::study {

namespace {

constexpr double stiffness_step = 0.01;

std::uint8_t level(double value, double highest) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, highest)));
}

}  // namespace

Bone site_bone(const SiteShape& shape) {
    const glm::dvec3 first = glm::floor(shape.low_mm / site_voxel_mm);
    const glm::dvec3 last = glm::ceil(shape.high_mm / site_voxel_mm);
    const Grid grid{.size_voxels = glm::ivec3(last - first),
                    .spacing_mm = site_voxel_mm,
                    .origin_mm = (first + 0.5) * site_voxel_mm};
    const bool is_heterogeneous = static_cast<bool>(shape.relative_stiffness);
    BoneBuilder builder = is_heterogeneous ? BoneBuilder::heterogeneous(grid, stiffness_step, false)
                                           : BoneBuilder::homogeneous(grid, 1.0, false);
    return filled(std::move(builder), grid, [&](const glm::ivec3& voxel) {
        const glm::dvec3 at_mm = grid.origin_mm + site_voxel_mm * glm::dvec3(voxel);
        VoxelValues values{.fraction =
                               level(255.0 * (0.5 - shape.distance_mm(at_mm) / site_voxel_mm), 255.0)};
        if (is_heterogeneous)
            values.stiffness = level(shape.relative_stiffness(at_mm) / stiffness_step, 255.0);
        return values;
    });
}

namespace {

constexpr double waypoint_s = 0.005;
constexpr double longest_way_mm = 6.0;

/// Distributions of the standard library differ between its makers; the generator does not.
class Draw {
  public:
    Draw(std::uint64_t seed, int number) : bits_(seed * 1'000'003 + static_cast<std::uint64_t>(number)) {}
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
    }
    double by_ratio(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
    int up_to(int count) { return static_cast<int>(between(0.0, count)); }

  private:
    std::mt19937_64 bits_;
};

struct Sine {
    glm::dvec3 amplitude;
    double rad_per_s;
    double phase_rad;
};

/// Slower sines reach farther, as a hand does.
std::array<Sine, 8> sines(Draw& draw) {
    std::array<Sine, 8> found{};
    for (Sine& sine : found) {
        const double hz = draw.by_ratio(0.2, walk_band_hz);
        const auto any = [&] { return draw.between(-1.0, 1.0); };
        sine = {glm::dvec3(any(), any(), 0.5 * any()) / hz, 2.0 * std::numbers::pi * hz,
                draw.between(0.0, 2.0 * std::numbers::pi)};
    }
    return found;
}

/// The walk about the origin, a point every waypoint_s, within the speed and a reach.
std::vector<glm::dvec3> walk(Draw& draw) {
    const auto parts = sines(draw);
    std::vector<glm::dvec3> points;
    double fastest = 0.0;
    double farthest = 0.0;
    for (double time_s = 0.0; time_s <= walk_s; time_s += waypoint_s) {
        glm::dvec3 point(0.0);
        for (const Sine& sine : parts)
            point += sine.amplitude * std::sin(sine.rad_per_s * time_s + sine.phase_rad);
        if (!points.empty()) fastest = std::max(fastest, glm::distance(point, points.back()) / waypoint_s);
        farthest = std::max(farthest, std::max(std::abs(point.x), std::abs(point.y)));
        points.push_back(point);
    }
    const double scale =
        std::min(draw.by_ratio(20.0, fastest_walk_mm_per_s) / fastest, longest_way_mm / farthest);
    for (glm::dvec3& point : points) point *= scale;
    return points;
}

std::pair<std::string, std::function<double(const glm::dvec3&)>> some_bone(Draw& draw) {
    switch (draw.up_to(4)) {
        case 0:
            return {"a block", [](const glm::dvec3& p) { return p.z; }};
        case 1:
            return {"a corner", [](const glm::dvec3& p) { return std::max({p.x, p.y, p.z}); }};
        case 2: {
            const double thickness_mm = draw.between(0.3, 3.0);
            return {fmt::format("a plate of {:.1f} mm", thickness_mm),
                    [=](const glm::dvec3& p) { return std::max(p.z, -thickness_mm - p.z); }};
        }
        default: {
            const double half_mm = draw.between(0.2, 1.5);
            return {fmt::format("a ridge of {:.1f} mm", 2.0 * half_mm),
                    [=](const glm::dvec3& p) { return std::max(p.z, std::abs(p.y) - half_mm); }};
        }
    }
}

}  // namespace

Site random_walk(std::uint64_t seed, int number) {
    Draw draw(seed, number);
    Burr burr{.diameter_mm = draw.between(1.0, 5.0),
              .spindle_rev_per_s = draw.by_ratio(5'000.0, 80'000.0) / 60.0};
    burr.name = "walk";
    auto [where, distance_mm] = some_bone(draw);
    std::vector<glm::dvec3> points = walk(draw);

    // The lowest point of the walk takes the burr's tip so deep.
    const double deepest_mm = draw.between(0.1, std::min(1.5, 0.6 * burr.diameter_mm));
    double lowest_mm = points.front().z;
    for (const glm::dvec3& point : points) lowest_mm = std::min(lowest_mm, point.z);
    const double up_mm = burr.radius_mm() - deepest_mm - lowest_mm;

    // From above, so that no walk begins in bone.
    const glm::dvec3 up(0.0, 0.0, 1.0);
    const double clear_mm = burr.radius_mm() + 1.0;
    std::vector<Waypoint> motion;
    const double begins_s = 1.0;
    const glm::dvec3 first = points.front() + up_mm * up;
    const glm::dvec3 above(first.x, first.y, std::max(first.z, clear_mm));
    motion.push_back({.time_s = 0.0, .pose = {above, up}, .pedal = true});
    motion.push_back({.time_s = 0.2, .pose = {above, up}, .pedal = true});
    for (std::size_t i = 0; i < points.size(); ++i)
        motion.push_back({.time_s = begins_s + waypoint_s * static_cast<double>(i),
                          .pose = {points[i] + up_mm * up, up},
                          .pedal = true});

    const double beside_mm = longest_way_mm + burr.radius_mm() + 1.0;
    return {.kind = "random walk",
            .name = fmt::format("walk {} of seed {}, over {}", number, seed, where),
            .burr = burr,
            .shape = {.distance_mm = std::move(distance_mm),
                      .low_mm = {-beside_mm, -beside_mm, -5.0},
                      .high_mm = {beside_mm, beside_mm, 2.0}},
            .motion = std::move(motion)};
}

}  // namespace osteomill::study
