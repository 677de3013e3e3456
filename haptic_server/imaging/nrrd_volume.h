// One channel of a bone as a NRRD file: an isotropic, axis-aligned grid in patient LPS, gzip inside, which 3D
// Slicer opens in the right place. The only files that the programs exchange among themselves.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/bone/grid.h"

namespace osteomill {

/// `Voxel` is std::int16_t (HU) or std::uint8_t (fractions, stiffness codes, labels).
template <typename Voxel>
struct NrrdVolume {
    Grid grid;
    std::vector<Voxel> voxels;                      ///< x fastest, then y, then z
    std::map<std::string, std::string> key_values;  ///< of the header ("key:=value")
};

/// Reads what write_nrrd_volume wrote. Throws ImagingError, in one line, for a file that is missing, cut off,
/// of another voxel type, without orientation, anisotropic or not aligned with patient LPS; where the file is
/// an image of another kind the line says to run bone_import.
template <typename Voxel>
NrrdVolume<Voxel> read_nrrd_volume(const std::filesystem::path& path);

/// Writes beside the target first and renames, so that a file under that name is always whole. `voxels` are
/// not copied. Throws std::invalid_argument where voxels do not fit the grid, ImagingError where the file
/// cannot be written.
template <typename Voxel>
void write_nrrd_volume(const std::filesystem::path& path, const Grid& grid, const std::vector<Voxel>& voxels,
                       const std::map<std::string, std::string>& key_values);

}  // namespace osteomill
