#include "imaging/dicom/dicom_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <string_view>

namespace osteomill {

namespace {
constexpr std::size_t most_frames = 65536;
constexpr std::string_view segmentation_class = "1.2.840.10008.5.1.4.1.1.66.4";
constexpr std::string_view label_map_class = "1.2.840.10008.5.1.4.1.1.66.7";
}  // namespace

std::size_t frame_count(const DicomScan& scan) {
    if (scan.frames.empty()) return 1;
    const std::string_view text =
        std::string_view(scan.frames)
            .substr(std::min(scan.frames.find_first_not_of(" +"), scan.frames.size()));
    const char* last = text.data() + text.size();
    std::size_t frames = 0;
    const auto [end, error] = std::from_chars(text.data(), last, frames);
    if (error != std::errc() || end != last || frames < 1 || frames > most_frames)
        throw std::invalid_argument(fmt::format("Number of Frames (0028,0008) is '{}'", scan.frames));
    return frames;
}

std::vector<std::vector<std::size_t>> fragments_of_frames(const DicomScan& scan) {
    std::vector<std::size_t> filled;
    for (std::size_t i = 0; i < scan.fragments.size(); ++i)
        if (scan.fragments[i].bytes > 0) filled.push_back(i);
    const auto grouped = [&](const auto& begins_frame) {
        std::vector<std::vector<std::size_t>> groups;
        for (std::size_t n = 0; n < filled.size(); ++n) {
            if (n == 0 || begins_frame(n)) groups.emplace_back();
            groups.back().push_back(filled[n]);
        }
        return groups;
    };
    const std::size_t frames = frame_count(scan);
    auto groups = grouped([](std::size_t) { return true; });
    if (groups.size() != frames)
        groups = grouped([&](std::size_t n) { return scan.fragments[filled[n - 1]].ends_picture; });
    if (groups.size() < frames)
        groups =
            grouped([&](std::size_t n) { return scan.frame_offsets.contains(scan.fragments[filled[n]].at); });
    if (groups.size() != frames)
        throw std::invalid_argument(
            fmt::format("has {} fragments of compressed pixel data (7fe0,0010), of which its {} frames "
                        "cannot be told apart",
                        filled.size(), frames));
    return groups;
}

void require_sound_pixels(const DicomScan& scan) {
    const int rows = scan.rows.value_or(0);
    const int columns = scan.columns.value_or(0);
    const auto refuse = [](const std::string& reason) { throw std::invalid_argument(reason); };
    const std::uint64_t frames = frame_count(scan);
    if (!scan.has_pixel_data || rows == 0 || columns == 0) return;
    const int bits = scan.bits_allocated.value_or(0);
    if (bits != 8 && bits != 16 && bits != 32)
        refuse(fmt::format("Bits Allocated (0028,0100) is {}; pixels of 8, 16 or 32 bits are read", bits));
    if (const int stored = scan.bits_stored.value_or(bits); stored < 1 || stored > bits)
        refuse(fmt::format("Bits Stored (0028,0101) is {} of {}", stored, bits));
    if (const int high = scan.high_bit.value_or(bits - 1); high >= bits)
        refuse(fmt::format("High Bit (0028,0102) is {} of {} bits", high, bits));
    if (scan.pixel_representation.value_or(0) > 1)
        refuse(fmt::format("Pixel Representation (0028,0103) is {}; 0 and 1 are known",
                           *scan.pixel_representation));
    const std::uint64_t expected =
        frames * static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns) *
        static_cast<std::uint64_t>(scan.samples_per_pixel.value_or(1)) * static_cast<std::uint64_t>(bits) / 8;
    if (!scan.is_encapsulated) {
        if (scan.pixel_bytes < expected)
            refuse(fmt::format("is cut off: {} of {} bytes of pixel data are there", scan.pixel_bytes,
                               expected));
        return;
    }
    if (scan.pixel_bytes == 0) refuse("has compressed pixel data without a fragment (7fe0,0010)");
    // A JPEG may leave its height to its end.
    if (scan.codestream &&
        (scan.codestream->columns != static_cast<std::uint32_t>(columns) ||
         (scan.codestream->rows != static_cast<std::uint32_t>(rows) && scan.codestream->rows != 0)))
        refuse(fmt::format("says {} x {} pixels, but its compressed pixel data say {} x {}", columns, rows,
                           scan.codestream->columns, scan.codestream->rows));
    // An empty picture shrinks to almost nothing; more than one is suspicious.
    constexpr std::uint64_t always_allowed = std::uint64_t{64} << 20U;
    constexpr std::uint64_t most_shrunk = 1000;
    if (expected > always_allowed && expected / most_shrunk > scan.pixel_bytes)
        refuse(fmt::format("says that {} bytes hold {} bytes of pixels; no scan compresses so",
                           scan.pixel_bytes, expected));
    fragments_of_frames(scan);
}

bool is_label_map(const DicomScan& scan) {
    return scan.sop_class == label_map_class;
}

bool is_segmentation(const DicomScan& scan) {
    return scan.sop_class == segmentation_class || is_label_map(scan);
}

std::string why_no_grey_image(const DicomScan& scan) {
    struct Kind {
        std::string_view sop_class;  ///< or the beginning of several, then with a dot at its end
        const char* name;
    };
    constexpr std::array kinds{
        Kind{segmentation_class, "a segmentation (SEG)"},
        Kind{"1.2.840.10008.5.1.4.1.1.66.5", "a segmentation of surfaces (SEG)"},
        Kind{label_map_class, "a segmentation (label map)"},
        Kind{"1.2.840.10008.5.1.4.1.1.66", "raw data or a registration"},
        Kind{"1.2.840.10008.5.1.4.1.1.66.", "raw data or a registration"},
        Kind{"1.2.840.10008.5.1.4.1.1.30", "a parametric map"},
        Kind{"1.2.840.10008.5.1.4.1.1.481.", "an object of radiotherapy (RT dose, structures or plan)"},
        Kind{"1.2.840.10008.5.1.4.1.1.88.", "a report (SR)"},
        Kind{"1.2.840.10008.5.1.4.1.1.11.", "a presentation state"},
        Kind{"1.2.840.10008.5.1.4.1.1.104.", "an encapsulated document"}};
    constexpr std::string_view rt_image = "1.2.840.10008.5.1.4.1.1.481.1";
    const auto fits = [&](const Kind& kind) {
        return kind.sop_class.ends_with('.') ? scan.sop_class.starts_with(kind.sop_class)
                                             : scan.sop_class == kind.sop_class;
    };
    const auto found = std::find_if(kinds.begin(), kinds.end(), fits);
    if (found != kinds.end() && scan.sop_class != rt_image) return std::string("is ") + found->name;
    for (const char* modality : {"SEG", "RTSTRUCT", "RTDOSE", "RTPLAN", "SR", "PR", "KO", "DOC", "REG"})
        if (scan.modality == modality) return fmt::format("is of modality {}", modality);
    return {};
}

}  // namespace osteomill
