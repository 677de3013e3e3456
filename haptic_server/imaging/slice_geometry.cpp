#include "haptic_server/imaging/slice_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

[[noreturn]] void refuse(const SlicePlacement& slice, const std::string& reason) {
    throw ImagingError(fmt::format("{}: {}", slice.file, reason));
}

void require_same_plane(const SlicePlacement& first, const SlicePlacement& slice) {
    if (slice.size_pixels != first.size_pixels)
        refuse(slice, fmt::format("is {} x {} pixels, other slices {} x {}: mixed sizes make no volume",
                                  slice.size_pixels.x, slice.size_pixels.y, first.size_pixels.x,
                                  first.size_pixels.y));
    if (glm::length(slice.row_direction - first.row_direction) > 1e-3 ||
        glm::length(slice.column_direction - first.column_direction) > 1e-3)
        refuse(slice, "is oriented differently from the other slices of its series");
    if (glm::length(slice.pixel_spacing_mm - first.pixel_spacing_mm) >
        1e-4 * glm::length(first.pixel_spacing_mm))
        refuse(slice,
               fmt::format("has pixels of {} x {} mm, other slices {} x {} mm", slice.pixel_spacing_mm.x,
                           slice.pixel_spacing_mm.y, first.pixel_spacing_mm.x, first.pixel_spacing_mm.y));
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

}  // namespace

SliceStack stack_slices(std::vector<SlicePlacement> slices) {
    if (slices.empty()) throw ImagingError("a series without slices is no volume");
    if (slices.size() < 3)
        refuse(slices.front(), fmt::format("belongs to a series of {} slice{}; even spacing shows only from three on",
                                           slices.size(), slices.size() == 1 ? "" : "s"));
    for (const SlicePlacement& slice : slices) require_same_plane(slices.front(), slice);

    const glm::dvec3 normal =
        glm::normalize(glm::cross(slices.front().row_direction, slices.front().column_direction));
    const auto height = [&](const SlicePlacement& slice) { return glm::dot(slice.position_mm, normal); };
    std::sort(slices.begin(), slices.end(),
              [&](const SlicePlacement& a, const SlicePlacement& b) { return height(a) < height(b); });

    std::vector<double> gaps;
    for (std::size_t i = 1; i < slices.size(); ++i) gaps.push_back(height(slices[i]) - height(slices[i - 1]));
    const double spacing = median(gaps);
    for (std::size_t i = 0; i < gaps.size(); ++i)
        if (gaps[i] < 1e-3)
            refuse(slices[i + 1], fmt::format("lies at the same place as {}", slices[i].file));

    const glm::dvec3 along = slices.back().position_mm - slices.front().position_mm;
    const double tilt_deg =
        std::atan2(glm::length(along - glm::dot(along, normal) * normal), glm::dot(along, normal)) * 180.0 /
        std::numbers::pi;
    if (tilt_deg > tilt_tolerance_deg)
        refuse(slices.front(),
               fmt::format("the series was taken with a gantry tilt of {:.1f} degrees; resample it to an "
                           "upright volume first",
                           tilt_deg));

    for (std::size_t i = 0; i < gaps.size(); ++i) {
        if (std::abs(gaps[i] - spacing) <= spacing_tolerance * spacing) continue;
        const double missing = gaps[i] / spacing - 1.0;
        const bool whole = missing > 0.5 && std::abs(missing - std::round(missing)) < 0.1;
        refuse(slices[i + 1], fmt::format("lies {:.3f} mm above {} where slices are {:.3f} mm apart: {}",
                                          gaps[i], slices[i].file, spacing,
                                          whole ? fmt::format("{:.0f} missing", std::round(missing))
                                                : std::string("unevenly spaced")));
    }
    return {std::move(slices), spacing};
}

}  // namespace osteomill
