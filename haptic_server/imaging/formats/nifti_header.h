// The header of a NIfTI-1 or -2 (or Analyze 7.5) image, held against what it may say before ITK's reader sees
// it for the geometry: that one takes a spacing that is zero or no number for 1 mm and hangs on an
// orientation that is no number. It reads no voxels: it would hold all of them, several times over.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "haptic_server/imaging/formats/voxel_data.h"
#include "haptic_server/imaging/formats/voxel_layout.h"

namespace osteomill {

/// So much of a file is its header.
inline constexpr std::size_t most_nifti_header_bytes = 540;

struct NiftiHeader {
    bool voxels_follow = true;  ///< in one file; otherwise in an .img beside the .hdr
    std::vector<std::uint64_t> sizes;
    VoxelLayout voxels;             ///< of colour, which is refused elsewhere, nothing that holds
    std::uint64_t voxel_bytes = 0;  ///< of all voxels
    std::uint64_t voxels_begin = 0;
    std::array<double, 3> spacing_mm{};
};

/// Takes the first bytes of a file (inflated) apart; pure. `path` is for messages. Throws ImagingError for a
/// header that is cut off, for sizes or a type of voxels that cannot be, for a spacing, offset, orientation
/// or rescale that is not a number or that no scan has, and for voxels that begin within the header or
/// beyond all reason.
NiftiHeader parse_nifti_header(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);

struct NiftiImage {
    NiftiHeader header;
    VoxelData data;
};

/// Reads the header and finds the voxels. Throws ImagingError. `path` is a .nii, .nii.gz, or either of a .hdr
/// with its .img (.img.gz).
NiftiImage open_nifti(const std::filesystem::path& path);

}  // namespace osteomill
