#include "imaging/dicom/slice_stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <stdexcept>

#include "imaging/formats/plausible_geometry.h"

namespace osteomill {

namespace {

/// Direction cosines are printed with six digits or more; 1e-3 is 0.06 degrees.
constexpr double direction_tolerance = 1e-3;
/// The largest lean that settle_geometry makes perpendicular.
const double most_lean = std::sin(glm::radians(most_shear_degrees));
constexpr double duplicate_mm = 1e-3;
constexpr double gap_tolerance_relative = 0.02;
constexpr double gap_tolerance_mm = 0.02;

[[noreturn]] void refuse(const std::string& reason) {
    throw std::invalid_argument(reason);
}

void require_sound(const SlicePlacement& slice) {
    for (const double pitch_mm : {slice.column_pitch_mm, slice.row_pitch_mm})
        if (!is_plausible_spacing(pitch_mm))
            refuse(implausible_spacing("pixel spacing of " + slice.name, pitch_mm));
    if (!is_plausible_position(slice.position_mm))
        refuse(implausible_position("the position of " + slice.name));
    const bool unit = std::abs(glm::length(slice.along_row) - 1.0) < direction_tolerance &&
                      std::abs(glm::length(slice.along_column) - 1.0) < direction_tolerance;
    if (!unit || !(std::abs(glm::dot(slice.along_row, slice.along_column)) < most_lean))
        refuse(fmt::format("the row and column directions of {} are not perpendicular unit vectors",
                           slice.name));
}

bool about_equal(double a, double b) {
    return std::abs(a - b) <= direction_tolerance * std::max(a, b);
}

void require_alike(const SlicePlacement& first, const SlicePlacement& other) {
    if (first.columns != other.columns || first.rows != other.rows)
        refuse(fmt::format("mixed image sizes: {} is {} x {}, {} is {} x {}", first.name, first.columns,
                           first.rows, other.name, other.columns, other.rows));
    if (glm::distance(first.along_row, other.along_row) > direction_tolerance ||
        glm::distance(first.along_column, other.along_column) > direction_tolerance)
        refuse(fmt::format("mixed orientations: {} does not lie parallel to {}", other.name, first.name));
    if (!about_equal(first.column_pitch_mm, other.column_pitch_mm) ||
        !about_equal(first.row_pitch_mm, other.row_pitch_mm))
        refuse(fmt::format("mixed pixel spacings: {} has {} x {} mm, {} has {} x {} mm", first.name,
                           first.row_pitch_mm, first.column_pitch_mm, other.name, other.row_pitch_mm,
                           other.column_pitch_mm));
}

/// A slice's shift within its plane, against the first of the stack.
glm::dvec3 sideways(const SlicePlacement& first, const SlicePlacement& slice, const glm::dvec3& normal) {
    const glm::dvec3 step = slice.position_mm - first.position_mm;
    return step - glm::dot(step, normal) * normal;
}

/// The slices' step, of length 1: the normal but for a lean that rounding does not explain.
glm::dvec3 require_upright(const std::vector<SlicePlacement>& slices, const std::vector<std::size_t>& order,
                           const glm::dvec3& normal) {
    const SlicePlacement& first = slices[order.front()];
    const SlicePlacement& last = slices[order.back()];
    const double allowed_mm = 0.5 * std::min(first.column_pitch_mm, first.row_pitch_mm);
    const double height_mm = glm::dot(last.position_mm - first.position_mm, normal);
    const glm::dvec3 lean = sideways(first, last, normal) / height_mm;
    const bool leans = glm::length(lean) * height_mm > allowed_mm;
    if (leans && glm::length(lean) > most_lean)
        refuse(fmt::format(
            "gantry tilt of {:.1f} degrees (its slices are sheared by {:.1f} mm); reformat it upright "
            "first",
            glm::degrees(std::atan(glm::length(lean))), glm::length(lean) * height_mm));
    const glm::dvec3 step = leans ? normal + lean : normal;
    for (const std::size_t index : order) {
        const double along_mm = glm::dot(slices[index].position_mm - first.position_mm, normal);
        const double off_mm = glm::distance(slices[index].position_mm, first.position_mm + along_mm * step);
        if (off_mm > allowed_mm)
            refuse(fmt::format("{} is shifted sideways by {:.1f} mm against {}", slices[index].name, off_mm,
                               first.name));
    }
    return glm::normalize(step);
}

/// The common gap.
double require_even(const std::vector<SlicePlacement>& slices, const std::vector<std::size_t>& order,
                    const std::vector<double>& height_mm) {
    std::vector<double> gaps;
    for (std::size_t i = 1; i < order.size(); ++i)
        gaps.push_back(height_mm[order[i]] - height_mm[order[i - 1]]);
    std::vector<double> sorted = gaps;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                     sorted.end());
    const double usual_mm = sorted[sorted.size() / 2];
    const double allowed_mm = std::max(gap_tolerance_relative * usual_mm, gap_tolerance_mm);
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        if (std::abs(gaps[i] - usual_mm) <= allowed_mm) continue;
        const double ratio = gaps[i] / usual_mm;
        const double whole = std::round(ratio);
        const std::string where =
            fmt::format("between {} and {} lie {:.3f} mm, elsewhere {:.3f} mm", slices[order[i]].name,
                        slices[order[i + 1]].name, gaps[i], usual_mm);
        if (whole >= 2.0 && std::abs(ratio - whole) < 0.05)
            refuse(fmt::format("{:.0f} missing slice(s): {}", whole - 1.0, where));
        refuse("unevenly spaced slices: " + where);
    }
    return std::accumulate(gaps.begin(), gaps.end(), 0.0) / static_cast<double>(gaps.size());
}

