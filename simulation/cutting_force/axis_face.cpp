#include "simulation/cutting_force/axis_face.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "simulation/cutting_force/axis_singularity_kernel.h"

namespace osteomill {

namespace {

constexpr double disc = static_cast<double>(axis_disc_voxels);
/// Radius of the disc that weighs the voxels before the tip, wide enough to hold many.
constexpr double look_voxels = 2.5;
/// By how much the larger balls are larger.
constexpr std::array<double, 4> larger_voxels{0.03125, 0.25, 0.5, 1.0};
/// In a shallow cut the line moves by more than this from the second of these balls to the third, and it is
/// followed back from them, the more, up to twice as much; else from the third and the fourth, which tell the
/// lattice less.
constexpr double shallow_voxels = 0.15;
/// So far from the axis the first ball alone tells where the line is: it scatters by a fifth of a voxel,
/// which matters near the axis, but a line that bends is not followed astray.
constexpr double far_voxels = 0.5;

/// The disc's weight of the mean kernel, seen along a line at x: that of (1 - t)^m is in proportion to s^(2 m
/// + 1), s^2 = 1 - (x / a)^2.
double kernel_along(double x) {
    const double s_squared = std::max(0.0, 1.0 - x * x / (disc * disc));
    const double s5 = std::pow(s_squared, 2.5);
    return 0.6 / (std::numbers::pi * disc) * (32.0 * 32.0 / 35.0 * s5 * s_squared - 19.0 * 16.0 / 15.0 * s5);
}

/// The weight of the look's disc along one axis: (1 - t)^2, integrated across.
double look_along(double x) {
    const double s_squared = std::max(0.0, 1.0 - x * x / (look_voxels * look_voxels));
    return 3.0 * 16.0 / 15.0 / (std::numbers::pi * look_voxels) * std::pow(s_squared, 2.5);
}

double look_weight(double r_squared) {
    const double rest = 1.0 - r_squared / (look_voxels * look_voxels);
    return rest * rest;
}

/// Linear; `at` is a share of the table's length.
template <typename Table>
double between(const Table& table, double at) {
    const double cell = std::clamp(at, 0.0, 1.0) * static_cast<double>(table.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(cell), table.size() - 2);
    return glm::mix(table[below], table[below + 1], cell - static_cast<double>(below));
}

double share_of_reach(double distance_voxels) {
    return 0.5 + 0.5 * distance_voxels / look_voxels;
}

/// The bone that a larger ball would remove, weighed by the look's disc.
struct Larger {
    double all = 0.0;  ///< if bone were all about
    double there = 0.0;
    double missing = 0.0;
    glm::dvec2 centre_there{0.0};  ///< times the weight; and likewise
    glm::dvec2 centre_missing{0.0};

