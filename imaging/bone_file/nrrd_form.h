// The form of NRRD in which bones are kept: one channel on an isotropic, axis-aligned grid in patient LPS,
// the voxels behind the header in the same file. 3D Slicer opens it in the right place. NRRD is described at
// http://teem.sourceforge.net/nrrd/format.html.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/bone/grid.h"

namespace osteomill {

enum class NrrdVoxel { int16, uint8 };  ///< HU; fractions, stiffness codes and labels

inline std::uint64_t bytes_of(NrrdVoxel voxel) {
    return voxel == NrrdVoxel::int16 ? 2 : 1;
}

struct NrrdForm {
    NrrdVoxel voxel = NrrdVoxel::int16;
    Grid grid;
    /// NRRD's "byte skip": so many decoded bytes stand before the voxels, and readers pass over them.
    std::uint64_t bytes_before_voxels = 0;
    /// Values of a voxel, one after the other; over 1 as the first axis, as 3D Slicer layers a segmentation.
    int layers = 1;
    std::map<std::string, std::string> key_values{};  ///< "key:=value"
};

inline std::uint64_t voxel_count(const Grid& grid) {
    return static_cast<std::uint64_t>(grid.size_voxels.x) * static_cast<std::uint64_t>(grid.size_voxels.y) *
           static_cast<std::uint64_t>(grid.size_voxels.z);
}

inline std::uint64_t voxels_of_slice(const Grid& grid) {
    return static_cast<std::uint64_t>(grid.size_voxels.x) * static_cast<std::uint64_t>(grid.size_voxels.y);
}

}  // namespace osteomill