/// Slices that are sound and alike, along their common normal.
struct AlignedSlices {
    glm::dvec3 normal{0.0};
    std::vector<double> height_mm{};   ///< one for each placement
    std::vector<std::size_t> order{};  ///< indices, from the lowest on
};

AlignedSlices aligned(const std::vector<SlicePlacement>& slices) {
    for (const SlicePlacement& slice : slices) require_sound(slice);
    for (const SlicePlacement& slice : slices) require_alike(slices.front(), slice);
    AlignedSlices aligned{
        .normal = glm::normalize(glm::cross(slices.front().along_row, slices.front().along_column))};
    for (const SlicePlacement& slice : slices)
        aligned.height_mm.push_back(glm::dot(slice.position_mm, aligned.normal));
    aligned.order.resize(slices.size());
    std::iota(aligned.order.begin(), aligned.order.end(), std::size_t{0});
    std::ranges::stable_sort(aligned.order, {}, [&](std::size_t i) { return aligned.height_mm[i]; });
    return aligned;
}

/// Heights of the places where slices lie, ascending; nearer ones are one place.
std::vector<double> places_of(const AlignedSlices& slices, const StatedGap& stated) {
    const auto height_mm = [&](std::size_t i) { return slices.height_mm[slices.order[i]]; };
    double expected_mm = stated.spacing_mm > 0.0 ? stated.spacing_mm : stated.thickness_mm;
    const bool is_stated = expected_mm > 0.0;
    for (std::size_t i = 1; !is_stated && i < slices.order.size(); ++i)
        expected_mm = std::max(expected_mm, height_mm(i) - height_mm(i - 1));
    const double same_mm = std::max(duplicate_mm, std::min(gap_tolerance_mm, 0.1 * expected_mm));
    std::vector<double> places{height_mm(0)};
    for (std::size_t i = 1; i < slices.order.size(); ++i)
        if (height_mm(i) - places.back() > same_mm) places.push_back(height_mm(i));
    return places;
}

/// Goes from place to place in whole steps and settles the gap on the way, so that one that is printed with
/// few digits leads to the right slice at the far end, too. Returns the last one's number.
std::size_t settle_gap(const std::vector<double>& places, double& gap_mm) {
    double slice = 0.0;
    for (std::size_t i = 1; i < places.size(); ++i) {
        slice += std::max(1.0, std::round((places[i] - places[i - 1]) / gap_mm));
        gap_mm = (places[i] - places.front()) / slice;
        if (slice > static_cast<double>(most_voxels_of_an_axis)) refuse("has more than 65535 slices");
    }
    return static_cast<std::size_t>(slice);
}

