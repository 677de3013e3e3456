// Structures on the bone's grid as a segmentation that 3D Slicer opens (.seg.nrrd), and read_segmentation()
// again.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/bone/structure_mask.h"

namespace osteomill {

struct NamedStructure {
    std::string name{};
    std::array<std::uint8_t, 3> colour_rgb{};
    StructureMask mask{};  ///< not empty
};

/// Writes the box that holds them all, on the masks' grid, which is the same for all; structures that overlap
/// go into separate layers. Throws ImagingError in one line if the file cannot be written;
/// std::invalid_argument for no structure, an empty one, or over 255.
void write_segmentation(const std::filesystem::path& path, const std::vector<NamedStructure>& structures);

}  // namespace osteomill
