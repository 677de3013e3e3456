// The header of a NIfTI-1 or -2 (or Analyze 7.5) image: how the image lies in the patient, and where its
// values lie. Described at https://nifti.nimh.nih.gov.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>

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

// Fields of the header of NIfTI-1 and NIfTI-2: the same statements, each version at its own offsets.

inline constexpr std::int32_t nifti1_header_bytes = 348;
inline constexpr std::int32_t nifti2_header_bytes = 540;

/// Values at offsets, in either byte order.
class NiftiFields {
  public:
    NiftiFields(std::span<const std::uint8_t> bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

    template <typename T>
    T at(std::size_t offset) const {
        std::array<std::uint8_t, sizeof(T)> raw{};
        std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), raw.begin());
        if (swapped_) std::reverse(raw.begin(), raw.end());
        T value{};
        std::memcpy(&value, raw.data(), sizeof(T));
        return value;
    }

  private:
    std::span<const std::uint8_t> bytes_;
    bool swapped_;
};

/// A header's statements as written, unchecked. Lengths are in the unit that `units` names, positions patient
/// RAS.
struct NiftiStatements {
    std::array<std::int64_t, 8> dim{};
    std::array<double, 4> pixdim{};
    double voxels_begin = 0.0;
    double slope = 0.0;
    double intercept = 0.0;
    int datatype = 0;
    int bits = 0;
    int qform = 0;
    int sform = 0;
    int units = 0;
    std::array<double, 6> quaternion_and_offset{};
    std::array<double, 12> rows{};
    std::string magic;
};

/// Reads a NIfTI-1 header of at least nifti1_header_bytes.
NiftiStatements read_nifti1(const NiftiFields& fields);
/// Reads a NIfTI-2 header of at least nifti2_header_bytes.
NiftiStatements read_nifti2(const NiftiFields& fields);

/// Fills in the geometry of `image` (mm, patient LPS) and its notes on assumptions and contradictions. The
/// sform is followed if there is one, else the qform, else pixdim with a guessed orientation. Throws
/// ImagingError for numbers that no scan has, an unknown unit, axes that are not perpendicular, and for
/// statements that contradict a sform which is no rotation times spacings. The formulas are those of
/// nifti1.h. `path` is for messages.
void read_nifti_geometry(const NiftiStatements& stated, const std::filesystem::path& path,
                         SourceImage& image);

}  // namespace osteomill
