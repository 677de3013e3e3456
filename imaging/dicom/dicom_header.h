// Header of one DICOM file, as far as it is about its image. GDCM stays behind this.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "imaging/dicom/dicom_precheck.h"
#include "imaging/dicom/slice_stack.h"

namespace osteomill {

/// HU = slope * stored + intercept.
struct DicomRescale {
    double slope = 1.0;
    double intercept = 0.0;

    bool operator==(const DicomRescale&) const = default;
};

/// Modality LUT (0028,3000): stored values from `first` on, and their meaning; values beyond have that of the
/// ends.
struct ModalityTable {
    std::int64_t first = 0;
    std::vector<float> meaning{};  ///< not empty
};

/// Pixel Padding Value (0028,0120) up to Range Limit (0028,0121), as stored.
struct PixelPadding {
    std::int64_t low = 0;
    std::int64_t high = 0;
};

/// Meaning of the stored pixels, apart from the rescale to HU, and which of them were not measured.
struct DicomValues {
    std::optional<ModalityTable> table{};
    std::optional<PixelPadding> padding{};

    /// Padding that means air, or no more than water, is left as it is: many scanners state a padding value
    /// that air has, too, and neither makes bone.
    static constexpr float lowest_air_hu = -1100.0F;
    static constexpr float highest_harmless_hu = 100.0F;

    /// Not a number if it is padding. The photometric interpretation does not matter: MONOCHROME1
    /// is how to show it.
    float hu(std::int64_t stored, const DicomRescale& rescale) const {
        float hu = static_cast<float>(rescale.slope * static_cast<double>(stored) + rescale.intercept);
        if (table) {
            const auto last = static_cast<std::int64_t>(table->meaning.size()) - 1;
            hu = table->meaning[static_cast<std::size_t>(
                std::clamp<std::int64_t>(stored - table->first, 0, last))];
        }
        const bool is_padding = padding && stored >= padding->low && stored <= padding->high;
        if (is_padding && (hu < lowest_air_hu || hu > highest_harmless_hu))
            return std::numeric_limits<float>::quiet_NaN();
        return hu;
    }
};

struct DicomHeader {
    DicomScan scan{};
    std::string series_uid;
    std::string instance_uid;  ///< SOP Instance UID
    std::string series_description;
    std::string transfer_syntax;  ///< as text if GDCM knows them
    int rows = 0;                 ///< 0: no image (a report, a DICOMDIR)
    int columns = 0;
    int samples_per_pixel = 1;
    bool is_uncompressed = false;  ///< the pixels stand in the file as they are
    std::string no_grey_image;     ///< why it holds no CT numbers, as text; empty if it may
    std::string not_of_the_scan;   ///< why it is left out beside others ("is a localizer"), as text; or empty
    DicomValues values{};
    /// Whether its JPEG 2000 codestream says that its pixels are signed, if the header says otherwise; GDCM
    /// would follow the header and clamp.
    std::optional<bool> sign_of_codestream{};
    /// The placement of each frame; std::nullopt for a frame that the header does not place, see `fault`.
    std::vector<std::optional<SlicePlacement>> frames;
    double slice_gap_mm = 0.0;           ///< Spacing Between Slices; 0 if not stated
    double slice_thickness_mm = 0.0;     ///< 0 if not stated
    std::vector<DicomRescale> rescales;  ///< one a frame
    /// The assumptions about it and the doubts about its values, as texts that follow its name.
    std::vector<std::string> notes;
    std::string fault;  ///< why the frames make no volume, as text; empty if they may
};

/// std::nullopt if the file is not DICOM at all. Throws ImagingError if it cannot be opened, begins as
/// DICOM and then cannot be parsed (cut off), nests its sequences beyond reason, or has pixels that are not
/// there or cannot be decoded (dicom_precheck.h).
std::optional<DicomHeader> read_dicom_header(const std::filesystem::path& path);

}  // namespace osteomill
