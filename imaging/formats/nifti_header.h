// The header of a NIfTI-1 or -2 (or Analyze 7.5) image: how the image lies in the patient, and where its
// values lie. Described at https://nifti.nimh.nih.gov.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "imaging/formats/image_file.h"

namespace osteomill {

/// So much of a file is its header.
inline constexpr std::size_t most_nifti_header_bytes = 540;

struct NiftiHeader : ImageHeader {
    bool voxels_follow = true;  ///< in one file; otherwise in an .img beside the .hdr
};

/// Whether a file that begins with these bytes (inflated) is one.
bool begins_as_nifti(std::span<const std::uint8_t> bytes);

/// Parses the first bytes of a file (inflated); pure. `path` is for messages. If sform, qform and pixdim
/// disagree, the sform is followed if it is a rotation times spacings, and a note says so. Throws
/// ImagingError for a header that is cut off, for sizes or a type of voxels that cannot be, for other than
/// three dimensions (of more than a voxel), for a unit, spacing, offset, orientation or rescale that is not a
/// number or that no scan has, and for voxels that begin within the header or beyond all reason.
NiftiHeader parse_nifti_header(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);

/// Reads the header. Throws ImagingError. `path` is a file of any name, gzip or not, or
/// either of a .hdr with its .img (.img.gz).
ImageHeader open_nifti(const std::filesystem::path& path);

/// Whether the name is that of the half of a pair that holds the voxels, whose content says nothing: .img or
/// .img.gz.
bool is_nifti_voxel_file(const std::filesystem::path& path);
/// The other half of such a pair; any other path itself. Throws ImagingError if there are two.
std::filesystem::path nifti_header_file(const std::filesystem::path& path);

}  // namespace osteomill
