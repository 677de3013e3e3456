#include "haptic_server/imaging/formats/plausible_geometry.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace osteomill {

namespace {
/// Cosine between two axes above which an image counts as sheared; 1e-3 is 0.06 degrees.
constexpr double perpendicular_tolerance = 1e-3;
}  // namespace

bool is_plausible_spacing(double spacing_mm) {
    return spacing_mm >= least_spacing_mm && spacing_mm <= greatest_spacing_mm;
}

bool is_plausible_position(const glm::dvec3& position_mm) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(position_mm[axis]) <= farthest_position_mm)) return false;
    return true;
}

std::string implausible_spacing(const std::string& what, double spacing_mm) {
    return fmt::format("{} {} mm: it must be above 0, from {} to {} mm", what, spacing_mm, least_spacing_mm,
                       greatest_spacing_mm);
}

std::string implausible_position(const std::string& what) {
    return fmt::format("{} is not a number, or lies more than {} m from the scanner's origin", what,
                       farthest_position_mm / 1000.0);
}

std::uint64_t plausible_voxel_count(std::span<const std::uint64_t> sizes) {
    std::uint64_t count = 1;
    for (const std::uint64_t size : sizes) {
        if (size < 1 || size > most_voxels_of_an_axis)
            throw std::invalid_argument(
                fmt::format("an axis of {} voxels: it must have 1 to {}", size, most_voxels_of_an_axis));
        count *= size;
        if (count > most_voxels) throw std::invalid_argument(fmt::format("more than {} voxels", most_voxels));
    }
    return count;
}

void require_plausible_geometry(const SourceImage& image) {
    std::array<std::uint64_t, 3> sizes{};
    for (int axis = 0; axis < 3; ++axis) {
        if (image.size_voxels[axis] < 0) throw std::invalid_argument("an axis of less than no voxels");
        sizes[static_cast<std::size_t>(axis)] = static_cast<std::uint64_t>(image.size_voxels[axis]);
        if (!is_plausible_spacing(image.spacing_mm[axis]))
            throw std::invalid_argument(
                implausible_spacing(fmt::format("spacing of axis {}:", axis), image.spacing_mm[axis]));
    }
    plausible_voxel_count(sizes);
    if (!is_plausible_position(image.origin_mm))
        throw std::invalid_argument(implausible_position("its origin"));
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            if (!(std::abs(glm::dot(image.direction[a], image.direction[b]) - (a == b ? 1.0 : 0.0)) <
                  perpendicular_tolerance))
                throw std::invalid_argument(
                    "its axes are not perpendicular (a gantry tilt?); reformat it upright first");
}

}  // namespace osteomill
