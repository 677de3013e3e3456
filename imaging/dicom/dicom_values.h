// Meaning of the stored pixels of a DICOM image: a rescale or a table to HU, and which of them were not
// measured.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

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

struct DicomValues {
    std::optional<ModalityTable> table{};
    std::optional<PixelPadding> padding{};

    /// Padding that means air, or no more than water, is left as it is: many scanners state a padding value
    /// that air has, too, and neither makes bone.
    static constexpr float lowest_air_hu = -1100.0F;
    static constexpr float highest_harmless_hu = 100.0F;

    /// Not a number if it is padding. The photometric interpretation has no say: MONOCHROME1 is how to
    /// show it.
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

}  // namespace osteomill
