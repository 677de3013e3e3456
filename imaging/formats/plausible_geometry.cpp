#include "imaging/formats/plausible_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>
#include <string_view>

#include "common/text/words.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {
/// Cosine between two axes above which an image counts as sheared; 1e-3 is 0.06 degrees.
constexpr double perpendicular_tolerance = 1e-3;
/// Directions are printed with six digits: a larger deviation deserves a note.
constexpr double printed_cosine = 2e-4;

struct AxisPair {
    int a = 0;
    int b = 1;
    double cosine = 0.0;
};

AxisPair most_sheared(const SourceImage& image) {
    AxisPair worst;
    for (int a = 0; a < 3; ++a)
        for (int b = a + 1; b < 3; ++b)
            if (const double cosine = glm::dot(image.direction[a], image.direction[b]);
                !(std::abs(cosine) <= std::abs(worst.cosine)))
                worst = {a, b, cosine};
    return worst;
}

/// The rotation (or reflection) nearest to a matrix, by Newton's iteration for its polar decomposition.
glm::dmat3 nearest_rotation(glm::dmat3 matrix) {
    for (int i = 0; i < 8; ++i) matrix = 0.5 * (matrix + glm::inverse(glm::transpose(matrix)));
    return matrix;
}
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
    if (!is_plausible_position(position_mm(image, glm::dvec3(image.size_voxels - 1))))
        throw std::invalid_argument(implausible_position("its last voxel"));
    if (!(shear_of(image) < perpendicular_tolerance))
        throw std::invalid_argument(sheared_axes(image) +
                                    ", not perpendicular (a gantry tilt?); reformat it upright first");
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(glm::length(image.direction[axis]) - 1.0) < perpendicular_tolerance))
            throw std::invalid_argument("its axes are not unit vectors");
}

double shear_of(const SourceImage& image) {
    return std::abs(most_sheared(image).cosine);
}

std::string sheared_axes(const SourceImage& image) {
    const AxisPair pair = most_sheared(image);
    return fmt::format("its axes {} and {} are {:.2f} degrees apart", "ijk"[pair.a], "ijk"[pair.b],
                       glm::degrees(std::acos(std::clamp(pair.cosine, -1.0, 1.0))));
}

void settle_geometry(SourceImage& image, const std::filesystem::path& path) {
    const double shear = shear_of(image);
    if (shear > 0.0 && shear <= std::sin(glm::radians(most_shear_degrees))) {
        if (shear > printed_cosine)
            image.notes.push_back(
                fmt::format("{}: {}; made perpendicular", path.string(), sheared_axes(image)));
        const glm::dvec3 middle = 0.5 * glm::dvec3(image.size_voxels - 1);
        const glm::dvec3 middle_mm = position_mm(image, middle);
        image.direction = nearest_rotation(image.direction);
        image.origin_mm += middle_mm - position_mm(image, middle);
    }
    said_of(path, [&] { require_plausible_geometry(image); });
}

void note_guessed_orientation(SourceImage& image, const std::filesystem::path& path, const std::string& why,
                              const char* taken_as) {
    image.notes.push_back(fmt::format("{}: warning: {}; left and right are a guess (taken as {})",
                                      path.string(), why, taken_as));
}

namespace {

struct LengthUnit {
    double mm;
    std::array<std::string_view, 7> names;  ///< in lower case, without the s of a plural
};
// Micro is U+00B5, U+03BC or, in Latin-1, the byte B5.
constexpr std::array length_units{
    LengthUnit{1.0, {"mm", "millimeter", "millimetre"}}, LengthUnit{10.0, {"cm", "centimeter", "centimetre"}},
    LengthUnit{1000.0, {"m", "meter", "metre"}},
    LengthUnit{1e-3, {"um", "\xc2\xb5m", "\xce\xbcm", "\xb5m", "micron", "micrometer", "micrometre"}},
    LengthUnit{1e-6, {"nm", "nanometer", "nanometre"}}};

std::string usual(const std::string& name) {
    return lower_case(trimmed(name));
}

}  // namespace

std::optional<double> mm_of_unit(const std::string& name) {
    const std::string asked = usual(name);
    const std::string singular = asked.ends_with('s') ? asked.substr(0, asked.size() - 1) : asked;
    for (const LengthUnit& unit : length_units)
        for (const std::string_view known : unit.names)
            if (!known.empty() && (asked == known || (known.size() > 3 && singular == known))) return unit.mm;
    return std::nullopt;
}

bool is_unknown_unit(const std::string& name) {
    const std::string asked = usual(name);
    return asked.find_first_not_of('?') == std::string::npos || asked == "none" || asked == "unknown";
}

}  // namespace osteomill