/// The gap between places, among which some may be empty.
double gap_of(const std::vector<double>& places, const StatedGap& stated, std::string& note) {
    if (places.size() < 2) return stated.spacing_mm > 0.0 ? stated.spacing_mm : stated.thickness_mm;
    double least_mm = places[1] - places[0];
    double most_mm = least_mm;
    for (std::size_t i = 2; i < places.size(); ++i) {
        least_mm = std::min(least_mm, places[i] - places[i - 1]);
        most_mm = std::max(most_mm, places[i] - places[i - 1]);
    }
    const auto tolerance = [](double gap_mm) {
        return std::max(gap_tolerance_relative * gap_mm, std::min(gap_tolerance_mm, 0.1 * gap_mm));
    };
    const double stated_mm = stated.spacing_mm;
    if (stated_mm == 0.0 || std::abs(stated_mm - least_mm) <= tolerance(stated_mm)) return least_mm;
    // Between frames without a gap, as thick as they lie apart, no slice is missing whatever the file says.
    const bool is_even = places.size() > 2 && most_mm - least_mm <= 2.0 * tolerance(least_mm);
    const bool is_filled = std::abs(stated.thickness_mm - stated_mm) > tolerance(stated_mm);
    if (stated_mm > least_mm || (is_even && is_filled)) {
        note = fmt::format(
            "says slices {:g} mm apart (Spacing Between Slices, 0018,0088); its frames lie {:g} mm apart, "
            "which is "
            "followed",
            stated_mm, least_mm);
        return least_mm;
    }
    note = fmt::format(
        "its frames lie {:g} mm apart or more, its slices {:g} mm (Spacing Between Slices, "
        "0018,0088); those between are empty",
        least_mm, stated_mm);
    return stated_mm;
}

}  // namespace

SliceStack stack_slices(const std::vector<SlicePlacement>& slices) {
    if (slices.empty()) refuse("no slices");
    if (slices.size() == 1)
        refuse(fmt::format("a single slice ({}), which is no volume", slices.front().name));
    const AlignedSlices along = aligned(slices);
    const std::vector<double>& height_mm = along.height_mm;
    SliceStack stack;
    stack.order = along.order;
    for (std::size_t i = 1; i < stack.order.size(); ++i) {
        const std::size_t below = stack.order[i - 1];
        const std::size_t above = stack.order[i];
        if (height_mm[above] - height_mm[below] < duplicate_mm)
            refuse(fmt::format("two slices at the same position: {} and {}", slices[below].name,
                               slices[above].name));
    }
    const SlicePlacement& any = slices.front();
    const glm::dvec3 step = require_upright(slices, stack.order, along.normal);
    const double gap_mm = require_even(slices, stack.order, height_mm);

    stack.origin_mm = slices[stack.order.front()].position_mm;
    stack.spacing_mm = {any.column_pitch_mm, any.row_pitch_mm, gap_mm};
    stack.direction = glm::dmat3(glm::normalize(any.along_row), glm::normalize(any.along_column), step);
    return stack;
}

SliceLattice lattice_of(const std::vector<SlicePlacement>& slices, const StatedGap& stated) {
    if (slices.empty()) refuse("no slices");
    const AlignedSlices along = aligned(slices);
    SliceLattice lattice;
    const std::vector<double> places = places_of(along, stated);
    double gap_mm = gap_of(places, stated, lattice.note);
    if (!is_plausible_spacing(gap_mm))
        refuse(implausible_spacing("Spacing Between Slices (0018,0088)", gap_mm));
    // A single slice of labels is a volume of one slice among empty ones.
    lattice.slices = places.size() == 1 ? 2 : settle_gap(places, gap_mm) + 1;
    const glm::dvec3 step =
        places.size() == 1 ? along.normal : require_upright(slices, along.order, along.normal);
    for (const double height : along.height_mm) {
        const double slice = (height - places.front()) / gap_mm;
        if (std::abs(slice - std::round(slice)) * gap_mm >
            std::max(gap_tolerance_relative * gap_mm, std::min(gap_tolerance_mm, 0.2 * gap_mm)))
            refuse("its frames lie at no common spacing");
        lattice.slice_of.push_back(static_cast<std::size_t>(std::lround(slice)));
    }
    const SlicePlacement& any = slices.front();
    lattice.origin_mm = slices[along.order.front()].position_mm;
    lattice.spacing_mm = {any.column_pitch_mm, any.row_pitch_mm, gap_mm};
    lattice.direction = glm::dmat3(glm::normalize(any.along_row), glm::normalize(any.along_column), step);
    return lattice;
}

}  // namespace osteomill
