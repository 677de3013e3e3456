// What the NIfTI library lets pass: it takes a spacing that is zero or no number for 1 mm, and fills up
// voxels that a cut-off file lacks.
#pragma once

#include <cstdint>
#include <filesystem>

namespace osteomill {

/// Throws ImagingError where a spacing (pixdim) of the three axes is zero or no number, or the header is cut.
void require_nifti_spacing(const std::filesystem::path& path);

/// Throws ImagingError where a .nii or .nii.gz holds fewer than `voxel_bytes` bytes of voxels. A .hdr with
/// its .img is left to ITK.
void require_whole_nifti(const std::filesystem::path& path, std::uint64_t voxel_bytes);

}  // namespace osteomill
