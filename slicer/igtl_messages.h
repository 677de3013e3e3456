// OpenIGTLink messages (protocol 2, header version 1: Debian's libopenigtlink) as 3D Slicer reads them.
//
// Only here Osteomill's patient LPS becomes RAS, x and y negated: OpenIGTLinkIF ignores the header's own flag
// of the space. Names are at most 20 bytes; a longer one is cut.
#pragma once

#include <chrono>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "slicer/reduced_bone.h"

namespace osteomill {

/// Without a time, until it is sent.
using IgtlMessage = std::vector<std::uint8_t>;

/// Writes the time into its header, which no checksum covers.
void stamp(IgtlMessage& message, std::chrono::system_clock::time_point sent);

inline glm::dvec3 lps_to_ras(const glm::dvec3& v) {
    return {-v.x, -v.y, v.z};
}
/// RAS to LPS: the negation is its own inverse.
inline glm::dvec3 ras_to_lps(const glm::dvec3& v) {
    return lps_to_ras(v);
}

/// A tool's pose: its origin and axes (columns, unit vectors) in patient LPS, mm.
IgtlMessage transform_message(const std::string& name, const glm::dvec3& origin_mm, const glm::dmat3& axes);

/// Axes (columns) of a tool that has only one: z is `axis`, patient LPS, of unit length; x and y are any two
/// square to it and to each other.
glm::dmat3 axes_about(const glm::dvec3& axis);

/// Part of an image of bytes on `grid`: `values` of the voxels of `box`, x fastest. Throws
/// std::invalid_argument for more or fewer values.
IgtlMessage image_message(const std::string& name, const Grid& grid, const ReducedBox& box,
                          std::span<const std::uint8_t> values);

/// Text of at most 65 535 bytes; a longer one is cut.
IgtlMessage string_message(const std::string& name, const std::string& text);

/// Whether all is well, and a text.
IgtlMessage status_message(const std::string& name, bool is_well, const std::string& text);

}  // namespace osteomill
