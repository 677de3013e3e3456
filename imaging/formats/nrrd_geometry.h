// Geometry of a NRRD in the patient: its space, axes, units and origin, turned to patient LPS and mm.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "imaging/formats/nrrd_header.h"

namespace osteomill {

/// Fills in image, is_placed and layers. `sizes`: the plausible sizes of all axes. `path` is for messages.
/// Throws ImagingError for a space, units, directions or an origin that cannot be or are not read, and for
/// other than three axes in space.
void read_nrrd_geometry(const NrrdHeader& header, const std::vector<std::uint64_t>& sizes, ImageHeader& into,
                        const std::filesystem::path& path);

}  // namespace osteomill
