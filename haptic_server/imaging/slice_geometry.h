// Whether the slices of a series make up a volume: same size, orientation and pixel spacing, evenly spaced
// along their common normal, none missing, none twice, no gantry tilt. Pure geometry, no ITK.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace osteomill {

/// Where one slice lies, as its DICOM header says. Patient LPS, mm.
struct SlicePlacement {
    std::string file;
    glm::dvec3 position_mm{0.0};       ///< centre of the first pixel, (0020,0032)
    glm::dvec3 row_direction{0.0};     ///< along a row, (0020,0037), unit
    glm::dvec3 column_direction{0.0};  ///< down a column
    glm::dvec2 pixel_spacing_mm{0.0};  ///< between columns, between rows
    glm::ivec2 size_pixels{0};         ///< columns, rows
};

struct SliceStack {
    std::vector<SlicePlacement> slices;  ///< in order along the normal
    double spacing_mm = 0.0;
};

/// Slices may deviate from even spacing by this share of the spacing: headers are rounded.
inline constexpr double spacing_tolerance = 0.02;
/// A stack that leans by more than this is tilted.
inline constexpr double tilt_tolerance_deg = 0.2;

/// Orders the slices along their normal. Throws ImagingError naming the offending file and the reason: fewer
/// than two slices, mixed sizes, orientations or pixel spacings, two slices at one place, missing or uneven
/// slices, gantry tilt.
SliceStack stack_slices(std::vector<SlicePlacement> slices);

}  // namespace osteomill
