// Check of a DICOM file, element by element, before GDCM reads it. GDCM recurses into every sequence within a
// sequence, sometimes twice, allocates any length that an element claims, and decodes pixels of any format.
// So GDCM only gets files that nest little, hold the bytes that they claim, and are images that it decodes
// (dicom_pixels.h). Pure functions over bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace osteomill {

/// Sequences within sequences; reports nest a dozen deep. GDCM takes twice as long for each.
inline constexpr int most_dicom_nesting = 16;

/// An image as JPEG 2000, JPEG and JPEG-LS describe it in their own header, independently of the DICOM around
/// them.
struct Codestream {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;  ///< 0: a JPEG that says so at its end
    std::uint32_t components = 0;
    std::optional<bool> is_signed{};  ///< only JPEG 2000 says
};

/// std::nullopt if the bytes begin like no JPEG.
std::optional<Codestream> codestream_of(std::span<const std::uint8_t> bytes);

/// One of the pieces that compressed pixels stand in.
struct DicomFragment {
    std::uint64_t at = 0;  ///< as the table of offsets counts
    std::uint32_t bytes = 0;
    bool ends_picture = false;  ///< with the mark of JPEG, JPEG-LS and JPEG 2000
};

struct DicomScan {
    std::string transfer_syntax{};  ///< UID; empty if the file states none
    std::string sop_class{};        ///< UID
    std::string modality{};         ///< CT, MR, SEG, ...
    std::optional<int> rows{};
    std::optional<int> columns{};
    std::optional<int> samples_per_pixel{};
    std::optional<int> bits_allocated{};
    std::optional<int> bits_stored{};
    std::optional<int> high_bit{};
    std::optional<int> pixel_representation{};  ///< 0 unsigned, 1 signed
    std::string frames{};                       ///< Number of Frames, as it is written
    bool has_pixel_data = false;
    bool is_encapsulated = false;
    std::uint64_t pixel_bytes = 0;           ///< size of the pixel data; when encapsulated, of all fragments
    std::optional<Codestream> codestream{};  ///< in the first fragment
    std::vector<DicomFragment> fragments{};
    std::set<std::uint64_t> frame_offsets{};  ///< where the frames' first fragments are, if the file says so
    /// Some uncompressed pixel of 16 bits has others set above High Bit than its sign's and an overlay's.
    bool has_bits_above = false;
};

/// Bytes that tell whether a file may be DICOM.
inline constexpr std::size_t dicom_mark_bytes = 132;

/// Whether the first bytes are those of DICOM: today's ("DICM" behind 128 bytes) or that of old files (an
/// element of group 2 or 8).
bool may_be_dicom(std::span<const std::uint8_t> bytes);

/// std::nullopt for a file that is not DICOM. Throws std::invalid_argument, with the reason, for a file that
/// begins as DICOM but is cut off or damaged, for sequences nested deeper than most_dicom_nesting, and for
/// values that hide nested sequences. Implicit and explicit, little and big endian, deflated (up to 256 MiB).
/// `bytes` may be the first of a file of `file_bytes` as long as they reach into pixels that are not
/// compressed.
std::optional<DicomScan> scan_dicom(std::span<const std::uint8_t> bytes, std::uint64_t file_bytes);

}  // namespace osteomill