    void add(double whole, double found, bool is_ahead, const glm::dvec2& aside) {
        all += whole;
        if (!is_ahead) return;  // behind the motion nothing is cut, and nothing is missing
        there += found;
        centre_there += found * aside;
        missing += whole - found;
        centre_missing += (whole - found) * aside;
    }
    double share() const { return 1.0 - missing / all; }
    /// Even where the lattice has more voxels on one side.
    glm::dvec2 aside() const { return (share() * centre_missing - (1.0 - share()) * centre_there) / all; }
};

}  // namespace

AxisFace::AxisFace() {
    constexpr int fine = 20;
    constexpr double dx = 2.0 * look_voxels / (cells * fine);
    double share = 0.0;
    double kernel_share = 0.0;
    double constant = 0.0;
    double slope = 0.0;
    double aside = 0.0;
    std::size_t known = 0;
    for (int i = 0; i <= cells * fine; ++i) {
        const double edge = -look_voxels + i * dx;
        if (i % fine == 0) {
            const auto cell = static_cast<std::size_t>(i / fine);
            constant_[cell] = constant;
            slope_[cell] = slope;
            aside_[cell] = aside;
        }
        while (known <= cells && (share >= static_cast<double>(known) / cells || i == cells * fine))
            distance_[known++] = edge;
        const double x = edge + 0.5 * dx;
        const double kernel = kernel_along(x) * dx;
        const double b =
            std::numbers::pi * (std::copysign(1.0, x) - (2.0 * (kernel_share + 0.5 * kernel) - 1.0));
        kernel_share += kernel;
        share += look_along(x) * dx;
        constant += b * dx;
        slope += x * b * dx;
        aside -= x * look_along(x) * dx;
    }
    // A slope of the thickness is the kernel's affair as long as no line is near.
    for (std::size_t cell = 0; cell <= cells; ++cell)
        slope_[cell] -= slope_[cells] * static_cast<double>(cell) / cells;
}

FaceEnd AxisFace::look(const Bone& bone, const Sweep& ball, const glm::dmat3& frame,
                       VoxelCoverage coverage) const noexcept {
    const glm::dvec3 path = ball.to - ball.from;
    if (glm::dot(path, frame[2]) >= 0.0 || ball.radius < smallest_radius_voxels ||
        coverage == VoxelCoverage::binary)
        return {};
    constexpr double rim = detail::smoothed_ramp_half;
    constexpr double outermost = rim + larger_voxels.back();
    const glm::dvec3 tip = ball.from - ball.radius * frame[2];
    const double sag = ball.radius - std::sqrt(ball.radius * ball.radius - look_voxels * look_voxels);
    const double reach = std::hypot(look_voxels, std::max(sag + rim, outermost));
    const double inner = ball.radius - rim;
    const double outer = ball.radius + outermost;
    std::array<Larger, larger_voxels.size()> larger;
    double stiffness = 0.0;
    double most = 0.0;
    glm::ivec3 at_most(0);
    for (int z = static_cast<int>(std::ceil(tip.z - reach)); z <= tip.z + reach; ++z)
        for (int y = static_cast<int>(std::ceil(tip.y - reach)); y <= tip.y + reach; ++y) {
            const Interval row = line_through_ball(tip, reach, y, z);
            for (int x = static_cast<int>(std::ceil(row.first)); x <= row.last; ++x) {
                const glm::ivec3 voxel(x, y, z);
                const glm::dvec3 from_centre = glm::dvec3(voxel) - ball.from;
                const double squared = glm::dot(from_centre, from_centre);
                if (squared <= inner * inner || squared >= outer * outer) continue;
                const glm::dvec2 aside(glm::dot(frame[0], from_centre), glm::dot(frame[1], from_centre));
                const double r_squared = glm::dot(aside, aside);
                if (r_squared >= look_voxels * look_voxels) continue;
                const double beyond = std::sqrt(squared) - ball.radius;
                const int left = level_left_at(coverage, beyond);
                const int now = std::min(left, static_cast<int>(bone.fraction_at(voxel)));
                const bool is_ahead = glm::dot(from_centre, path) > 0.0;
                const double weight = look_weight(r_squared);
                double found = 0.0;
                for (std::size_t i = 0; i < larger.size(); ++i) {
                    const int then = level_left_at(coverage, beyond - larger_voxels[i]);
                    found = weight * std::max(0, now - then);
                    larger[i].add(weight * (left - then), found, is_ahead, aside);
                }
                if (found > 0.0) stiffness += found * bone.stiffness_at(voxel);
                if (found > most) at_most = voxel;
                most = std::max(most, found);
            }
        }
    if (larger[2].there <= 0.0 || larger[2].missing <= 0.0) return {};
    const glm::dvec2 aside = larger[2].aside();
    const double length = glm::length(aside);
    if (length <= 0.0) return {};
    const auto distance = [&](std::size_t i) { return between(distance_, larger[i].share()); };
    // Bone that is thin all about has no line: what it lacks lies on no side.
    const double expected = between(aside_, share_of_reach(distance(2)));
    const double certainty = std::min(1.0, length / std::max(expected, 1e-6));
    const double shallow = std::clamp((distance(2) - distance(1)) / shallow_voxels - 1.0, 0.0, 1.0);
    const double followed =
        glm::mix(2.0 * distance(2) - distance(3), 2.0 * distance(1) - distance(2), shallow);
    return {
        .distance_voxels = glm::mix(followed, distance(0), std::min(1.0, std::abs(followed) / far_voxels)),
        .across = certainty / length * aside,
        .stiffness = stiffness / larger.back().there,
        .tissue = bone.tissue_at(at_most)};
}

glm::dvec3 AxisFace::lacking_n(const CuttingStep& step, const FaceEnd& end,
                               const Sweep& ball) const noexcept {
    const double certainty = glm::length(end.across);
    if (certainty <= 0.0) return glm::dvec3(0.0);
    const glm::dvec3 path = glm::transpose(step.frame) * (ball.to - ball.from);
    double c0 = -path.z;
    double c1 = glm::dot(glm::dvec2(path), end.across) / (certainty * ball.radius);
    if (c0 + c1 * end.distance_voxels <= 0.0) return glm::dvec3(0.0);
    if (step.is_of_edges) {
        c0 = 2.0 * static_cast<double>(step.half_path_voxels);  // wherever there is a face
        c1 = 0.0;
    }
    const double at = share_of_reach(end.distance_voxels);
    const glm::dvec2 swirl =
        end.stiffness * (c0 * between(constant_, at) + c1 * between(slope_, at)) * end.across;
    const glm::dvec3 k(step.coefficients);
    return step.newton_per_unit *
           glm::dvec3(k.x * swirl.y - k.z * swirl.x, -k.x * swirl.x - k.z * swirl.y, 0.0);
}

}  // namespace osteomill
